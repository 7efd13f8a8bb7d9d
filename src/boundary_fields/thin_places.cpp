#include "boundary_fields/thin_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/disjoint_sets.h"
#include "base/point_ops.h"

namespace medial_vk {
namespace {

using Cell = std::array<std::int64_t, 3>;

Cell cell_of(const Point& p, double side) {
  Cell cell;
  for (std::size_t k = 0; k < 3; ++k) cell[k] = static_cast<std::int64_t>(std::floor(p[k] / side));
  return cell;
}

/// Connects points within `distance` of each other.
void connect_neighbours(std::span<const Point> points, double distance, ConnectedVertices& groups) {
  std::map<Cell, std::vector<std::uint32_t>> of_cell;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Cell cell = cell_of(points[i], distance);
    for (int k = 0; k < 27; ++k) {
      const auto beside = of_cell.find({cell[0] + k % 3 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k / 9 - 1});
      if (beside == of_cell.end()) continue;
      for (const std::uint32_t other : beside->second) {
        if (length(points[i] - points[other]) <= distance) groups.connect(i, other);
      }
    }
    of_cell[cell].push_back(i);
  }
}

}  // namespace

std::vector<ThinPlace> group_thin_places(std::span<const Point> points, std::span<const Thickness> at_points,
                                         double area_of_point, const Bounds& range, double object_angle) {
  std::vector<Point> thin, centres;
  std::vector<Bounds> intervals;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Bounds& interval = at_points[i].diameter;
    if (interval.upper < range.lower || interval.lower < range.lower * (1 - kThinShare)) continue;
    if (interval.upper >= range.upper) continue;
    if (at_points[i].object_angle < object_angle) continue;
    thin.push_back(points[i]);
    centres.push_back(at_points[i].ball.centre);
    intervals.push_back(at_points[i].diameter);
  }
  ConnectedVertices groups;
  if (area_of_point > 0) connect_neighbours(centres, 3 * std::sqrt(area_of_point), groups);
  std::map<std::uint32_t, ThinPlace> of_group;
  for (std::uint32_t i = 0; i < thin.size(); ++i) {
    ThinPlace& place = of_group[groups.root(i)];
    if (place.area == 0 || intervals[i].lower < place.least.lower) {
      place.least = intervals[i];
      place.at = thin[i];
    }
    place.area += area_of_point;
  }
  std::vector<ThinPlace> places;
  places.reserve(of_group.size());
  for (const auto& [number, place] : of_group) places.push_back(place);
  std::ranges::stable_sort(places, [](const ThinPlace& a, const ThinPlace& b) { return a.area > b.area; });
  return places;
}

}  // namespace medial_vk
