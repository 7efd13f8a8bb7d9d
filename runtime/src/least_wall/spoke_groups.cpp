#include "least_wall/spoke_groups.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace medial_vk {
/// The axis moves by shorter and shorter steps towards the farthest direction (M. Badoiu, K. L. Clarkson, "Smaller
/// core-sets for balls", 2003). The cap holds the cones whatever the axis.
SpokeCone SpokeGroups::cap_of(std::span<const SpokeCone> cones, std::size_t group) const {
  constexpr int kSteps = 12;
  const SpokeCone any = {{0, 0, 0}, std::numbers::pi};
  Point axis = {0, 0, 0};
  double angle = 0;
  for (int step = 0; step <= kSteps; ++step) {
    const double size = length(axis);
    if (step > 0 && !(size > 0)) return any;
    const Point unit = step > 0 ? (1 / size) * axis : axis;
    const SpokeCone* farthest = nullptr;
    angle = 0;
    for (std::size_t i = 0; i < cones.size(); ++i) {
      if (group != kAll && groups_[i] != group) continue;
      if (cones[i].axis == Point{0, 0, 0}) return any;
      const double reached = step > 0 ? angle_between(unit, cones[i].axis) + cones[i].angle : 0;
      if (farthest && reached <= angle) continue;
      farthest = &cones[i];
      angle = reached;
    }
    if (!farthest) return {{0, 0, 0}, 0};
    if (step == kSteps) return {unit, std::min(angle + kAngleRounding, std::numbers::pi)};
    axis = step > 0 ? unit + (1.0 / (step + 1)) * (farthest->axis - unit) : farthest->axis;
  }
  return any;
}

PairsOfContacts SpokeGroups::divide(std::span<const SpokeCone> cones, std::size_t first, double theta) {
  PairsOfContacts pairs = {.object_angle = theta};
  groups_.assign(cones.size(), 0);
  if (cap_of(cones, kAll).angle < theta) {
    pairs.are_possible = false;
    return pairs;
  }
  for (std::size_t i = 0; i < cones.size(); ++i) groups_[i] = dot(cones[i].axis, cones[first].axis) >= 0 ? 0 : 1;
  for (std::size_t g = 0; g < 2; ++g) caps_[g] = cap_of(cones, g);
  // Two contacts in one group would have too small an angle.
  if (!(caps_[0].angle < theta && caps_[1].angle < theta)) return pairs;
  const double between = angle_between(caps_[0].axis, caps_[1].axis);
  const double spread = caps_[0].angle + caps_[1].angle + kAngleRounding;
  pairs.are_possible = between + spread >= 2 * theta;
  pairs.object_angle = std::max(theta, 0.5 * (between - spread));
  pairs.are_apart = 0.5 * between > std::max(caps_[0].angle, caps_[1].angle) + kAngleRounding;
  return pairs;
}

}  // namespace medial_vk
