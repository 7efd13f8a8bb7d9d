// A picture of a mesh in the colours of what was measured on it.
#pragma once

#include "boundary_fields/boundary_fields.h"
#include "medial_vk/mesh.h"
#include "output/picture/panels/image.h"
#include "output/picture/panels/options.h"

namespace medial_vk {

/// The opaque mesh with a legend; grey where the quantity is not known. With `strokes`, lines along the principal
/// directions: long ones along that of kappa 1, short ones along that of kappa 2 (Figure 5-5). Drawn on the CPU, on one
/// thread. Precondition: `fields` hold what the colour and the strokes show.
Picture draw_boundary(const Mesh& mesh, const BoundaryFields& fields, BoundaryColour colour, bool strokes,
                      const PictureOptions& options);

}  // namespace medial_vk
