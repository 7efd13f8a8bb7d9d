// Whether a frame has the faces of the mesh at rest.
#pragma once

#include <string>

#include "medial_vk/mesh.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// Success if `frame` has as many vertices as `rest`, and the same triangles in the same order up to the cutting of
/// polygons: readers cut a quadrilateral along its shorter diagonal, which a motion can change. Error: kInvalidMesh,
/// with the first difference, from 1; `name` and `rest_name` are those of the files.
Status compare_faces(const Mesh& rest, const std::string& rest_name, const Mesh& frame, const std::string& name);

}  // namespace medial_vk
