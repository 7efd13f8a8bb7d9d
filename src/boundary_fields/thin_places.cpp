#include "boundary_fields/thin_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace medial_vk {
namespace {

/// Numbers of points, joined into groups.
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }

  std::size_t group_of(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) { parent_[group_of(b)] = group_of(a); }

 private:
  std::vector<std::size_t> parent_;
};

using Cell = std::array<std::int64_t, 3>;

Cell cell_of(const Point& p, double side) {
  Cell cell;
  for (std::size_t k = 0; k < 3; ++k) cell[k] = static_cast<std::int64_t>(std::floor(p[k] / side));
  return cell;
}

bool are_within(const Point& a, const Point& b, double distance) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) <= distance;
}

/// Joins points within `distance` of each other.
void join_neighbours(std::span<const Point> points, double distance, Groups& groups) {
  std::map<Cell, std::vector<std::size_t>> of_cell;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Cell cell = cell_of(points[i], distance);
    for (int k = 0; k < 27; ++k) {
      const auto beside = of_cell.find({cell[0] + k % 3 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k / 9 - 1});
      if (beside == of_cell.end()) continue;
      for (const std::size_t other : beside->second) {
        if (are_within(points[i], points[other], distance)) groups.join(other, i);
      }
    }
    of_cell[cell].push_back(i);
  }
}

}  // namespace

std::vector<ThinPlace> group_thin_places(std::span<const Point> points, std::span<const Thickness> at_points,
                                         double area_of_point, const Bounds& range, double object_angle) {
  std::vector<Point> thin;
  std::vector<Bounds> intervals;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double upper = at_points[i].diameter.upper;
    if (upper < range.lower || upper >= range.upper || at_points[i].object_angle < object_angle) continue;
    thin.push_back(points[i]);
    intervals.push_back(at_points[i].diameter);
  }
  Groups groups(thin.size());
  if (area_of_point > 0) join_neighbours(thin, 3 * std::sqrt(area_of_point), groups);
  std::map<std::size_t, ThinPlace> of_group;
  for (std::size_t i = 0; i < thin.size(); ++i) {
    ThinPlace& place = of_group[groups.group_of(i)];
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
