#include "following/gap_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kNoBall = 0xffffffffu;
constexpr std::size_t kSampleBlock = 256;  // points that one thread takes at a time

double area_of(const Corners3& corners) {
  return 0.5 * length(cross(corners[1] - corners[0], corners[2] - corners[0]));
}

double total_area(const MovingSurface& surface, std::span<const std::uint32_t> triangles) {
  double sum = 0;
  for (const std::uint32_t t : triangles) sum += area_of(surface.corners(t));
  return sum;
}

Point sum_of_corners(const MovingSurface& surface, std::uint32_t triangle) {
  const Corners3 corners = surface.corners(triangle);
  return corners[0] + corners[1] + corners[2];
}

/// The axis along which the middles of the triangles spread most.
std::size_t widest_axis(const MovingSurface& surface, std::span<const std::uint32_t> triangles) {
  Point lower = sum_of_corners(surface, triangles.front()), upper = lower;
  for (const std::uint32_t t : triangles) {
    const Point at = sum_of_corners(surface, t);
    lower = least(lower, at);
    upper = greatest(upper, at);
  }
  const Point sides = upper - lower;
  return static_cast<std::size_t>(std::ranges::max_element(sides) - sides.begin());
}

/// The i-th point of a sequence that fills a triangle evenly: multiples of the inverses of the plastic number and of
/// its square, folded at the diagonal of the square. A single point is the middle.
SurfacePoint spread_point(std::uint32_t triangle, std::size_t i, std::size_t count) {
  if (count == 1) return {triangle, 1.0 / 3, 1.0 / 3};
  const auto n = static_cast<double>(i + 1);
  double v = 0.5 + n * 0.7548776662466927, w = 0.5 + n * 0.5698402909980532;
  v -= std::floor(v);
  w -= std::floor(w);
  return v + w > 1 ? SurfacePoint{triangle, 1 - v, 1 - w} : SurfacePoint{triangle, v, w};
}

}  // namespace

GapSamples::GapSamples(const MovingSurface& surface, std::span<const Ball> balls) : tree_(balls) {
  std::vector<std::uint32_t> triangles(surface.triangles().size());
  std::iota(triangles.begin(), triangles.end(), 0u);
  region_of_triangle_.resize(triangles.size());
  points_.reserve(kPoints);
  shares_.reserve(kPoints);
  divide(surface, triangles, kPoints, false);
  first_.push_back(static_cast<std::uint32_t>(points_.size()));
  nearest_.assign(points_.size(), kNoBall);
  gaps_.resize(points_.size());
  volumes_.resize(regions());
  present_.reserve(balls.size());
  ball_of_.reserve(balls.size());
}

/// Halves the number of triangles across their widest axis, and gives each half points by its area.
void GapSamples::divide(const MovingSurface& surface, std::span<std::uint32_t> triangles, std::size_t count,
                        bool in_region) {
  const bool is_single = triangles.size() == 1 || count == 1;
  if (!in_region && (is_single || count <= kPointsOfRegion)) {
    for (const std::uint32_t t : triangles) region_of_triangle_[t] = static_cast<std::uint32_t>(first_.size());
    first_.push_back(static_cast<std::uint32_t>(points_.size()));
    in_region = true;
  }
  if (is_single) return add_points(surface, triangles, count);
  const std::size_t axis = widest_axis(surface, triangles), half = triangles.size() / 2;
  std::ranges::nth_element(triangles, triangles.begin() + static_cast<std::ptrdiff_t>(half),
                           [&](std::uint32_t a, std::uint32_t b) {
                             const double x = sum_of_corners(surface, a)[axis], y = sum_of_corners(surface, b)[axis];
                             return x != y ? x < y : a < b;
                           });
  const double lower = total_area(surface, triangles.first(half)),
               all = lower + total_area(surface, triangles.subspan(half));
  const double share = all > 0 ? lower / all : 0.5;
  const auto of_lower = static_cast<std::size_t>(std::lround(share * static_cast<double>(count)));
  const std::size_t in_lower = std::clamp<std::size_t>(of_lower, 1, count - 1);
  divide(surface, triangles.first(half), in_lower, in_region);
  divide(surface, triangles.subspan(half), count - in_lower, in_region);
}

/// The largest triangle stands for all; without an area, none does.
void GapSamples::add_points(const MovingSurface& surface, std::span<const std::uint32_t> triangles, std::size_t count) {
  std::uint32_t largest = triangles.front();
  for (const std::uint32_t t : triangles) {
    const double area = area_of(surface.corners(t)), most = area_of(surface.corners(largest));
    if (area > most || (area == most && t < largest)) largest = t;
  }
  const double area = area_of(surface.corners(largest));
  if (!(area > 0)) return;
  const double share = total_area(surface, triangles) / (area * static_cast<double>(count));
  for (std::size_t i = 0; i < count; ++i) {
    points_.push_back(spread_point(largest, i, count));
    shares_.push_back(share);
  }
}

double GapSamples::area(const MovingSurface& surface, std::size_t point) const {
  return shares_[point] * area_of(surface.corners(points_[point].triangle));
}

double GapSamples::distance_from(const Point& at, std::uint32_t ball, std::span<const Ball> balls,
                                 double otherwise) const {
  if (ball == kNoBall || !(balls[ball].radius > 0)) return otherwise;
  return std::max(0.0, length(at - balls[ball].centre) - balls[ball].radius);
}

void GapSamples::sum(std::uint32_t region) {
  volumes_[region] = std::accumulate(gaps_.begin() + first_[region], gaps_.begin() + first_[region + 1], 0.0);
}

void GapSamples::bound(const MovingSurface& surface, std::span<const Ball> balls, WorkerPool& pool) {
  pool.run(points_.size(), kSampleBlock, [&](std::size_t i) {
    const Point at = surface.at(points_[i]);
    gaps_[i] = area(surface, i) * distance_from(at, nearest_[i], balls, surface.longest_side());
  });
  for (std::uint32_t region = 0; region < regions(); ++region) sum(region);
}

void GapSamples::prepare(std::span<const Ball> balls) {
  present_.clear();
  ball_of_.clear();
  for (std::uint32_t i = 0; i < balls.size(); ++i) {
    if (!(balls[i].radius > 0)) continue;
    present_.push_back(balls[i]);
    ball_of_.push_back(i);
  }
  tree_.rebuild(present_);
}

void GapSamples::tighten(const MovingSurface& surface, std::uint32_t region) {
  for (std::uint32_t i = first_[region]; i < first_[region + 1]; ++i) {
    const Point at = surface.at(points_[i]);
    double distance = surface.longest_side();
    nearest_[i] = kNoBall;
    if (!present_.empty()) {
      const NearestBall nearest = tree_.nearest(at);
      nearest_[i] = ball_of_[nearest.ball];
      distance = std::max(0.0, nearest.distance);
    }
    gaps_[i] = area(surface, i) * distance;
  }
  sum(region);
}

}  // namespace medial_vk
