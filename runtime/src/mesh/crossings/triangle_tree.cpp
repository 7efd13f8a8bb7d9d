#include "mesh/crossings/triangle_tree.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

namespace medial_vk {
namespace {

constexpr std::uint32_t kLeafSize = 4;

/// Spreads the lower 21 bits, two zeros after each.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x001f00000000ffffull;
  x = (x | x << 16) & 0x001f0000ff0000ffull;
  x = (x | x << 8) & 0x100f00f00f00f00full;
  x = (x | x << 4) & 0x10c30c30c30c30c3ull;
  return (x | x << 2) & 0x1249249249249249ull;
}

void grow(TreeBox& box, const Point& lower, const Point& upper) {
  for (int k = 0; k < 3; ++k) {
    box.lower[k] = std::min(box.lower[k], lower[k]);
    box.upper[k] = std::max(box.upper[k], upper[k]);
  }
}

TreeBox empty_box() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
}

}  // namespace

TriangleTree::TriangleTree(const Mesh& mesh) {
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  TreeBox all = empty_box();
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) grow(all, mesh.vertices[v], mesh.vertices[v]);
  }
  // One scale for all axes, so that cells are cubes.
  double longest = 0;
  for (int k = 0; k < 3; ++k) longest = std::max(longest, all.upper[k] - all.lower[k]);
  constexpr double kCells = 2097151;  // 2^21 - 1
  const double scale = longest > 0 ? kCells / longest : 0;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> sorted(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Triangle& t = mesh.triangles[i];
    std::uint64_t code = 0;
    for (int k = 0; k < 3; ++k) {
      double mean = 0;
      for (const std::uint32_t v : t) mean += (mesh.vertices[v][k] - all.lower[k]) / 3;
      code |= spread(static_cast<std::uint64_t>(std::clamp(mean * scale, 0.0, kCells))) << k;
    }
    sorted[i] = {code, i};
  }
  std::sort(sorted.begin(), sorted.end());

  std::vector<std::uint64_t> codes(count);
  order.resize(count);
  corners.resize(count);
  boxes.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    codes[i] = sorted[i].first;
    order[i] = sorted[i].second;
    boxes[i] = empty_box();
    for (int k = 0; k < 3; ++k) {
      corners[i][k] = mesh.vertices[mesh.triangles[order[i]][k]];
      grow(boxes[i], corners[i][k], corners[i][k]);
    }
  }
  nodes.reserve(count);
  if (count > 0) add_node(codes, 0, count);
}

std::uint32_t TriangleTree::add_node(const std::vector<std::uint64_t>& codes, std::uint32_t first,
                                     std::uint32_t count) {
  const auto index = static_cast<std::uint32_t>(nodes.size());
  nodes.push_back({empty_box(), first, count, 0, 0});
  if (count <= kLeafSize) {
    for (std::uint32_t i = first; i < first + count; ++i) grow(nodes[index].box, boxes[i].lower, boxes[i].upper);
    return index;
  }
  // At most 63 levels split by a bit; equal codes are halved, at most 32 levels more.
  std::uint32_t middle = first + count / 2;
  const std::uint64_t changed = codes[first] ^ codes[first + count - 1];
  if (changed != 0) {
    const std::uint64_t bit = std::bit_floor(changed);
    const auto begin = codes.begin() + first;
    const auto split = std::partition_point(begin, begin + count, [&](std::uint64_t c) { return (c & bit) == 0; });
    middle = first + static_cast<std::uint32_t>(split - begin);
  }
  const std::uint32_t left = add_node(codes, first, middle - first);
  const std::uint32_t right = add_node(codes, middle, first + count - middle);
  Node& node = nodes[index];
  node.left = left;
  node.right = right;
  for (const std::uint32_t child : {left, right}) grow(node.box, nodes[child].box.lower, nodes[child].box.upper);
  return index;
}

}  // namespace medial_vk
