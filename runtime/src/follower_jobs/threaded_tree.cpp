#include "follower_jobs/threaded_tree.h"

#include <algorithm>
#include <cstddef>

namespace medial_vk {
namespace {

class TreeThreader {
 public:
  explicit TreeThreader(const Bvh& bvh) : bvh_(bvh) { add(0); }

  ThreadedTree finish() {
    add_levels();
    return std::move(tree_);
  }

 private:
  std::size_t begin_node(std::uint32_t leaf) {
    tree_.nodes.push_back({0, 0, 0, leaf});
    tree_.nodes.push_back({0, 0, 0, 0});
    heights_.push_back(0);
    return heights_.size() - 1;
  }
  /// Everything that was added since belongs to the node.
  void end_node(std::size_t node) { tree_.nodes[2 * node + 1].w = static_cast<std::uint32_t>(heights_.size()); }

  /// Recursion as deep as the tree: Bvh::kMaxDepth. Returns the height.
  std::uint32_t add(std::uint32_t index) {
    const BvhNode& node = bvh_.nodes()[index];
    if (node.count != 0 && node.count <= gpu::kMostFollowLeaf) {
      end_node(begin_node(node.count << gpu::kFollowLeafBits | node.first));
      return 0;
    }
    const std::size_t own = begin_node(0);
    std::uint32_t below = 0;
    if (node.count == 0) {
      below = add(node.first);
      below = std::max(below, add(node.first + 1));
    }
    for (std::uint32_t i = 0; i < node.count; i += gpu::kMostFollowLeaf) {
      const std::uint32_t count = std::min(gpu::kMostFollowLeaf, node.count - i);
      end_node(begin_node(count << gpu::kFollowLeafBits | (node.first + i)));
    }
    end_node(own);
    return heights_[own] = below + 1;
  }

  void add_levels() {
    tree_.level_count = *std::ranges::max_element(heights_) + 1;
    std::vector<std::uint32_t> sizes(tree_.level_count, 0);
    for (const std::uint32_t height : heights_) ++sizes[height];
    tree_.levels.push_back(tree_.level_count + 1);
    for (const std::uint32_t size : sizes) tree_.levels.push_back(tree_.levels.back() + size);
    std::vector<std::uint32_t> next(tree_.levels.begin(), tree_.levels.end() - 1);
    tree_.levels.resize(tree_.levels.back());
    for (std::uint32_t node = 0; node < heights_.size(); ++node) tree_.levels[next[heights_[node]]++] = node;
  }

  const Bvh& bvh_;
  ThreadedTree tree_;
  std::vector<std::uint32_t> heights_;  // by node
};

}  // namespace

ThreadedTree make_threaded_tree(const Bvh& bvh) { return TreeThreader(bvh).finish(); }

}  // namespace medial_vk
