#include "sphere_fits/cover/centre_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>

#include "base/point_ops.h"

namespace medial_vk {

double farthest_of(std::span<const Point> points, const Point& centre) {
  double squared = 0;
  for (const Point& p : points) {
    const Point d = p - centre;
    squared = std::max(squared, dot(d, d));
  }
  return std::sqrt(squared) * kCoverRoom;
}

CentreSearch::CentreSearch(std::vector<Point> points, std::vector<PaidColumn> columns, double ease, const Ball& most)
    : points_(std::move(points)),
      columns_(std::move(columns)),
      ease_(ease),
      most_(most),
      best_{most.centre, farthest_of(points_, most.centre)},
      least_(cost(columns_, best_, std::numeric_limits<double>::infinity())) {}

/// Stops where it is more than `enough`.
double CentreSearch::cost(std::span<const PaidColumn> columns, const Ball& ball, double enough) const {
  double sum = 0;
  const double most = ball.radius * ball.radius;
  for (const PaidColumn& each : columns) {
    const Point w = each.column.from - ball.centre;
    if (dot(w, w) > most) continue;
    const double height = each.column.height(ball);
    if (height <= each.rest) continue;
    sum += each.area * (each.column.cost(height, ease_) - each.paid);
    if (sum > enough) break;
  }
  return sum;
}

bool CentreSearch::attempt(const Point& centre) {
  const bool is_near = length(centre - region_.centre) <= region_.shift;
  const Ball ball = {centre, farthest_of(is_near ? region_.points : points_, centre)};
  if (length(centre - most_.centre) + ball.radius > most_.radius) return false;
  const double here = cost(is_near ? region_.columns : columns_, ball, least_);
  if (!(here < least_ * (1 - 1e-4))) return false;
  least_ = here;
  best_ = ball;
  return true;
}

/// Balls around centres in the region have radii of at most r + s, with s the shift, so all of them lie in the ball
/// around its centre of radius r + 2 s; a point farther than r - 2 s from there is nearer to each centre than the
/// farthest one.
void CentreSearch::focus(double shift) {
  const double room = 1e-12 * best_.radius;
  const bool is_within = length(best_.centre - region_.centre) + shift <= region_.shift;
  const Ball all = {best_.centre, best_.radius + 2 * shift + room};
  const double least = std::max(0.0, best_.radius - 2 * shift - room);
  Region next = {best_.centre, shift, {}, {}};
  std::ranges::copy_if(is_within ? region_.points : points_, std::back_inserter(next.points), [&](const Point& p) {
    const Point d = p - best_.centre;
    return dot(d, d) >= least * least;
  });
  std::ranges::copy_if(is_within ? region_.columns : columns_, std::back_inserter(next.columns),
                       [&](const PaidColumn& each) {
                         const Point w = each.column.from - all.centre;
                         return dot(w, w) <= all.radius * all.radius && each.column.height(all) >= each.rest;
                       });
  region_ = std::move(next);
}

bool CentreSearch::step(const Point& aim, double length_of_step) {
  const Point start = best_.centre, to = aim - start;
  if (length(to) > length_of_step && attempt(start + (length_of_step / length(to)) * to)) return true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double way : {length_of_step, -length_of_step}) {
      Point centre = start;
      centre[axis] += way;
      if (attempt(centre)) return true;
    }
  }
  return false;
}

Ball CentreSearch::descend(const Point& aim, int halvings) {
  constexpr double kShift = 2;  // of a region, in steps
  double length_of_step = 0.15 * best_.radius;
  for (int halving = 0; halving < halvings; length_of_step /= 2, ++halving) {
    do {
      const bool is_wide = region_.shift > kShift * length_of_step;
      if (is_wide || length(best_.centre - region_.centre) + length_of_step > region_.shift)
        focus(kShift * length_of_step);
    } while (step(aim, length_of_step));
  }
  return best_;
}

}  // namespace medial_vk
