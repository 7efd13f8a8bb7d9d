#include "certificate/near_triangles.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/point_ops.h"
#include "bvh/nearby_triangles.h"
#include "certificate/float_lanes.h"

namespace medial_vk {
namespace {

// The amount by which a triangle may be nearer than the bounds of lanes_near() and squared_bounds(), and a box than
// that of boxes_near(). The unit is the longest side of the box, whose middle is the origin; balls have their
// centres within 1 of it, along each axis; |a| below is the distance of a centre and a corner, for any radius. With u =
// 2^-24: rounding moves the centre by u and the corners by u / 2 a coordinate, and their differences by 1.5 u: 5.2 u in
// all. A product s.a has an error of 4 u |s| |a| with |a| < 2.6. That is less than 16 u = 9.6e-7; the squares of limit,
// s and s.a, and their quotient, add less than 1e-6.
constexpr double kMargin = 4e-6;

double square(double x) { return x * x; }

bool is_in_reach(const std::array<float, 3>& p) {
  return std::ranges::all_of(p, [](float x) { return std::fabs(x) < 1; });
}

/// The least component of triangles along s, times the length of s; 0 if that is behind the origin.
Floats least_along(const Vectors& s, const std::array<Vectors, 3>& corners) {
  return max(least(dot(s, corners[0]), dot(s, corners[1]), dot(s, corners[2])), kZero);
}

/// Approximately the points of segments from a to b that are nearest to the origin.
Vectors toward_segments(const Vectors& a, const Vectors& b) {
  const Vectors edge = b - a;
  const Floats t = -dot(a, edge) / max(dot(edge, edge), kTiny);
  return a + min(max(t, kZero), kOne) * edge;
}

/// Approximately the points of triangles that are nearest to the origin.
Vectors toward_triangles(const Vectors& a, const Vectors& b, const Vectors& c) {
  const Vectors normal = cross(b - a, c - a);
  const Floats inside = least(dot(cross(a, b), normal), dot(cross(b, c), normal), dot(cross(c, a), normal));
  const Vectors edges = shorter(toward_segments(a, b), shorter(toward_segments(b, c), toward_segments(c, a)));
  const Vectors foot = dot(a, normal) / max(dot(normal, normal), kTiny) * normal;
  return choose(inside > kZero, foot, edges);
}

}  // namespace

NearTriangles::NearTriangles(const Bvh& bvh)
    : NearTriangles(bvh, bvh.nodes().front().box.lower, bvh.nodes().front().box.upper) {}

NearTriangles::NearTriangles(const Bvh& bvh, const Point& lower, const Point& upper)
    : bvh_(bvh), origin_(0.5 * (lower + upper)), scale_(1 / std::ranges::max(upper - lower)) {
  for (std::vector<float>& coordinates : corners_) coordinates.resize(bvh.corners().size() + kLanes);
  for (std::size_t i = 0; i < bvh.corners().size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::array<float, 3> corner = rounded(bvh.corners()[i][k]);
      for (std::size_t axis = 0; axis < 3; ++axis) corners_[3 * k + axis][i] = corner[axis];
    }
  }
}

std::array<float, 3> NearTriangles::rounded(const Point& p) const {
  const Point q = scale_ * (p - origin_);
  return {static_cast<float>(q[0]), static_cast<float>(q[1]), static_cast<float>(q[2])};
}

float NearTriangles::squared_limit(double radius) const {
  return static_cast<float>(square(scale_ * radius + kMargin));
}

void NearTriangles::surround(const Point& centre, double radius, Region& region) const {
  region.centre = centre;
  region.radius = radius;
  gather_leaves(bvh_, centre, radius, region.leaves);
  for (std::vector<float>& side : region.boxes) side.resize(region.leaves.size() + kLanes);
  for (std::size_t i = 0; i < region.leaves.size(); ++i) {
    const BvhBox& box = bvh_.nodes()[region.leaves[i]].box;
    const std::array<float, 3> lower = rounded(box.lower), upper = rounded(box.upper);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      region.boxes[axis][i] = lower[axis];
      region.boxes[3 + axis][i] = upper[axis];
    }
  }
}

// A bit for each of the four leaves from `first` on: not set if its box is farther away than the limit.
unsigned NearTriangles::boxes_near(const Query& query, const Region& region, std::size_t first) const {
  Floats squared = kZero;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Floats below = four(region.boxes[axis], first) - query.centre[axis];
    const Floats above = query.centre[axis] - four(region.boxes[3 + axis], first);
    const Floats away = max(max(below, above), kZero);
    squared += away * away;
  }
  return bits(~(squared > query.squared_limit));
}

// A bit for each of the four triangles from `position` on: not set if the plane at the limit's distance perpendicular
// to s, the direction to about its middle, separates it from the centre, that is, if s.(corner - centre) > limit |s|
// for its corners.
NearTriangles::Lanes NearTriangles::lanes_near(const Query& query, std::size_t position) const {
  std::array<Vectors, 3> v;
  for (std::size_t c = 0; c < 9; ++c) v[c / 3][c % 3] = four(corners_[c], position) - query.centre[c % 3];
  const Vectors s = v[0] + v[1] + v[2];
  const Floats along = least_along(s, v), squared = dot(s, s);
  return {bits(~(along * along > query.squared_limit * squared)),
          bits(~(along * along > query.inner_squared_limit * squared))};
}

std::size_t NearTriangles::gather(const Region& region, const Point& centre, double radius, double inner_radius,
                                  std::vector<std::uint32_t>& positions) const {
  const Query query = {rounded(centre), squared_limit(radius), squared_limit(inner_radius)};
  if (!is_in_reach(query.centre) || length(centre - region.centre) + radius > region.radius) {
    gather_within(bvh_, centre, radius, positions);
    return positions.size();
  }
  std::size_t inner_count = 0;
  positions.clear();
  for (std::size_t first = 0; first < region.leaves.size(); first += kLanes) {
    const unsigned near = boxes_near(query, region, first);
    for (std::size_t k = 0; k < std::min(kLanes, region.leaves.size() - first); ++k)
      if ((near >> k & 1) != 0) gather_leaf(query, region.leaves[first + k], inner_count, positions);
  }
  return inner_count;
}

// Lower bounds of the squared distances of four triangles (the last ones may be the same), except for the margin of
// squared_limit(). As in lanes_near(), they come from a plane perpendicular to a direction; here it is that of the
// nearest point, where the plane touches.
std::array<float, NearTriangles::kLanes> NearTriangles::squared_bounds(const std::array<float, 3>& p,
                                                                       std::span<const std::uint32_t> positions) const {
  std::array<Vectors, 3> v;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const std::uint32_t position = positions[std::min(k, positions.size() - 1)];
    for (std::size_t c = 0; c < 9; ++c) v[c / 3][c % 3][k] = corners_[c][position];
  }
  for (std::size_t c = 0; c < 9; ++c) v[c / 3][c % 3] = v[c / 3][c % 3] - p[c % 3];
  const Vectors s = toward_triangles(v[0], v[1], v[2]);
  const Floats along = least_along(s, v);
  const Floats bounds = along * along / max(dot(s, s), kTiny);
  return {bounds[0], bounds[1], bounds[2], bounds[3]};
}

BvhHit NearTriangles::closest_of(const Point& p, std::span<std::uint32_t> positions, std::vector<float>& bounds) const {
  const std::array<float, 3> centre = rounded(p);
  if (positions.empty() || !is_in_reach(centre)) return medial_vk::closest_of(bvh_, p, positions);
  bounds.resize(positions.size() + kLanes);
  for (std::size_t first = 0; first < positions.size(); first += kLanes)
    std::ranges::copy(squared_bounds(centre, positions.subspan(first)),
                      bounds.begin() + static_cast<std::ptrdiff_t>(first));
  const auto end = bounds.begin() + static_cast<std::ptrdiff_t>(positions.size());
  const auto likely = static_cast<std::size_t>(std::min_element(bounds.begin(), end) - bounds.begin());
  const BvhHit hit = medial_vk::closest_of(bvh_, p, positions.subspan(likely, 1));
  const float limit = squared_limit(std::sqrt(hit.squared_distance));
  std::size_t kept = 0;
  for (std::size_t i = 0; i < positions.size(); ++i)
    if (i != likely && !(bounds[i] > limit)) std::swap(positions[i], positions[kept++]);
  return medial_vk::closest_of(bvh_, p, positions.first(kept), hit);
}

void NearTriangles::gather_leaf(const Query& query, std::uint32_t leaf, std::size_t& inner_count,
                                std::vector<std::uint32_t>& positions) const {
  const BvhNode& node = bvh_.nodes()[leaf];
  for (std::uint32_t first = 0; first < node.count; first += kLanes) {
    const Lanes lanes = lanes_near(query, node.first + first);
    for (std::uint32_t k = 0; k < std::min<std::uint32_t>(kLanes, node.count - first); ++k) {
      if ((lanes.near >> k & 1) == 0) continue;
      positions.push_back(node.first + first + k);
      if ((lanes.inner >> k & 1) != 0) std::swap(positions.back(), positions[inner_count++]);
    }
  }
}

}  // namespace medial_vk
