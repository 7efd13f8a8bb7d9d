// Points in the cells of a grid, to find those near a place.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "base/point_ops.h"
#include "medial_vk/ball.h"

namespace medial_vk {

class PointGrid {
 public:
  /// Fewer than 2^31 points, whose differences are finite. The cells are made larger where the box of the points has
  /// more than 2^20 of them along a side. The points must outlive the grid.
  PointGrid(std::span<const Point> points, double cell);

  /// Calls visit(index, squared distance) for all points within `radius` of `p`, in an order that depends on the points
  /// alone.
  template <class Visit>
  void visit_within(const Point& p, double radius, const Visit& visit) const {
    any_within(p, radius, [&](std::uint32_t index, double squared) {
      visit(index, squared);
      return false;
    });
  }
  /// Whether is_one(index, squared distance) holds for one of them; it is called until it does.
  template <class IsOne>
  bool any_within(const Point& p, double radius, const IsOne& is_one) const;

 private:
  struct Entry {
    std::uint64_t key;
    std::uint32_t index;
  };

  std::int64_t cell_of(double coordinate, std::size_t axis) const {
    const double cell = std::floor((coordinate - lower_[axis]) / cell_);
    return static_cast<std::int64_t>(std::clamp(cell, -1.0, 0x1p20));
  }
  static std::uint64_t key_of(std::int64_t x, std::int64_t y, std::int64_t z) {
    return static_cast<std::uint64_t>(z) << 42 | static_cast<std::uint64_t>(y) << 21 | static_cast<std::uint64_t>(x);
  }

  std::span<const Point> points_;
  double cell_;
  Point lower_ = {0, 0, 0};
  std::vector<Entry> entries_;
};

template <class IsOne>
bool PointGrid::any_within(const Point& p, double radius, const IsOne& is_one) const {
  std::array<std::int64_t, 3> first, last;
  double cells = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    first[k] = std::max<std::int64_t>(0, cell_of(p[k] - radius, k));
    last[k] = cell_of(p[k] + radius, k);
    if (last[k] < first[k]) return false;
    if (k > 0) cells *= static_cast<double>(last[k] - first[k] + 1);
  }
  const auto is_found = [&](const Entry& entry) {
    const Point offset = points_[entry.index] - p;
    const double squared = dot(offset, offset);
    return squared <= radius * radius && is_one(entry.index, squared);
  };
  if (cells > static_cast<double>(entries_.size())) {
    return std::any_of(entries_.begin(), entries_.end(), is_found);
  }
  for (std::int64_t z = first[2]; z <= last[2]; ++z) {
    for (std::int64_t y = first[1]; y <= last[1]; ++y) {
      const std::uint64_t from = key_of(first[0], y, z), to = key_of(last[0], y, z);
      const auto is_before = [](const Entry& entry, std::uint64_t key) { return entry.key < key; };
      for (auto at = std::lower_bound(entries_.begin(), entries_.end(), from, is_before);
           at != entries_.end() && at->key <= to; ++at) {
        if (is_found(*at)) return true;
      }
    }
  }
  return false;
}

/// Clears marks of points that are closer than `distance` to a marked one of a lower number, in ascending order.
void thin_out(std::span<const Point> points, const PointGrid& grid, double distance,
              std::vector<std::uint8_t>& is_kept);

/// The side of the square that is each point's share of the area: 1 / sqrt(density), by the distance to the 16th
/// neighbour, in the median over the points. 0 for a single point, and for points all in one place.
double estimated_spacing(std::span<const Point> points, unsigned threads);

std::vector<Point> centres_of(std::span<const Ball> balls);

}  // namespace medial_vk
