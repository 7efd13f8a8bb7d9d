#include "ball_unions/unions/unit_balls.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace medial_vk {

Status check_balls(std::span<const Ball> balls) {
  if (balls.size() >= 1u << 30) return Error{ErrorCode::kUsage, "a union must have fewer than 2^30 balls"};
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const auto& [centre, radius] = balls[i];
    const bool finite = std::isfinite(centre[0]) && std::isfinite(centre[1]) && std::isfinite(centre[2]);
    if (!finite || !std::isfinite(radius) || radius < 0) {
      return Error{ErrorCode::kUsage, "ball " + std::to_string(i) +
                                          " has a centre or radius that is not finite, or a " + "negative radius"};
    }
  }
  return {};
}

double scale_of(std::span<const Ball> balls) {
  double largest = 0;
  for (const auto& [centre, radius] : balls) {
    largest = std::max({largest, std::fabs(centre[0]), std::fabs(centre[1]), std::fabs(centre[2]), radius});
  }
  // Within the range in which both the scale and its inverse are finite.
  return largest > 0 ? std::ldexp(1.0, std::clamp(-std::ilogb(largest) - 1, -1020, 1020)) : 1;
}

namespace {

/// To a multiple of 2^-150, so that products of five of them are exact.
double snap(double x) {
  if (std::fabs(x) >= 0x1p-98) return x;
  constexpr double kRounder = 0x1.8p-98;
  return (x + kRounder) - kRounder;
}

}  // namespace

Ball scaled_ball(const Ball& ball, double scale) {
  Ball result = ball;
  for (double& x : result.centre) x = snap(scale * x);
  result.radius = snap(scale * result.radius);
  return result;
}

std::vector<Ball> scaled_balls(std::span<const Ball> balls, double scale) {
  std::vector<Ball> result;
  result.reserve(balls.size());
  for (const Ball& ball : balls) result.push_back(scaled_ball(ball, scale));
  return result;
}

void CarefulSum::add(double term) {
  const double next = sum_ + term;
  lost_ += std::fabs(sum_) >= std::fabs(term) ? (sum_ - next) + term : (term - next) + sum_;
  sum_ = next;
}

double careful_sum(std::span<const double> terms) {
  CarefulSum sum;
  for (const double term : terms) sum.add(term);
  return sum.value();
}

}  // namespace medial_vk
