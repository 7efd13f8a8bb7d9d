// The depths of points in the solid of a frame.
#pragma once

#include <span>
#include <vector>

#include "medial_vk/indexed_mesh.h"
#include "medial_vk/result.h"

namespace medial_vk::cli {

/// Lower bounds, as measure_depths() has them. `mesh` is moved, except for a mirrored frame: that has a mesh of its
/// own, turned inside out. Errors: those of measure_depths() and of moving a mesh.
Status depths_in_frame(std::span<const Point> vertices, std::span<const Point> points, unsigned threads,
                       IndexedMesh& mesh, std::span<double> depths);

}  // namespace medial_vk::cli
