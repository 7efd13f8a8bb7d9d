#include "balls/ball_scale.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace medial_vk {
namespace {

/// A power of two that is above all numbers, so that scaling costs no rounding.
double unit_of(std::span<const Ball> balls) {
  double largest = 0;
  for (const auto& [centre, radius] : balls) {
    largest = std::max({largest, std::fabs(centre[0]), std::fabs(centre[1]), std::fabs(centre[2]), radius});
  }
  return largest > 0 ? std::ldexp(1.0, std::min(std::ilogb(largest) + 1, 1022)) : 1;
}

double snap(double x) {
  if (std::fabs(x) >= 0x1p-98) return x;  // 53 bits do not reach below 2^-150
  constexpr double kRounder = 0x1.8p-98;
  return (x + kRounder) - kRounder;
}

}  // namespace

Status check_balls(std::span<const Ball> balls) {
  if (balls.size() >= 1u << 31) return Error{ErrorCode::kUsage, "a union of 2^31 balls or more"};
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const auto& [centre, radius] = balls[i];
    const bool finite = std::isfinite(centre[0]) && std::isfinite(centre[1]) && std::isfinite(centre[2]);
    if (finite && std::isfinite(radius) && radius >= 0) continue;
    return Error{ErrorCode::kUsage,
                 "ball " + std::to_string(i) + " has a centre or radius that is not finite, or a negative radius"};
  }
  return {};
}

ScaledBalls scale_balls(std::span<const Ball> balls) {
  ScaledBalls scaled{{balls.begin(), balls.end()}, unit_of(balls)};
  const double scale = 1 / scaled.unit;
  for (auto& [centre, radius] : scaled.balls) {
    for (double& x : centre) x = snap(scale * x);
    radius = snap(scale * radius);
  }
  return scaled;
}

double careful_sum(std::span<const double> terms) {
  double sum = 0, lost = 0;
  for (const double term : terms) {
    const double next = sum + term;
    lost += std::fabs(sum) >= std::fabs(term) ? (sum - next) + term : (term - next) + sum;
    sum = next;
  }
  return sum + lost;
}

}  // namespace medial_vk
