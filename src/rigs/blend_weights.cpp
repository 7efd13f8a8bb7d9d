#include "rigs/blend_weights.h"

#include <Eigen/LU>
#include <limits>

namespace medial_vk {
namespace {

/// The weights of the joints in `chosen` alone, by the equations of Lagrange for the sum 1: N w = m 1, 1 w = 1. Empty:
/// they have no single solution, or one with a negative weight; then a smaller subset has the minimum, too.
Eigen::VectorXd weights_of_subset(const Eigen::MatrixXd& normal, const std::vector<Eigen::Index>& chosen) {
  const auto count = static_cast<Eigen::Index>(chosen.size());
  Eigen::MatrixXd equations = Eigen::MatrixXd::Zero(count + 1, count + 1);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count + 1);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) {
      equations(i, j) = normal(chosen[static_cast<std::size_t>(i)], chosen[static_cast<std::size_t>(j)]);
    }
    equations(i, count) = equations(count, i) = 1;
  }
  right[count] = 1;
  const Eigen::FullPivLU<Eigen::MatrixXd> solver(equations);
  if (!solver.isInvertible()) return {};
  const Eigen::VectorXd solution = solver.solve(right).head(count);
  if (!solution.allFinite() || solution.minCoeff() < 0) return {};
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(normal.rows());
  for (Eigen::Index i = 0; i < count; ++i) weights[chosen[static_cast<std::size_t>(i)]] = solution[i];
  return weights / weights.sum();
}

}  // namespace

Eigen::VectorXd blend_weights(const Eigen::MatrixXd& offsets) {
  const Eigen::Index joints = offsets.cols();
  // Scaled, so that the sizes of the equations agree; the minimum stays where it is.
  Eigen::MatrixXd normal = offsets.transpose() * offsets;
  const double scale = normal.cwiseAbs().maxCoeff();
  if (scale > 0) normal /= scale;
  Eigen::VectorXd best;
  double least = std::numeric_limits<double>::infinity();
  for (unsigned subset = 1; subset < 1u << joints; ++subset) {
    std::vector<Eigen::Index> chosen;
    for (Eigen::Index j = 0; j < joints; ++j) {
      if (subset >> j & 1u) chosen.push_back(j);
    }
    // A single joint needs no equations, which have no solution where its offsets are 0.
    const Eigen::VectorXd weights =
        chosen.size() == 1 ? Eigen::VectorXd::Unit(joints, chosen[0]) : weights_of_subset(normal, chosen);
    if (weights.size() == 0) continue;
    const double error = weights.dot(normal * weights);
    if (error < least) {
      least = error;
      best = weights;
    }
  }
  return best;
}

}  // namespace medial_vk
