// Whether a window is cut on one side.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace medial_vk {

/// Of points with coordinates x and y in units of the window's radius: whether more than a third of a turn around the
/// middle has none in the outer half of the window.
template <class Points>
bool has_gap(const Points& points) {
  std::vector<double> angles;
  angles.reserve(points.size());
  for (const auto& point : points) {
    if (point.x * point.x + point.y * point.y > 0.25) angles.push_back(std::atan2(point.y, point.x));
  }
  if (angles.empty()) return true;
  std::ranges::sort(angles);
  double gap = angles.front() + 2 * std::numbers::pi - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i) gap = std::max(gap, angles[i] - angles[i - 1]);
  return gap > 2 * std::numbers::pi / 3;
}

}  // namespace medial_vk
