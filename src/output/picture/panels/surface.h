#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "medial_vk/mesh.h"

namespace medial_vk::picture {

/// A unit normal for each corner of each triangle: the mean over the faces at that vertex, except those beyond a sharp
/// edge, so that round shapes appear round and flat faces flat.
std::vector<Eigen::Vector3f> corner_normals(const Mesh& mesh);

}  // namespace medial_vk::picture
