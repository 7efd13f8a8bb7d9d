#include "plane/thesis/boundary_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace medial_vk::plane {
namespace {

double squared_distance(const Box& box, Vec2 x) {
  const double dx = std::max({box.lower.x - x.x, x.x - box.upper.x, 0.0});
  const double dy = std::max({box.lower.y - x.y, x.y - box.upper.y, 0.0});
  return dx * dx + dy * dy;
}

double squared_distance(const Segment& s, Vec2 x) {
  const Vec2 from = x - s.begin;
  const Vec2 rest = from - std::clamp(dot(s.along, from), 0.0, s.length) * s.along;
  return dot(rest, rest);
}

}  // namespace

BoundaryTree::BoundaryTree(const SiteSet& sites) : sites_(sites), order_(sites.size() - sites.points()) {
  std::iota(order_.begin(), order_.end(), sites.points());
  nodes_.reserve(order_.size());
  build(0, static_cast<std::uint32_t>(order_.size()));
}

Box BoundaryTree::box_of_segments(std::uint32_t first, std::uint32_t last) const {
  Box box;
  for (std::uint32_t i = first; i < last; ++i) {
    for (const std::uint32_t end : sites_.segment(order_[i]).ends) box.add(sites_.point(end));
  }
  return box;
}

std::uint32_t BoundaryTree::build(std::uint32_t first, std::uint32_t last) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  const Box box = box_of_segments(first, last);
  if (last - first <= kLeafSegments) {
    nodes_.push_back({box, first, last - first});
    return index;
  }
  nodes_.push_back({box, 0, 0});
  const bool by_x = box.upper.x - box.lower.x >= box.upper.y - box.lower.y;
  const auto middle_of = [&](std::uint32_t site) {
    const Segment& s = sites_.segment(site);
    const Vec2 twice = sites_.point(s.ends[0]) + sites_.point(s.ends[1]);
    return by_x ? twice.x : twice.y;
  };
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(
      order_.begin() + first, order_.begin() + middle, order_.begin() + last,
      [&](std::uint32_t a, std::uint32_t b) { return std::pair(middle_of(a), a) < std::pair(middle_of(b), b); });
  build(first, middle);
  const std::uint32_t second = build(middle, last);
  nodes_[index].first = second;
  return index;
}

Foot BoundaryTree::foot_on(std::uint32_t site, Vec2 x) const {
  const Segment& s = sites_.segment(site);
  const double position = s.position(x);
  if (position > 0 && position < s.length) {
    const double height = s.height(x, Side::kLeft);
    return {site, s.begin + position * s.along, height >= 0 ? -left_of(s.along) : left_of(s.along), std::fabs(height)};
  }
  const std::uint32_t end = s.ends[position > 0 ? 1 : 0];
  const Vec2 at = sites_.point(end);
  const double distance = plane::distance(at, x);
  return {end, at, distance > 0 ? (1 / distance) * (at - x) : Vec2{1, 0}, distance};
}

Foot BoundaryTree::nearest(Vec2 x) const {
  struct Open {
    std::uint32_t node;
    double squared;
  };
  std::array<Open, 64> open;  // a level of the tree adds one, and halves make at most 32 levels
  std::size_t count = 0;
  open[count++] = {0, 0};
  double least = std::numeric_limits<double>::infinity();
  std::uint32_t site = order_.front();
  while (count > 0) {
    const auto [index, squared] = open[--count];
    if (squared >= least) continue;
    const Node& node = nodes_[index];
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const double here = squared_distance(sites_.segment(order_[i]), x);
      if (here < least) {
        least = here;
        site = order_[i];
      }
    }
    if (node.count > 0) continue;
    Open near = {index + 1, squared_distance(nodes_[index + 1].box, x)};
    Open far = {node.first, squared_distance(nodes_[node.first].box, x)};
    if (far.squared < near.squared) std::swap(near, far);
    open[count++] = far;
    open[count++] = near;
  }
  return foot_on(site, x);
}

}  // namespace medial_vk::plane
