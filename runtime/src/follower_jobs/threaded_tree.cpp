#include "follower_jobs/threaded_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kMostInBlock = gpu::kMostFollowLeaf * gpu::kFollowArity;

/// Triangles that follow each other: those below a node of the host's tree, a part of one of its leaves, or a leaf.
struct Part {
  std::uint32_t node;  // of the host
  std::uint32_t first, count;
};

struct Box {
  Point lower = {1, 1, 1}, upper = {0, 0, 0};  // empty at first

  void add(const Box& other) {
    const bool is_empty = lower[0] > upper[0];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lower[axis] = is_empty ? other.lower[axis] : std::min(lower[axis], other.lower[axis]);
      upper[axis] = is_empty ? other.upper[axis] : std::max(upper[axis], other.upper[axis]);
    }
  }
  double area() const {
    const Point side = upper - lower;
    return side[0] * side[1] + side[1] * side[2] + side[2] * side[0];
  }
};

/// Cuts the triangles of a block into leaves that are full, but for one.
class BlockCutter {
 public:
  BlockCutter(const MeshView& mesh, std::span<std::uint32_t> order) : mesh_(mesh), order_(order) {}

  /// Appends the leaves.
  void cut(const Part& part, std::vector<Part>& leaves) const {
    if (part.count <= gpu::kMostFollowLeaf) return leaves.push_back(part);
    const std::span<std::uint32_t> order = order_.subspan(part.first, part.count);
    Cut best;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sort(order, axis);
      const Cut found = best_cut(order, axis);
      if (found.cost < best.cost) best = found;
    }
    sort(order, best.axis);
    const auto left = static_cast<std::uint32_t>(best.left);
    cut({part.node, part.first, left}, leaves);
    cut({part.node, part.first + left, part.count - left}, leaves);
  }

 private:
  struct Cut {
    double cost = std::numeric_limits<double>::infinity();
    std::size_t axis = 0, left = gpu::kMostFollowLeaf;
  };

  Box box_of(std::uint32_t triangle) const {
    Box box;
    for (const std::uint32_t corner : mesh_.triangles[triangle]) {
      box.add({mesh_.vertices[corner], mesh_.vertices[corner]});
    }
    return box;
  }

  void sort(std::span<std::uint32_t> order, std::size_t axis) const {
    std::ranges::sort(order, {}, [&](std::uint32_t triangle) {
      const Box box = box_of(triangle);
      return std::pair(box.lower[axis] + box.upper[axis], triangle);
    });
  }

  /// By the areas of both boxes times the numbers of leaves, one of which is that of full leaves.
  Cut best_cut(std::span<const std::uint32_t> order, std::size_t axis) const {
    constexpr std::size_t kFull = gpu::kMostFollowLeaf;
    const std::size_t count = order.size();
    std::vector<double> left_areas(count), right_areas(count);  // with the triangle; from the triangle on
    Box left, right;
    for (std::size_t i = 0; i < count; ++i) {
      left.add(box_of(order[i]));
      right.add(box_of(order[count - 1 - i]));
      left_areas[i] = left.area();
      right_areas[count - 1 - i] = right.area();
    }
    Cut best;
    for (std::size_t i = 1; i < count; ++i) {
      if (i % kFull != 0 && (count - i) % kFull != 0) continue;
      const std::size_t left_leaves = (i + kFull - 1) / kFull, right_leaves = (count - i + kFull - 1) / kFull;
      const double cost =
          left_areas[i - 1] * static_cast<double>(left_leaves) + right_areas[i] * static_cast<double>(right_leaves);
      if (cost < best.cost) best = {cost, axis, i};
    }
    return best;
  }

  const MeshView& mesh_;
  std::span<std::uint32_t> order_;
};

class TreeThreader {
 public:
  TreeThreader(const MeshView& mesh, const Bvh& bvh) : mesh_(mesh), bvh_(bvh), below_(bvh.nodes().size()) {
    tree_.order.assign(bvh.order().begin(), bvh.order().end());
    // Children come after their node.
    for (auto node = static_cast<std::uint32_t>(below_.size()); node-- > 0;) {
      const BvhNode& of = bvh.nodes()[node];
      below_[node] = {node, of.first, of.count};
      if (of.count != 0) continue;
      const Part &a = below_[of.first], &b = below_[of.first + 1];
      below_[node] = {node, std::min(a.first, b.first), a.count + b.count};
    }
  }

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

  static bool is_leaf(const Part& part) { return part.count <= gpu::kMostFollowLeaf; }

  std::array<Part, 2> halves_of(const Part& part) const {
    const BvhNode& node = bvh_.nodes()[part.node];
    if (node.count == 0) return {below_[node.first], below_[node.first + 1]};
    const std::uint32_t half = std::bit_ceil(part.count) / 2;
    return {Part{part.node, part.first, half}, Part{part.node, part.first + half, part.count - half}};
  }

  double size_of(const Part& part) const {
    const BvhBox& box = bvh_.nodes()[part.node].box;
    return part.count <= kMostInBlock ? -1 : Box{box.lower, box.upper}.area();
  }

  /// Up to kFollowArity parts; those that are no leaves come first. A block is cut into its leaves, and of others the
  /// largest parts are divided.
  std::vector<Part> divided(const Part& whole) {
    std::vector<Part> parts;
    if (whole.count <= kMostInBlock) {
      BlockCutter(mesh_, tree_.order).cut(whole, parts);
      return parts;
    }
    parts.push_back(whole);
    while (parts.size() < gpu::kFollowArity) {
      const auto largest = std::ranges::max_element(parts, {}, [&](const Part& part) { return size_of(part); });
      if (largest->count <= kMostInBlock) break;
      const std::array<Part, 2> halves = halves_of(*largest);
      *largest = halves[0];
      parts.push_back(halves[1]);
    }
    std::stable_partition(parts.begin(), parts.end(), [](const Part& part) { return !is_leaf(part); });
    return parts;
  }

  std::uint32_t next_of(std::uint32_t place) const { return tree_.places[2 * std::size_t{place} + 1].w; }

  /// Breadth first, so that nodes below one node follow each other. The first node has a single place, for the box
  /// around all triangles.
  void add_nodes() {
    waiting_.push_back({{below_[0]}, kNone, 0});
    std::size_t node = 0;
    while (node < waiting_.size()) {  // which grows
      const Waiting now = std::move(waiting_[node++]);
      tree_.depth = std::max(tree_.depth, now.depth);
      for (std::uint32_t k = 0; k < gpu::kFollowArity; ++k) add_place(now, k);
    }
    // Where nothing follows, the walk ends.
    for (std::size_t i = 1; i < tree_.places.size(); i += 2) {
      if (tree_.places[i].w == kNone) tree_.places[i].w = tree_.place_count();
    }
  }

  void add_place(const Waiting& of, std::uint32_t k) {
    // Farther from all balls than they are large, and near enough that no square becomes infinite: devices need not
    // support infinities.
    constexpr float kFar = 0x1p40f;
    static_assert(kFar > 4 * gpu::kMostFollowCoordinate);
    constexpr std::uint32_t kLargest = std::bit_cast<std::uint32_t>(kFar);
    constexpr std::uint32_t kLeast = std::bit_cast<std::uint32_t>(-kFar);
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
      waiting_.push_back({divided(part), place, of.depth + 1});
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

  const MeshView& mesh_;
  const Bvh& bvh_;
  std::vector<Part> below_;  // of each node of the host
  ThreadedTree tree_;
  std::vector<Waiting> waiting_;     // by node
  std::vector<std::uint32_t> used_;  // places
};

}  // namespace

ThreadedTree make_threaded_tree(const MeshView& mesh, const Bvh& bvh) { return TreeThreader(mesh, bvh).finish(); }

std::vector<std::uint32_t> positions_in(const ThreadedTree& tree) {
  std::vector<std::uint32_t> positions(tree.order.size());
  for (std::uint32_t i = 0; i < positions.size(); ++i) positions[tree.order[i]] = i;
  return positions;
}

}  // namespace medial_vk
