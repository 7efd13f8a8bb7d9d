// Points as vectors of Eigen, and back.
#pragma once

#include <Eigen/Core>

#include "medial_vk/mesh.h"

namespace medial_vk::test {

inline Eigen::Vector3d to_eigen(const Point& p) { return {p[0], p[1], p[2]}; }
inline Point to_point(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

}  // namespace medial_vk::test
