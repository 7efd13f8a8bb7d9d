// On which side of a plane a point lies, without rounding.
#pragma once

#include <Eigen/Core>

namespace medial_vk::reference {

/// (b - a) x (c - a) . (d - a), six times the volume of four corners: positive if d is in front of the triangle abc.
/// Its sign is right, and it is zero only where the volume is: in any fixed number of digits, signs are noise where a
/// segment lies in the plane of a triangle, and beside slivers.
double corner_volume(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                     const Eigen::Vector3d& d);

}  // namespace medial_vk::reference
