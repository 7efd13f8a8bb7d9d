#include "sphere_fits/steps/slide.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/point_ops.h"
#include "bvh/nearby_triangles.h"

namespace medial_vk {

void Slider::find_contacts(const Ball& ball, double reach) {
  contacts_.clear();
  gather_within(solid_.bvh(), ball.centre, ball.radius + reach, nearby_);
  std::vector<std::uint32_t> one(1);
  for (const std::uint32_t position : nearby_) {
    one[0] = position;
    const BvhHit hit = closest_of(solid_.bvh(), ball.centre, one);
    const double distance = std::sqrt(hit.squared_distance);
    if (distance > ball.radius + reach || distance == 0) continue;
    contacts_.push_back({(1 / distance) * (ball.centre - hit.point), distance - ball.radius});
  }
}

/// Moving the centre by d lets the radius grow by the least of gap_k + away_k . d, which never exceeds the limit by the
/// contacts, as the distance from a point is convex. The step maximises
///   vector . d + area min_k (gap_k + away_k . d) - |d|^2 / (2 pace),
/// and is d = pace (vector + area m), where m is the average of contacts whose weights w minimise the dual
///   pace / 2 |vector + area m|^2 + area sum_k w_k gap_k.
/// Weight is moved from the worst contact with positive weight to the best one, as long as that lowers the dual.
Point Slider::average_of_contacts(const Exposure& exposure, double pace, double accuracy) {
  constexpr int kMostMoves = 128;
  const auto nearest = std::min_element(contacts_.begin(), contacts_.end(),
                                        [](const Contact& a, const Contact& b) { return a.gap < b.gap; });
  weights_.assign(contacts_.size(), 0);
  weights_[static_cast<std::size_t>(nearest - contacts_.begin())] = 1;
  Point average = nearest->away;
  for (int move = 0; move < kMostMoves; ++move) {
    const Point ascent = exposure.vector + exposure.area * average;
    std::size_t best = 0, worst = 0;
    double least = std::numeric_limits<double>::infinity(), greatest = -least;
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
      const double slope = pace * dot(ascent, contacts_[k].away) + contacts_[k].gap;
      if (slope < least) least = slope, best = k;
      if (weights_[k] > 0 && slope > greatest) greatest = slope, worst = k;
    }
    if (greatest - least <= accuracy) break;
    const Point change = contacts_[best].away - contacts_[worst].away;
    const double curvature = pace * exposure.area * dot(change, change);
    const double share = curvature > 0 ? std::min(weights_[worst], (greatest - least) / curvature) : weights_[worst];
    weights_[best] += share;
    weights_[worst] -= share;
    average = average + share * change;
  }
  return average;
}

Point Slider::direction(const Ball& ball, const Exposure& exposure, double step) {
  if (!(exposure.area > 0)) return {};
  find_contacts(ball, 2 * step);
  if (contacts_.empty()) return {};
  // The ascent is seldom longer than a third of the area: such a step would have the full length.
  const double pace = step / (0.3 * exposure.area);
  const Point average = average_of_contacts(exposure, pace, 1e-9 * step);
  Point move = pace * (exposure.vector + exposure.area * average);
  const double size = length(move);
  if (size <= 1e-6 * step) return {};
  if (size > step) move = (step / size) * move;
  return move;
}

}  // namespace medial_vk
