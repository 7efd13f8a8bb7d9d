#include "least_wall/spoke_groups.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace medial_vk {
namespace {

const SpokeCone& farthest_axis(std::span<const SpokeCone> cones, const Point& from) {
  return *std::ranges::min_element(cones, {}, [&](const SpokeCone& cone) { return dot(cone.axis, from); });
}

/// The cone that reaches farthest from a unit vector, or one that reaches almost as far: for an angle b between the
/// axis and the vector, and a small one a of the cone, cos(a + b) is about cos b - a sin b, with the sine at the
/// farthest axis for all of them.
const SpokeCone& farthest_of(std::span<const SpokeCone> cones, const Point& from) {
  const double cosine = dot(farthest_axis(cones, from).axis, from);
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  return *std::ranges::min_element(cones, {},
                                   [&](const SpokeCone& cone) { return dot(cone.axis, from) - sine * cone.angle; });
}

/// How far cones reach from a unit vector.
double reach_of(std::span<const SpokeCone> cones, const Point& from) {
  double reach = 0, widest = 0, least_cosine = 2;
  for (const SpokeCone& cone : cones) widest = std::max(widest, cone.angle);
  for (const SpokeCone& cone : cones) {
    const double cosine = dot(cone.axis, from);
    if (cosine > least_cosine) continue;
    const double reached = angle_between(from, cone.axis) + cone.angle;
    if (reached <= reach) continue;
    reach = reached;
    // No cone whose axis is nearer by more than the widest angle reaches farther.
    least_cosine = std::cos(std::max(0.0, reach - widest)) + kAngleRounding;
  }
  return reach;
}

}  // namespace

/// The axis moves by shorter and shorter steps towards the farthest cone (M. Badoiu, K. L. Clarkson, "Smaller core-sets
/// for balls", 2003), beginning between two that are far apart. The cap holds the cones whatever the axis.
SpokeCone narrow_cap(std::span<const SpokeCone> cones, double limit, double enough) {
  constexpr int kSteps = 12;
  const SpokeCone any = {{0, 0, 0}, std::numbers::pi};
  if (cones.empty()) return {};
  if (std::ranges::any_of(cones, [](const SpokeCone& cone) { return cone.axis == Point{0, 0, 0}; })) return any;
  const Point& one = farthest_axis(cones, cones.front().axis).axis;
  const Point& other = farthest_axis(cones, one).axis;
  // A cap that holds both axes has at least half the angle between them.
  if (angle_between(one, other) >= 2 * limit) return any;
  Point axis = one + other;
  for (int step = 2;; ++step) {
    const double size = length(axis);
    if (!(size > 0)) return any;
    const Point unit = (1 / size) * axis;
    if (step == kSteps || enough > 0) {
      const double angle = std::min(reach_of(cones, unit) + kAngleRounding, std::numbers::pi);
      if (step == kSteps || angle < enough) return {unit, angle};
    }
    axis = unit + (1.0 / (step + 1)) * (farthest_of(cones, unit).axis - unit);
  }
}

PairsOfContacts SpokeGroups::divide(std::span<const SpokeCone> cones, std::size_t first, double theta) {
  PairsOfContacts pairs = {.object_angle = theta};
  if (narrow_cap(cones, theta, theta).angle < theta) {
    pairs.are_possible = false;
    return pairs;
  }
  groups_.clear();
  groups_.reserve(cones.size());
  for (std::vector<SpokeCone>& members : members_) members.clear();
  for (const SpokeCone& cone : cones) {
    groups_.push_back(dot(cone.axis, cones[first].axis) >= 0 ? 0 : 1);
    members_[groups_.back()].push_back(cone);
  }
  for (std::size_t g = 0; g < 2; ++g) {
    caps_[g] = narrow_cap(members_[g], theta);
    // Two contacts in one group would have too small an angle.
    if (!(caps_[g].angle < theta)) return pairs;
  }
  const double between = angle_between(caps_[0].axis, caps_[1].axis);
  const double spread = caps_[0].angle + caps_[1].angle + kAngleRounding;
  pairs.are_possible = between + spread >= 2 * theta;
  pairs.object_angle = std::max(theta, 0.5 * (between - spread));
  pairs.are_apart = 0.5 * between > std::max(caps_[0].angle, caps_[1].angle) + kAngleRounding;
  return pairs;
}

}  // namespace medial_vk
