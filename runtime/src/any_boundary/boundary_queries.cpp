#include "any_boundary/boundary_queries.h"

#include <algorithm>
#include <cmath>

#include "base/format_text.h"
#include "base/point_ops.h"

namespace medial_vk::any_boundary {
namespace {

// Of the greatest coordinate that occurs: operations have a relative error of 2^-53 each, and a well-conditioned
// formula of the caller may have some hundred of them.
constexpr double kRounding = 0x1p-44;
// Of the box's diagonal: answers are no farther from the box.
constexpr double kFarthest = 64;

double farthest_coordinate(const BoundaryFunctions& boundary) {
  double most = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    most = std::max({most, std::fabs(boundary.lower[k]), std::fabs(boundary.upper[k])});
  }
  return most + kFarthest * length(boundary.upper - boundary.lower);
}

}  // namespace

Error BadAnswer::error() const {
  const bool is_finite = std::isfinite(answer[0] + answer[1] + answer[2]);
  return {ErrorCode::kUsage, format_text("`nearest` gave a point that is {} for ({}, {}, {})",
                                         is_finite ? "more than 64 diagonals of the box away" : "not finite", query[0],
                                         query[1], query[2])};
}

BoundaryQueries::BoundaryQueries(const BoundaryFunctions& boundary)
    : boundary_(boundary), farthest_(farthest_coordinate(boundary)), error_(boundary.error + kRounding * farthest_) {}

void BoundaryQueries::nearest(std::span<const Point> points, std::span<Point> answers) const {
  if (points.empty()) return;
  boundary_.nearest(points, answers);
  count_ += points.size();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& [x, y, z] = answers[i];
    // Also false for NaN.
    const bool is_good = std::fabs(x) <= farthest_ && std::fabs(y) <= farthest_ && std::fabs(z) <= farthest_;
    if (!is_good) throw BadAnswer{points[i], answers[i]};
  }
}

void BoundaryQueries::contains(std::span<const Point> points, std::span<std::uint8_t> answers) const {
  if (!has_inside()) {
    std::fill(answers.begin(), answers.end(), std::uint8_t{1});
  } else if (!points.empty()) {
    boundary_.contains(points, answers);
  }
}

}  // namespace medial_vk::any_boundary
