#include "bvh/bvh_boxes.h"

#include <vector>

#include "base/parallel.h"
#include "base/point_ops.h"

namespace medial_vk {
namespace {

/// Consecutive nodes that one thread processes.
constexpr std::uint32_t kMostNodes = 16384;

void fit(std::span<BvhNode> nodes, std::span<const std::array<Point, 3>> corners, std::uint32_t index) {
  BvhNode& node = nodes[index];
  if (node.count == 0) {
    const BvhBox& left = nodes[node.first].box;
    const BvhBox& right = nodes[node.first + 1].box;
    node.box = {least(left.lower, right.lower), greatest(left.upper, right.upper)};
    return;
  }
  node.box = {corners[node.first][0], corners[node.first][0]};
  for (const auto& triangle : corners.subspan(node.first, node.count)) {
    for (const Point& corner : triangle) {
      node.box.lower = least(node.box.lower, corner);
      node.box.upper = greatest(node.box.upper, corner);
    }
  }
}

/// A node and the run of all nodes below it.
struct Subtree {
  std::uint32_t root, begin, end;
};

}  // namespace

void fit_boxes(std::span<BvhNode> nodes, std::span<const std::array<Point, 3>> corners, unsigned threads) {
  if (threads == 1 || nodes.size() <= kMostNodes) {  // without lists, so that a frame of a motion allocates nothing
    for (std::size_t node = nodes.size(); node-- > 0;) fit(nodes, corners, static_cast<std::uint32_t>(node));
    return;
  }
  std::vector<Subtree> subtrees;
  std::vector<std::uint32_t> above;  // their ancestors, parents first
  std::vector<Subtree> pending = {{0, 1, static_cast<std::uint32_t>(nodes.size())}};
  while (!pending.empty()) {
    const Subtree s = pending.back();
    pending.pop_back();
    if (s.end - s.begin <= kMostNodes) {
      subtrees.push_back(s);
      continue;
    }
    above.push_back(s.root);
    // The pair, the nodes below its first node, those below its second.
    const std::uint32_t left = nodes[s.root].first, right = left + 1;
    const std::uint32_t middle = nodes[right].count == 0 ? nodes[right].first : s.end;
    pending.push_back({right, middle, s.end});
    pending.push_back({left, left + 2, middle});
  }
  parallel_blocks(subtrees.size(), 1, threads, [&](std::size_t i, std::size_t) {
    for (std::uint32_t node = subtrees[i].end; node-- > subtrees[i].begin;) fit(nodes, corners, node);
    fit(nodes, corners, subtrees[i].root);
  });
  while (!above.empty()) {
    fit(nodes, corners, above.back());
    above.pop_back();
  }
}

}  // namespace medial_vk
