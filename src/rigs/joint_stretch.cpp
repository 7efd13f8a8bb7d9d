#include "rigs/joint_stretch.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <limits>

namespace medial_vk {

double greatest_stretch(const AffineMap& map) {
  Eigen::Matrix3d matrix;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const std::array<double, 4>& row = map.rows()[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < 3; ++j) matrix(i, j) = row[static_cast<std::size_t>(j)];
  }
  if (!matrix.allFinite()) return std::numeric_limits<double>::infinity();
  const double largest = matrix.cwiseAbs().maxCoeff();
  if (!(largest > 0)) return 0;
  // The root of the greatest eigenvalue of A^T A, whose numbers would leave the range of doubles without the division.
  return largest * (matrix / largest).operatorNorm();
}

std::vector<double> greatest_stretches(std::span<const RiggedFrame> frames) {
  std::vector<double> greatest(frames.front().joints.size(), 0.0);
  for (const RiggedFrame& frame : frames) {
    for (std::size_t j = 0; j < greatest.size(); ++j) {
      greatest[j] = std::max(greatest[j], greatest_stretch(frame.joints[j]));
    }
  }
  return greatest;
}

}  // namespace medial_vk
