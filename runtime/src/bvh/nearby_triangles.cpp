#include "bvh/nearby_triangles.h"

#include <array>
#include <cmath>

namespace medial_vk {
namespace {

/// Calls `visit` with every leaf whose box is within the limit. Boxes are tested before they are pushed onto the stack,
/// so most never are.
template <class Visit>
void for_each_leaf(const std::vector<BvhNode>& nodes, const Point& p, double squared_limit, Visit visit) {
  std::array<std::uint32_t, Bvh::kMaxDepth + 1> stack;
  std::size_t size = 0;
  if (squared_distance(nodes[0].box, p) <= squared_limit) stack[size++] = 0;
  while (size > 0) {
    std::uint32_t node = stack[--size];
    bool is_near = true;
    while (is_near && nodes[node].count == 0) {
      const std::uint32_t first = nodes[node].first;
      const double to_first = squared_distance(nodes[first].box, p);
      const double to_second = squared_distance(nodes[first + 1].box, p);
      const std::uint32_t nearer = to_second < to_first ? 1 : 0;
      is_near = std::min(to_first, to_second) <= squared_limit;
      if (std::max(to_first, to_second) <= squared_limit) stack[size++] = first + 1 - nearer;
      node = first + nearer;
    }
    if (is_near) visit(node);
  }
}

}  // namespace

void gather_within(const Bvh& bvh, const Point& centre, double radius, std::vector<std::uint32_t>& positions) {
  positions.clear();
  const double limit = radius * radius;
  const std::vector<BvhNode>& nodes = bvh.nodes();
  for_each_leaf(nodes, centre, limit, [&](std::uint32_t leaf) {
    const std::uint32_t end = nodes[leaf].first + nodes[leaf].count;
    for (std::uint32_t i = nodes[leaf].first; i < end; ++i)
      if (!clearly_beyond(centre, bvh.corners()[i], limit)) positions.push_back(i);
  });
}

void gather_leaves(const Bvh& bvh, const Point& centre, double radius, std::vector<std::uint32_t>& leaves) {
  leaves.clear();
  for_each_leaf(bvh.nodes(), centre, radius * radius, [&](std::uint32_t leaf) { leaves.push_back(leaf); });
}

BvhHit closest_of(const Bvh& bvh, const Point& p, std::span<const std::uint32_t> positions, BvhHit best) {
  for (const std::uint32_t position : positions) improve_hit(bvh, p, position, best);
  return best;
}

std::size_t find_within(const Bvh& bvh, const Point& p, double radius, const std::vector<std::uint32_t>& positions) {
  // Slightly above the square, so that no skipped triangle could be found by rounding.
  const double limit = radius * radius * (1 + 1e-12);
  const auto found = std::ranges::find_if(positions, [&](std::uint32_t i) {
    return !clearly_beyond(p, bvh.corners()[i], limit) &&
           std::sqrt(nearest_on_triangle(p, bvh.corners()[i]).squared_distance) < radius;
  });
  return static_cast<std::size_t>(found - positions.begin());
}

}  // namespace medial_vk
