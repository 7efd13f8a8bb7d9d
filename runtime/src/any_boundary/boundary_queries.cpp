#include "any_boundary/boundary_queries.h"

#include <algorithm>
#include <cmath>

#include "base/point_ops.h"

namespace medial_vk::any_boundary {
namespace {

// Of the greatest coordinate that occurs. A few operations of the library and some hundred of the caller have a
// relative error of 2^-53 each.
constexpr double kRounding = 0x1p-44;

/// Points of queries lie within three diagonals of the box, and nearest points of those at most that much farther than
/// the box is from the boundary.
double greatest_coordinate(const BoundaryFunctions& boundary) {
  double most = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    most = std::max({most, std::fabs(boundary.lower[k]), std::fabs(boundary.upper[k])});
  }
  return most + 8 * length(boundary.upper - boundary.lower);
}

}  // namespace

BoundaryQueries::BoundaryQueries(const BoundaryFunctions& boundary)
    : boundary_(boundary), error_(boundary.error + kRounding * greatest_coordinate(boundary)) {}

void BoundaryQueries::nearest(std::span<const Point> points, std::span<Point> answers) const {
  if (points.empty()) return;
  boundary_.nearest(points, answers);
  count_ += points.size();
  const auto is_finite = [](const Point& p) { return std::isfinite(p[0] + p[1] + p[2]); };
  if (!std::all_of(answers.begin(), answers.end(), is_finite)) throw AnswerNotFinite();
}

void BoundaryQueries::contains(std::span<const Point> points, std::span<std::uint8_t> answers) const {
  if (!has_inside()) {
    std::fill(answers.begin(), answers.end(), std::uint8_t{1});
  } else if (!points.empty()) {
    boundary_.contains(points, answers);
  }
}

}  // namespace medial_vk::any_boundary
