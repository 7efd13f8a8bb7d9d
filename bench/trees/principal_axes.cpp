#include "principal_axes.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "base/point_ops.h"

namespace medial_vk::bench {

PrincipalAxes::PrincipalAxes(std::span<const Ball> balls, std::span<const std::uint32_t> chosen) {
  double largest = 0;
  for (const std::uint32_t i : chosen) largest = std::max(largest, balls[i].radius);
  const auto weight_of = [&](const Ball& ball) { return largest > 0 ? std::pow(ball.radius / largest, 3) : 1.0; };
  double sum = 0;
  const Point origin = balls[chosen.front()].centre;
  Point moment = {0, 0, 0};
  for (const std::uint32_t i : chosen) {
    sum += weight_of(balls[i]);
    moment = moment + weight_of(balls[i]) * (balls[i].centre - origin);
  }
  centroid = origin + (1 / sum) * moment;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const std::uint32_t i : chosen) {
    const Point away = balls[i].centre - centroid;
    const Eigen::Vector3d d(away[0], away[1], away[2]);
    covariance += weight_of(balls[i]) * d * d.transpose();
  }
  const Eigen::Matrix3d vectors = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors();
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 3; ++i) axes[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)] = vectors(i, 2 - k);
  }
}

}  // namespace medial_vk::bench
