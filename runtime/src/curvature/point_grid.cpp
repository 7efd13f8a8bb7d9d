#include "curvature/point_grid.h"

#include <limits>
#include <numbers>

#include "base/parallel.h"

namespace medial_vk {
namespace {

/// The longest side of the box of the points.
double extent_of(std::span<const Point> points) {
  Point lower = points[0], upper = points[0];
  for (const Point& p : points) {
    lower = least(lower, p);
    upper = greatest(upper, p);
  }
  const Point sides = upper - lower;
  return std::max({sides[0], sides[1], sides[2]});
}

}  // namespace

PointGrid::PointGrid(std::span<const Point> points, double cell) : points_(points), cell_(cell) {
  if (points.empty()) return;
  lower_ = points[0];
  for (const Point& p : points) lower_ = least(lower_, p);
  cell_ = std::max({cell, 0x1p-19 * extent_of(points), std::numeric_limits<double>::min()});
  entries_.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Point& p = points[i];
    entries_.push_back({key_of(cell_of(p[0], 0), cell_of(p[1], 1), cell_of(p[2], 2)), i});
  }
  std::ranges::sort(entries_,
                    [](const Entry& a, const Entry& b) { return a.key != b.key ? a.key < b.key : a.index < b.index; });
}

void thin_out(std::span<const Point> points, const PointGrid& grid, double distance,
              std::vector<std::uint8_t>& is_kept) {
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (is_kept[i] == 0) continue;
    grid.visit_within(points[i], distance, [&](std::uint32_t other, double) {
      if (other > i) is_kept[other] = 0;
    });
  }
}

double estimated_spacing(std::span<const Point> points, unsigned threads) {
  if (points.size() < 2) return 0;
  const std::size_t count = points.size(), rank = std::min<std::size_t>(16, count - 1);
  const double extent = extent_of(points);
  if (!(extent > 0)) return 0;
  const double cell = std::max(extent / std::sqrt(static_cast<double>(count)), std::numeric_limits<double>::min());
  const PointGrid grid(points, cell);
  std::vector<double> spacings(count);
  parallel_blocks(count, 256, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<double> squared;
    for (std::size_t i = begin; i < end; ++i) {
      for (double radius = 2 * cell;; radius *= 2) {
        squared.clear();
        grid.visit_within(points[i], radius, [&](std::uint32_t, double d2) { squared.push_back(d2); });
        // A box of this side is 1.8 times as long across: all points are found.
        if (squared.size() > rank || radius >= 2 * extent) break;
      }
      const auto nth = squared.begin() + static_cast<std::ptrdiff_t>(rank);
      std::nth_element(squared.begin(), nth, squared.end());
      spacings[i] = std::sqrt(*nth * std::numbers::pi / static_cast<double>(rank));
    }
  });
  const auto middle = spacings.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(spacings.begin(), middle, spacings.end());
  return *middle;
}

std::vector<Point> centres_of(std::span<const Ball> balls) {
  std::vector<Point> centres;
  centres.reserve(balls.size());
  for (const Ball& ball : balls) centres.push_back(ball.centre);
  return centres;
}

}  // namespace medial_vk
