#include "hull_fits/search/node_slabs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/point_ops.h"

namespace medial_vk {

NodeSlabs::NodeSlabs(const Bvh& bvh) {
  const std::vector<BvhNode>& nodes = bvh.nodes();
  // Children come after their parents: from the last node on, first and end of the triangles of each, and the sum of
  // their normals by area.
  std::vector<std::array<std::uint32_t, 2>> range(nodes.size());
  std::vector<Point> sums(nodes.size(), Point{});
  slabs_.resize(nodes.size());
  for (std::size_t i = nodes.size(); i-- > 0;) {
    const BvhNode& node = nodes[i];
    if (node.count == 0) {
      range[i] = {std::min(range[node.first][0], range[node.first + 1][0]),
                  std::max(range[node.first][1], range[node.first + 1][1])};
      sums[i] = sums[node.first] + sums[node.first + 1];
    } else {
      range[i] = {node.first, node.first + node.count};
      for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
        const auto& [a, b, c] = bvh.corners()[k];
        sums[i] = sums[i] + cross(b - a, c - a);
      }
    }
    const double size = length(sums[i]);
    Slab& slab = slabs_[i];
    slab = {size > 0 ? (1 / size) * sums[i] : Point{}, std::numeric_limits<double>::infinity(),
            -std::numeric_limits<double>::infinity()};
    for (std::uint32_t k = range[i][0]; k < range[i][1]; ++k) {
      for (const Point& corner : bvh.corners()[k]) {
        const double height = dot(slab.normal, corner);
        slab.low = std::min(slab.low, height);
        slab.high = std::max(slab.high, height);
      }
    }
  }
}

bool NodeSlabs::beside(std::size_t node, const BallHull& hull, double tolerance) const {
  const Slab& slab = slabs_[node];
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  for (const Ball& ball : hull.balls()) {
    const double height = dot(slab.normal, ball.centre);
    least = std::min(least, height - ball.radius);
    greatest = std::max(greatest, height + ball.radius);
  }
  return greatest <= slab.low + tolerance || least >= slab.high - tolerance;
}

}  // namespace medial_vk
