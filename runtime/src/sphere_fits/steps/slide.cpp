#include "sphere_fits/steps/slide.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/point_ops.h"

namespace medial_vk {

/// False if the point is the ball's centre.
bool Slider::add_contact(const Ball& ball, const Point& at) {
  const Point away = ball.centre - at;
  const double distance = length(away);
  if (!(distance > 0)) return false;
  contacts_.push_back({at, (1 / distance) * away, distance - ball.radius});
  return true;
}

/// The greatest growth of the radius that the contacts permit after a motion, to first order.
double Slider::growth(const Point& move) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Contact& contact : contacts_) least = std::min(least, contact.gap + dot(contact.away, move));
  return least;
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

/// Of all points of the boundary, few limit a step: those that the ball would meet first. They are found one by one, as
/// the nearest point of where the step for the points known so far leads (cutting planes).
Point Slider::direction(const Ball& ball, const Exposure& exposure, double step, std::vector<Point>& touched) {
  constexpr int kMostPoints = 20;
  constexpr double kAccuracy = 1e-3;  // of the radius after the step, in steps
  if (!(exposure.area > 0)) return {};
  contacts_.clear();
  for (const Point& at : touched) add_contact(ball, at);
  if (!add_contact(ball, solid_.closest(ball.centre).point)) return {};
  // The ascent is seldom longer than a third of the area: such a step would have the full length.
  const double pace = step / (0.3 * exposure.area);
  Point move{};
  double size = 0;
  for (int n = 0; n < kMostPoints; ++n) {
    const Point average = average_of_contacts(exposure, pace, 1e-9 * step);
    move = pace * (exposure.vector + exposure.area * average);
    size = length(move);
    if (size > step) move = (step / size) * move;
    const double expected = growth(move);
    if (!add_contact(ball, solid_.closest(ball.centre + move).point)) break;
    if (contacts_.back().gap + dot(contacts_.back().away, move) >= expected - kAccuracy * step) break;
  }
  remember(touched);
  return size <= 1e-6 * step ? Point{} : move;
}

/// The contacts that the last step rests on, and those that were found after it.
void Slider::remember(std::vector<Point>& touched) const {
  touched.clear();
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    if (k >= weights_.size() || weights_[k] > 0) touched.push_back(contacts_[k].at);
  }
}

}  // namespace medial_vk
