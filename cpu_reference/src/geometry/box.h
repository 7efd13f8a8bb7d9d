// Boxes with sides along the axes: cells, parts of them, and their remainder away from the faces of a voxel.
#pragma once

#include <Eigen/Core>

namespace medial_vk::reference {

struct Box {
  Eigen::Vector3d centre, half;  // half: of each side

  /// Every point of the box is within this of its centre; rounded up.
  double reach() const { return half.norm() * (1 + 1e-9); }
  /// Corner number k (0 to 7), from the centre.
  Eigen::Vector3d corner(int k) const {
    return {(k & 1) != 0 ? half.x() : -half.x(), (k & 2) != 0 ? half.y() : -half.y(),
            (k & 4) != 0 ? half.z() : -half.z()};
  }
  /// The greatest value of g . x over the box, x from its centre.
  double support(const Eigen::Vector3d& g) const { return half.dot(g.cwiseAbs()); }
};

/// A cube, slightly larger than this side: properties proved for it hold for its parts too, whose centres are rounded.
inline Box cube(const Eigen::Vector3d& centre, double side) {
  return {centre, Eigen::Vector3d::Constant(0.5 * side * (1 + 1e-9))};
}

}  // namespace medial_vk::reference
