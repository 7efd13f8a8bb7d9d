#include "bvh/bvh_builder.h"

#include <algorithm>

#include "base/parallel.h"
#include "bvh/bvh_bins.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kBlock = 8192;          // of a range that all threads split together
constexpr std::uint32_t kParallelFrom = 16384;  // below this, synchronisation can cost more than threads save
constexpr std::uint32_t kLeastSubtree = 2048;
constexpr std::uint32_t kSubtreesPerMesh = 32;  // about; enough that threads end at nearly the same time

}  // namespace

BvhBuilder::BvhBuilder(std::vector<BvhPrimitive> primitives, std::uint32_t leaf_size, unsigned threads)
    : leaf_size_(leaf_size), threads_(primitives.size() < kParallelFrom ? 1 : threads) {
  order_.resize(primitives.size());
  arrays_[1].resize(primitives.size());
  arrays_[0] = std::move(primitives);
}

std::vector<BvhNode> BvhBuilder::build() {
  split_tops();
  build_subtrees();
  return lay_out();
}

BvhBuilder::Range BvhBuilder::whole() const {
  std::vector<BuildBox> blocks((order_.size() + kBlock - 1) / kBlock, kEmptyBox);
  parallel_blocks(order_.size(), kBlock, threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) grow_by_centre(blocks[begin / kBlock], arrays_[0][i]);
  });
  Range range;
  range.end = static_cast<std::uint32_t>(order_.size());
  range.centres = kEmptyBox;
  for (const BuildBox& block : blocks) grow(range.centres, block);
  return range;
}

/// Splits the root, its children and so on, each with all threads, until there are enough subtrees for them.
void BvhBuilder::split_tops() {
  const auto largest = std::max(kLeastSubtree, static_cast<std::uint32_t>(order_.size()) / kSubtreesPerMesh);
  tops_.push_back({whole(), 0, 0, {}, 0, 0});
  for (std::uint32_t i = 0; i < tops_.size(); ++i) {
    if (tops_[i].range.count() <= std::max(largest, leaf_size_)) continue;
    const Pair pair = split(tops_[i].range, threads_);
    tops_[i].left = static_cast<std::uint32_t>(tops_.size());
    tops_[i].right = tops_[i].left + 1;
    tops_.push_back({pair.left, 0, 0, {}, 0, 0});
    tops_.push_back({pair.right, 0, 0, {}, 0, 0});
  }
}

/// The largest first, so that none is left for the end.
void BvhBuilder::build_subtrees() {
  std::vector<std::uint32_t> roots;
  for (std::uint32_t i = 0; i < tops_.size(); ++i) {
    if (tops_[i].left == 0) roots.push_back(i);
  }
  std::stable_sort(roots.begin(), roots.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return tops_[a].range.count() > tops_[b].range.count(); });
  parallel_blocks(roots.size(), 1, threads_, [&](std::size_t i, std::size_t) {
    Top& top = tops_[roots[i]];
    top.subtree.reserve(2 * std::size_t{top.range.count()} / std::max(1u, leaf_size_ / 2) + 1);
    top.subtree.resize(1);
    build_subtree(top.range, 0, top.subtree);
  });
}

void BvhBuilder::build_subtree(const Range& range, std::uint32_t position, std::vector<Link>& out) {
  // A tree that is refined may be as deep as a traversal's stack allows.
  if (range.count() <= leaf_size_ || range.depth >= Bvh::kMaxDepth) return make_leaf(range, out[position]);
  const Pair pair = split(range, 1);
  const auto first = static_cast<std::uint32_t>(out.size());
  out[position] = {first, 0};
  out.resize(out.size() + 2);
  build_subtree(pair.left, first, out);
  build_subtree(pair.right, first + 1, out);
}

std::vector<BvhNode> BvhBuilder::refine(const std::vector<BvhNode>& coarse) {
  std::vector<Link> links(1);
  links.reserve(2 * coarse.size());
  refine_subtree(coarse, 0, 0, 0, links);
  std::vector<BvhNode> nodes(links.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    nodes[i].first = links[i].first;
    nodes[i].count = links[i].count;
  }
  return nodes;
}

void BvhBuilder::refine_subtree(const std::vector<BvhNode>& coarse, std::uint32_t node, std::uint32_t depth,
                                std::uint32_t position, std::vector<Link>& out) {
  const BvhNode& from = coarse[node];
  if (from.count != 0) {
    Range range = {from.first, from.first + from.count, depth, 0, kEmptyBox};
    for (std::uint32_t i = range.begin; i < range.end; ++i) grow_by_centre(range.centres, arrays_[0][i]);
    return build_subtree(range, position, out);
  }
  const auto first = static_cast<std::uint32_t>(out.size());
  out[position] = {first, 0};
  out.resize(out.size() + 2);
  refine_subtree(coarse, from.first, depth + 1, first, out);
  refine_subtree(coarse, from.first + 1, depth + 1, first + 1, out);
}

void BvhBuilder::make_leaf(const Range& range, Link& leaf) {
  leaf = {range.begin, range.count()};
  for (std::uint32_t i = range.begin; i < range.end; ++i) order_[i] = arrays_[range.array][i].triangle;
  std::sort(order_.begin() + range.begin, order_.begin() + range.end);  // a split at the median permutes them
}

/// Levels below a node of `count` triangles if every split halves it.
std::uint32_t BvhBuilder::levels_of_halving(std::uint32_t count) const {
  std::uint32_t levels = 0;
  for (std::uint64_t room = leaf_size_; room < count; room *= 2) ++levels;
  return levels;
}

BvhBuilder::Pair BvhBuilder::split(const Range& range, unsigned threads) {
  // SAH may peel off a few triangles at a time; when the depth is nearly used up only halving still fits.
  if (range.depth + 1 + levels_of_halving(range.count()) >= Bvh::kMaxDepth) return split_at_median(range);
  return threads > 1 && range.count() >= 2 * kBlock ? split_wide(range, threads) : split_here(range);
}

BvhBuilder::Pair BvhBuilder::split_here(const Range& range) {
  const BuildBins bins = fill_bins(range, range.begin, range.end);
  const BuildPlane plane(range.centres, bins);
  if (!plane.exists()) return split_at_median(range);
  Pair pair = halves(range, range.begin + plane.count_left(bins));
  move_apart(range, plane, range.begin, range.end, pair);
  return pair;
}

/// The same by blocks. Minima and counts add up to the same in any grouping, and primitives on one side keep their
/// order: the result depends neither on blocks nor on threads.
BvhBuilder::Pair BvhBuilder::split_wide(const Range& range, unsigned threads) {
  std::vector<BuildBins> blocks((range.count() + kBlock - 1) / kBlock);
  const auto for_each_block = [&](auto body) {
    parallel_blocks(range.count(), kBlock, threads, [&](std::size_t begin, std::size_t end) {
      body(begin / kBlock, range.begin + static_cast<std::uint32_t>(begin),
           range.begin + static_cast<std::uint32_t>(end));
    });
  };
  for_each_block(
      [&](std::size_t block, std::uint32_t begin, std::uint32_t end) { blocks[block] = fill_bins(range, begin, end); });
  BuildBins bins;
  for (const BuildBins& block : blocks) bins.add(block);
  const BuildPlane plane(range.centres, bins);
  if (!plane.exists()) return split_at_median(range);

  Pair pair = halves(range, range.begin + plane.count_left(bins));
  std::vector<Pair> parts(blocks.size(), pair);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const std::uint32_t left = plane.count_left(blocks[i - 1]);
    parts[i].left.begin = parts[i - 1].left.begin + left;
    parts[i].right.begin = parts[i - 1].right.begin + (kBlock - left);
  }
  for_each_block([&](std::size_t block, std::uint32_t begin, std::uint32_t end) {
    move_apart(range, plane, begin, end, parts[block]);
  });
  for (const Pair& part : parts) {
    grow(pair.left.centres, part.left.centres);
    grow(pair.right.centres, part.right.centres);
  }
  return pair;
}

BvhBuilder::Pair BvhBuilder::halves(const Range& range, std::uint32_t middle) {
  const std::uint32_t depth = range.depth + 1, array = 1 - range.array;
  return {{range.begin, middle, depth, array, kEmptyBox}, {middle, range.end, depth, array, kEmptyBox}};
}

BuildBins BvhBuilder::fill_bins(const Range& range, std::uint32_t begin, std::uint32_t end) const {
  const std::array<Binning, 3> binning = {Binning(range.centres, 0), Binning(range.centres, 1),
                                          Binning(range.centres, 2)};
  const std::vector<BvhPrimitive>& primitives = arrays_[range.array];
  BuildBins bins;
  for (std::uint32_t i = begin; i < end; ++i) {
    const BvhPrimitive& primitive = primitives[i];
    for (int axis = 0; axis < 3; ++axis) {
      Bin& bin = bins.axes[axis][binning[axis](primitive.twice_centre(axis))];
      grow(bin.box, primitive.box);
      ++bin.count;
    }
  }
  return bins;
}

/// Moves primitives [begin, end) of a range to the two parts, and grows the boxes of their centres.
void BvhBuilder::move_apart(const Range& range, const BuildPlane& plane, std::uint32_t begin, std::uint32_t end,
                            Pair& to) {
  const std::vector<BvhPrimitive>& from = arrays_[range.array];
  std::vector<BvhPrimitive>& out = arrays_[1 - range.array];
  std::uint32_t left = to.left.begin, right = to.right.begin;
  BuildBox left_centres = kEmptyBox, right_centres = kEmptyBox;  // in registers
  for (std::uint32_t i = begin; i < end; ++i) {
    if (plane.goes_left(from[i])) {
      out[left++] = from[i];
      grow_by_centre(left_centres, from[i]);
    } else {
      out[right++] = from[i];
      grow_by_centre(right_centres, from[i]);
    }
  }
  to.left.centres = left_centres;
  to.right.centres = right_centres;
}

BvhBuilder::Pair BvhBuilder::split_at_median(const Range& range) {
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (extent(range.centres, k) > extent(range.centres, axis)) axis = k;
  }
  std::vector<BvhPrimitive>& primitives = arrays_[range.array];
  Pair pair = halves(range, range.begin + range.count() / 2);
  pair.left.array = pair.right.array = range.array;
  std::nth_element(primitives.begin() + range.begin, primitives.begin() + pair.left.end, primitives.begin() + range.end,
                   [axis](const BvhPrimitive& a, const BvhPrimitive& b) {
                     const double ca = a.twice_centre(axis), cb = b.twice_centre(axis);
                     return ca != cb ? ca < cb : a.triangle < b.triangle;
                   });
  for (Range* part : {&pair.left, &pair.right}) {
    for (std::uint32_t i = part->begin; i < part->end; ++i) grow_by_centre(part->centres, primitives[i]);
  }
  return pair;
}

/// Puts the subtrees into one array: all nodes below a node are in one run, so only its length is needed.
std::vector<BvhNode> BvhBuilder::lay_out() {
  for (std::size_t i = tops_.size(); i-- > 0;) {  // children come after their parents
    Top& top = tops_[i];
    top.below = top.left == 0 ? static_cast<std::uint32_t>(top.subtree.size()) - 1
                              : 2 + tops_[top.left].below + tops_[top.right].below;
  }
  std::vector<BvhNode> nodes(std::size_t{tops_[0].below} + 1);
  tops_[0].first = 1;
  std::vector<std::uint32_t> positions(tops_.size(), 0);
  for (std::size_t i = 0; i < tops_.size(); ++i) {
    const Top& top = tops_[i];
    if (top.left == 0) continue;
    nodes[positions[i]].first = top.first;
    positions[top.left] = top.first;
    positions[top.right] = top.first + 1;
    tops_[top.left].first = top.first + 2;
    tops_[top.right].first = top.first + 2 + tops_[top.left].below;
  }
  parallel_blocks(tops_.size(), 1, threads_, [&](std::size_t i, std::size_t) {
    const Top& top = tops_[i];
    for (std::uint32_t link = 0; link < top.subtree.size(); ++link) {
      BvhNode& node = nodes[link == 0 ? positions[i] : top.first + link - 1];
      node.count = top.subtree[link].count;
      node.first = node.count != 0 ? top.subtree[link].first : top.first + top.subtree[link].first - 1;
    }
  });
  return nodes;
}

}  // namespace medial_vk
