#include "voxel_balls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/parallel.h"
#include "base/point_ops.h"
#include "polygon.h"
#include "samples.h"

namespace medial_vk::bench {
namespace {

constexpr double kStep = 1.01;  // from the side of one grid to that of the next
/// Of a side: a box that exceeds a whole number of cells by less, which is rounding, needs no further cell.
constexpr double kRounding = 1e-9;
/// Share of a radius by which balls are enlarged, so that the eight around a common corner of cells hold it by more
/// than the error of the computed corners of their envelope, without which the proof takes these for cavities.
constexpr double kVoxelMargin = 1e-6;

/// Cubes over the box of a mesh.
class Grid {
 public:
  Grid(const Solid& solid, double side) : lower_(solid.mesh().report.lower), side_(side) {
    const Point size = solid.mesh().report.upper - lower_;
    for (std::size_t k = 0; k < 3; ++k) {
      count_[k] = static_cast<std::size_t>(std::max(1.0, std::ceil(size[k] / side - kRounding)));
    }
  }

  std::size_t size() const { return count_[0] * count_[1] * count_[2]; }
  Point corner(std::size_t cell) const {
    const std::array<std::size_t, 3> at = {cell % count_[0], cell / count_[0] % count_[1],
                                           cell / count_[0] / count_[1]};
    Point p = lower_;
    for (std::size_t k = 0; k < 3; ++k) p[k] += side_ * static_cast<double>(at[k]);
    return p;
  }
  Point middle(std::size_t cell) const { return corner(cell) + Point{0.5 * side_, 0.5 * side_, 0.5 * side_}; }

  /// Calls visit(cell) for the cells that meet the box of a triangle.
  template <class Visit>
  void for_cells(const std::array<Point, 3>& triangle, const Visit& visit) const {
    const Point low = least(least(triangle[0], triangle[1]), triangle[2]);
    const Point high = greatest(greatest(triangle[0], triangle[1]), triangle[2]);
    const auto from = cell_at(low, -kRounding), to = cell_at(high, kRounding);
    for (std::size_t z = from[2]; z <= to[2]; ++z) {
      for (std::size_t y = from[1]; y <= to[1]; ++y) {
        for (std::size_t x = from[0]; x <= to[0]; ++x) visit(x + count_[0] * (y + count_[1] * z));
      }
    }
  }

 private:
  std::array<std::size_t, 3> cell_at(const Point& p, double shift) const {
    std::array<std::size_t, 3> at{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double position = std::max(0.0, (p[k] - lower_[k]) / side_ + shift);
      at[k] = std::min(count_[k] - 1, static_cast<std::size_t>(position));
    }
    return at;
  }

  Point lower_;
  double side_;
  std::array<std::size_t, 3> count_{};
};

/// The middles of the cells that are inside, and, with `boundary`, of those that the boundary meets.
std::vector<Point> middles_of(const Solid& solid, double side, bool boundary, unsigned threads) {
  const Grid grid(solid, side);
  std::vector<std::uint8_t> is_used(grid.size(), 0);
  if (boundary) {
    const Mesh& mesh = solid.mesh().mesh;
    for (const Triangle& t : mesh.triangles) {
      const std::array<Point, 3> triangle = {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
      grid.for_cells(triangle, [&](std::size_t cell) {
        if (is_used[cell] != 0) return;
        const Point lower = grid.corner(cell);
        // What is within rounding counts as a common point.
        const double margin = kRounding * side;
        const Point from = lower - Point{margin, margin, margin};
        const double reach = side + margin;
        if (meets_box(triangle, from, lower + Point{reach, reach, reach})) is_used[cell] = 1;
      });
    }
  }
  parallel_for(grid.size(), 16, threads, [&](std::size_t cell) {
    if (is_used[cell] == 0 && solid.contains(grid.middle(cell))) is_used[cell] = 1;
  });
  std::vector<Point> middles;
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    if (is_used[cell] != 0) middles.push_back(grid.middle(cell));
  }
  return middles;
}

/// Of the finest grid with no more than `count` middles; sets its side. Cells that meet the solid have at least its
/// volume, so that no finer grid than the first has so few; of middles inside this holds on average only, which is why
/// the search starts at a somewhat smaller side.
std::vector<Point> most_middles(const Solid& solid, std::size_t count, bool boundary, unsigned threads, double& side) {
  const double start = boundary ? 1 : 0.8;
  for (side = start * std::cbrt(solid.volume() / static_cast<double>(count));; side *= kStep) {
    std::vector<Point> middles = middles_of(solid, side, boundary, threads);
    if (middles.size() <= count) return middles;
  }
}

}  // namespace

std::vector<Ball> voxel_cover(const Solid& solid, std::size_t count, unsigned threads) {
  double side = 0;
  std::vector<Ball> balls;
  for (const Point& middle : most_middles(solid, count, true, threads, side)) {
    balls.push_back({middle, 0.5 * std::sqrt(3.0) * side * (1 + kVoxelMargin)});
  }
  return balls;
}

std::vector<Ball> voxel_balls_inside(const Solid& solid, std::size_t count, unsigned threads) {
  double side = 0;
  return largest_inside(solid, most_middles(solid, count, false, threads, side), threads);
}

}  // namespace medial_vk::bench
