#include "medial/near_triangles.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/point_ops.h"

namespace medial_vk {
namespace {

// How much nearer a triangle may be than lanes_near() says, and a box than boxes_near() does, which rounds less. The
// unit is the longest side of the tree's box, whose middle is the origin; balls have their centres within 1 of it,
// along each axis, and radii below 1. With u = 2^-24: rounding moves the centre by u and the corners by u / 2 a
// coordinate, and their differences by 1.5 u: 5.2 u in all. A product s.a is off by 4 u |s| |a| with |a| < 2.6. That is
// less than 16 u = 9.6e-7; the squares of limit, s and s.a add less than 1e-6.
constexpr double kMargin = 4e-6;

double square(double x) { return x * x; }

}  // namespace

NearTriangles::NearTriangles(const Bvh& bvh) : bvh_(bvh) {
  const BvhBox& box = bvh.nodes().front().box;
  origin_ = 0.5 * (box.lower + box.upper);
  scale_ = 1 / std::ranges::max(box.upper - box.lower);
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

void NearTriangles::surround(const Point& centre, double radius, Region& region) const {
  region.centre = centre;
  region.radius = radius;
  bvh_.gather_leaves(centre, radius, region.leaves);
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
  std::array<float, kLanes> squared{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      const float below = region.boxes[axis][first + k] - query.centre[axis];
      const float above = query.centre[axis] - region.boxes[3 + axis][first + k];
      const float away = std::max(std::max(below, above), 0.0f);
      squared[k] += away * away;
    }
  }
  unsigned near = 0;
  for (std::size_t k = 0; k < kLanes; ++k) near |= (squared[k] > query.squared_limit ? 0u : 1u) << k;
  return near;
}

// A bit for each of the four triangles from `position` on: not set if the plane at the limit's distance across the
// direction s, to about its middle, separates it from the centre, that is, if s.(corner - centre) > limit |s| for its
// corners.
NearTriangles::Lanes NearTriangles::lanes_near(const Query& query, std::size_t position) const {
  std::array<std::array<float, kLanes>, 9> v;
  for (std::size_t c = 0; c < 9; ++c)
    for (std::size_t k = 0; k < kLanes; ++k) v[c][k] = corners_[c][position + k] - query.centre[c % 3];
  std::array<std::array<float, kLanes>, 3> s;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t k = 0; k < kLanes; ++k) s[axis][k] = v[axis][k] + v[3 + axis][k] + v[6 + axis][k];
  std::array<std::array<float, kLanes>, 3> along;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t k = 0; k < kLanes; ++k)
      along[c][k] = s[0][k] * v[3 * c][k] + s[1][k] * v[3 * c + 1][k] + s[2][k] * v[3 * c + 2][k];
  Lanes lanes = {0, 0};
  for (std::size_t k = 0; k < kLanes; ++k) {
    const float least = std::max(std::min(std::min(along[0][k], along[1][k]), along[2][k]), 0.0f);
    const float squared = s[0][k] * s[0][k] + s[1][k] * s[1][k] + s[2][k] * s[2][k];
    lanes.near |= (least * least > query.squared_limit * squared ? 0u : 1u) << k;
    lanes.inner |= (least * least > query.inner_squared_limit * squared ? 0u : 1u) << k;
  }
  return lanes;
}

std::size_t NearTriangles::gather(const Region& region, const Point& centre, double radius, double inner_radius,
                                  std::vector<std::uint32_t>& positions) const {
  const auto squared = [this](double r) { return static_cast<float>(square(scale_ * r + kMargin)); };
  const Query query = {rounded(centre), squared(radius), squared(inner_radius)};
  const bool is_in_reach = std::ranges::all_of(query.centre, [](float x) { return std::fabs(x) < 1; });
  if (!is_in_reach || length(centre - region.centre) + radius > region.radius) {
    bvh_.gather_within(centre, radius, positions);
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
