#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "medial_vk/mesh.h"

namespace medial_vk::picture {

/// A unit normal for each corner of each triangle: the mean over the faces at that vertex, except those beyond a sharp
/// edge, so that round shapes look round and boxes look like boxes.
std::vector<Eigen::Vector3f> corner_normals(const Mesh& mesh);

}  // namespace medial_vk::picture
