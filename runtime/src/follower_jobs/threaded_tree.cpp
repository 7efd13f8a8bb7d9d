#include "follower_jobs/threaded_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <utility>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

/// A node of the tree of the host, or a part of the triangles of a leaf that has too many.
struct Part {
  std::uint32_t node;          // of the host
  std::uint32_t first, count;  // of the triangles; a count of 0: the two children of the node
};

class TreeThreader {
 public:
  explicit TreeThreader(const Bvh& bvh) : bvh_(bvh) {}

  ThreadedTree finish() {
    add_nodes();
    add_levels();
    return std::move(tree_);
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  /// A node that waits for its children.
  struct Waiting {
    std::vector<Part> parts;
    std::uint32_t place;  // that leads to it
    std::uint32_t depth;
  };

  Part part_of(std::uint32_t node) const { return {node, bvh_.nodes()[node].first, bvh_.nodes()[node].count}; }
  bool is_leaf(const Part& part) const { return part.count != 0 && part.count <= gpu::kMostFollowLeaf; }

  std::array<Part, 2> halves_of(const Part& part) const {
    if (part.count == 0) return {part_of(part.first), part_of(part.first + 1)};
    const std::uint32_t half = std::bit_ceil(part.count) / 2;
    return {Part{part.node, part.first, half}, Part{part.node, part.first + half, part.count - half}};
  }

  double size_of(const Part& part) const {
    const BvhBox& box = bvh_.nodes()[part.node].box;
    const Point side = box.upper - box.lower;
    return is_leaf(part) ? -1 : side[0] * side[1] + side[1] * side[2] + side[2] * side[0];
  }

  /// Up to kFollowArity parts, of which the largest are divided; those that are no leaves come first.
  std::vector<Part> divided(const Part& whole) const {
    std::vector<Part> parts = {whole};
    while (parts.size() < gpu::kFollowArity) {
      const auto largest = std::ranges::max_element(parts, {}, [&](const Part& part) { return size_of(part); });
      if (is_leaf(*largest)) break;
      const std::array<Part, 2> halves = halves_of(*largest);
      *largest = halves[0];
      parts.push_back(halves[1]);
    }
    std::ranges::stable_partition(parts, [&](const Part& part) { return !is_leaf(part); });
    return parts;
  }

  std::uint32_t next_of(std::uint32_t place) const { return tree_.places[2 * std::size_t{place} + 1].w; }

  /// Breadth first, so that nodes below one node follow each other. The first node has a single place, for the box
  /// around all triangles.
  void add_nodes() {
    waiting_.push_back({{part_of(0)}, kNone, 0});
    for (std::size_t node = 0; node < waiting_.size(); ++node) {
      const Waiting now = std::move(waiting_[node]);
      tree_.depth = std::max(tree_.depth, now.depth);
      for (std::uint32_t k = 0; k < gpu::kFollowArity; ++k) add_place(now, k);
    }
    // Where nothing follows, the walk ends.
    for (std::size_t i = 1; i < tree_.places.size(); i += 2) {
      if (tree_.places[i].w == kNone) tree_.places[i].w = tree_.place_count();
    }
  }

  void add_place(const Waiting& of, std::uint32_t k) {
    constexpr std::uint32_t kLargest = std::bit_cast<std::uint32_t>(3e38f);
    constexpr std::uint32_t kLeast = std::bit_cast<std::uint32_t>(-3e38f);
    const std::uint32_t place = tree_.place_count();
    if (k >= of.parts.size()) {
      tree_.places.push_back({kLargest, kLargest, kLargest, 0});
      tree_.places.push_back({kLeast, kLeast, kLeast, 0});
      return;
    }
    const std::uint32_t after = of.place == kNone ? kNone : next_of(of.place);
    const Part& part = of.parts[k];
    const bool is_root = of.place == kNone, is_end = is_leaf(part) && !is_root;
    if (!is_end) {
      waiting_.push_back({is_leaf(part) ? std::vector<Part>{part} : divided(part), place, of.depth + 1});
    }
    const auto below = static_cast<std::uint32_t>(waiting_.size() - 1);
    tree_.places.push_back({0, 0, 0, is_end ? part.count << gpu::kFollowLeafBits | part.first : below});
    tree_.places.push_back({0, 0, 0, k + 1 < of.parts.size() ? place + 1 : after});
    used_.push_back(place);
  }

  void add_levels() {
    std::vector<std::uint32_t> heights(tree_.place_count(), 0);
    std::uint32_t highest = 0;
    for (std::size_t i = used_.size(); i-- > 0;) {  // all places below a place come after it
      const std::uint32_t link = tree_.places[2 * std::size_t{used_[i]}].w;
      if (link >> gpu::kFollowLeafBits != 0) continue;
      const auto first = heights.begin() + std::ptrdiff_t{link} * gpu::kFollowArity;
      heights[used_[i]] = 1 + *std::max_element(first, first + gpu::kFollowArity);
      highest = std::max(highest, heights[used_[i]]);
    }
    tree_.level_count = highest + 1;
    std::vector<std::uint32_t> sizes(tree_.level_count, 0);
    for (const std::uint32_t place : used_) ++sizes[heights[place]];
    tree_.levels.push_back(tree_.level_count + 1);
    for (const std::uint32_t size : sizes) tree_.levels.push_back(tree_.levels.back() + size);
    std::vector<std::uint32_t> next(tree_.levels.begin(), tree_.levels.end() - 1);
    tree_.levels.resize(tree_.levels.back());
    for (const std::uint32_t place : used_) tree_.levels[next[heights[place]]++] = place;
  }

  const Bvh& bvh_;
  ThreadedTree tree_;
  std::vector<Waiting> waiting_;     // by node
  std::vector<std::uint32_t> used_;  // places
};

}  // namespace

ThreadedTree make_threaded_tree(const Bvh& bvh) { return TreeThreader(bvh).finish(); }

}  // namespace medial_vk
