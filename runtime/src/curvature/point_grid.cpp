#include "curvature/point_grid.h"

#include <limits>
#include <numbers>

#include "base/parallel.h"

namespace medial_vk {
namespace {

// The spacing is estimated from the distance of this neighbour.
constexpr std::size_t kRank = 16;

// Of squared distances, that of this neighbour over that of a quarter of its rank. On a surface it is about 4, on a
// curve 16; this is the geometric mean.
constexpr double kLineRatio = 8;

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
  const std::size_t count = points.size(), rank = std::min<std::size_t>(kRank, count - 1), low_rank = (rank + 3) / 4;
  const double extent = extent_of(points);
  if (!(extent > 0)) return 0;
  const double cell = std::max(extent / std::sqrt(static_cast<double>(count)), std::numeric_limits<double>::min());
  const PointGrid grid(points, cell);
  std::vector<double> spacings(count), along(count);
  std::vector<std::uint8_t> is_line(count, 0);
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
      const double far = *nth, neighbours = static_cast<double>(rank);
      const auto low = squared.begin() + static_cast<std::ptrdiff_t>(low_rank);
      std::nth_element(squared.begin(), low, nth);
      spacings[i] = std::sqrt(far * std::numbers::pi / neighbours);
      along[i] = 2 * std::sqrt(far) / neighbours;
      is_line[i] = *low > 0 && far > kLineRatio * *low ? 1 : 0;
    }
  });
  const auto lines = static_cast<std::size_t>(std::ranges::count(is_line, std::uint8_t{1}));
  std::vector<double>& of_most = rank == kRank && 2 * lines > count ? along : spacings;
  const auto middle = of_most.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(of_most.begin(), middle, of_most.end());
  return *middle;
}

std::vector<Point> centres_of(std::span<const Ball> balls) {
  std::vector<Point> centres;
  centres.reserve(balls.size());
  for (const Ball& ball : balls) centres.push_back(ball.centre);
  return centres;
}

}  // namespace medial_vk
