// Builds the nodes of a Bvh: binned SAH (Wald 2007), parallel within large nodes and over subtrees, the same tree for
// any number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "bvh/bvh_bins.h"
#include "medial_vk/bvh.h"

namespace medial_vk {

class BvhBuilder {
 public:
  /// At least one primitive, in the order of their triangles; leaf_size and threads at least 1.
  BvhBuilder(std::vector<BvhPrimitive> primitives, std::uint32_t leaf_size, unsigned threads);

  /// Links and leaves, boxes still empty. Root first, depth at most Bvh::kMaxDepth. Siblings are neighbours; after a
  /// pair come all nodes below the first of the two, then all below the second (fit_boxes() relies on it).
  std::vector<BvhNode> build();
  /// Instead of build(), if the primitives are in the leaf order of `coarse`: that tree with its leaves split further,
  /// which is the tree that build() makes of the same primitives.
  std::vector<BvhNode> refine(const std::vector<BvhNode>& coarse);
  /// After either: triangle by leaf position.
  std::vector<std::uint32_t> take_order() { return std::move(order_); }

 private:
  /// A future node: primitives [begin, end) of one of the two arrays, and the box around their doubled centres.
  struct Range {
    std::uint32_t begin = 0, end = 0;
    std::uint32_t depth = 0;
    std::uint32_t array = 0;
    BuildBox centres;
    std::uint32_t count() const { return end - begin; }
  };
  struct Pair {
    Range left, right;
  };
  /// A node without its box; `first` of an inner node counts from the root of its subtree.
  struct Link {
    std::uint32_t first = 0, count = 0;
  };
  /// A node of the upper part of the tree: inner, or the root of a subtree that is built by one thread.
  struct Top {
    Range range;
    std::uint32_t left = 0, right = 0;  // in tops_; 0: a subtree
    std::vector<Link> subtree;          // its root first
    std::uint32_t below = 0;            // nodes below it,
    std::uint32_t first = 0;            // and the position of the first of them
  };

  Range whole() const;
  static Pair halves(const Range& range, std::uint32_t middle);
  Pair split(const Range& range, unsigned threads);
  Pair split_here(const Range& range);
  Pair split_wide(const Range& range, unsigned threads);
  Pair split_at_median(const Range& range);
  BuildBins fill_bins(const Range& range, std::uint32_t begin, std::uint32_t end) const;
  void move_apart(const Range& range, const BuildPlane& plane, std::uint32_t begin, std::uint32_t end, Pair& to);
  void split_tops();
  void build_subtrees();
  void build_subtree(const Range& range, std::uint32_t position, std::vector<Link>& out);
  void refine_subtree(const std::vector<BvhNode>& coarse, std::uint32_t node, std::uint32_t depth,
                      std::uint32_t position, std::vector<Link>& out);
  void make_leaf(const Range& range, Link& leaf);
  std::vector<BvhNode> lay_out();
  std::uint32_t levels_of_halving(std::uint32_t count) const;

  std::array<std::vector<BvhPrimitive>, 2> arrays_;  // every split moves a range from one to the other
  std::vector<std::uint32_t> order_;
  std::vector<Top> tops_;
  std::uint32_t leaf_size_;
  unsigned threads_;
};

}  // namespace medial_vk
