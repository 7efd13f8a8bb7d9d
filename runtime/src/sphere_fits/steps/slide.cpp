#include "sphere_fits/steps/slide.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/point_ops.h"
#include "bvh/triangle_distance.h"
#include "sphere_fits/steps/maximal_ball.h"

namespace medial_vk {

/// False if the centre is on the triangle.
bool Slider::add_contact(const Ball& ball, std::uint32_t triangle) {
  const Mesh& mesh = solid_.mesh().mesh;
  const auto [a, b, c] = mesh.triangles[triangle];
  const NearestOffset nearest =
      nearest_on_triangle(ball.centre, {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
  const double distance = std::sqrt(nearest.squared_distance);
  if (!(distance > 0)) return false;
  contacts_.push_back({triangle, (-1 / distance) * nearest.offset, distance - ball.radius});
  return true;
}

bool Slider::has_contact(std::uint32_t triangle) const {
  return std::ranges::any_of(contacts_, [&](const Contact& contact) { return contact.triangle == triangle; });
}

/// True if the contact that was added last limits the growth of the radius after a motion more than all others do, to
/// first order.
bool Slider::last_limits(const Point& move) const {
  const auto growth = [&](const Contact& contact) { return contact.gap + dot(contact.away, move); };
  const double last = growth(contacts_.back());
  return std::all_of(contacts_.begin(), contacts_.end() - 1,
                     [&](const Contact& contact) { return growth(contact) > last; });
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

/// Of all triangles, few limit a step: those that the ball would meet first. They are found one by one, as the nearest
/// one of where the step for those known so far leads (cutting planes).
Point Slider::direction(const Ball& ball, const Exposure& exposure, double step, std::vector<std::uint32_t>& touched) {
  constexpr std::size_t kMostContacts = 32;
  if (!(exposure.area > 0)) return {};
  contacts_.clear();
  for (const std::uint32_t triangle : touched) {
    if (!has_contact(triangle)) add_contact(ball, triangle);
  }
  const std::uint32_t nearest = closest_with(solid_, ball.centre, touched).triangle;
  if (!has_contact(nearest) && !add_contact(ball, nearest)) return {};
  // The ascent is seldom longer than a third of the area: such a step would have the full length.
  const double pace = step / (0.3 * exposure.area);
  Point move{};
  double size = 0;
  do {
    const Point average = average_of_contacts(exposure, pace, 1e-9 * step);
    move = pace * (exposure.vector + exposure.area * average);
    size = length(move);
    if (size > step) move = (step / size) * move;
    const std::uint32_t limiting = closest_with(solid_, ball.centre + move, touched).triangle;
    if (has_contact(limiting) || !add_contact(ball, limiting)) break;
  } while (last_limits(move) && contacts_.size() < kMostContacts);
  remember(touched);
  return size <= 1e-6 * step ? Point{} : move;
}

/// The contacts that the last step rests on, and the one that was found after it.
void Slider::remember(std::vector<std::uint32_t>& touched) const {
  touched.clear();
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    if (k >= weights_.size() || weights_[k] > 0) touched.push_back(contacts_[k].triangle);
  }
}

}  // namespace medial_vk
