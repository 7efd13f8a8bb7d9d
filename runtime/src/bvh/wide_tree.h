// The tree over triangles with eight children a node, in float, for many queries on the host.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "base/eight_floats.h"
#include "medial_vk/bvh.h"

namespace medial_vk {

/// Passes over boxes and triangles eight at a time, and leaves the rest to double precision: the results have the
/// accuracy of Bvh::closest(), in half of the time. Of triangles that are equally near up to rounding, it may find
/// another one. Belongs to one Bvh, which is passed to each call. Queries may come from several threads at once.
class WideTree {
 public:
  /// Of children, to exclude them. A surface that is nearly flat is in a thin disk, whatever its direction: beside
  /// boxes, disks leave half of the nodes to walk through, but a refit takes four times as long.
  enum class Bounds : std::uint8_t { kBoxes, kBoxesAndDisks };

  /// Of a tree with a node. Throws std::bad_alloc.
  explicit WideTree(const Bvh& bvh, Bounds bounds = Bounds::kBoxesAndDisks);

  /// Follows Bvh::refit(). Allocates nothing.
  void refit(const Bvh& bvh);
  BvhHit closest(const Bvh& bvh, const Point& p, double bound = std::numeric_limits<double>::infinity()) const;
  /// Writes the leaf positions of all triangles within `radius` of p, and of few beyond, and returns their number; none
  /// where they are too many, or p is too far away for products of floats.
  std::optional<std::size_t> gather(const Point& p, double radius, std::span<std::uint32_t> positions) const;

 private:
  class Walk;
  class NearestWalk;
  class GatheringWalk;
  struct Ranges;

  static constexpr std::size_t kWidth = 8;
  static constexpr std::uint32_t kBlock = 0x80000000u;  // a child that is a block, not a node
  /// A walk replaces a node by up to eight children, at most once a level.
  static constexpr std::size_t kMostPending = 1 + (kWidth - 1) * (Bvh::kMaxDepth + 1);

  using Eight = std::array<float, kWidth>;

  struct alignas(32) Node {
    std::array<Eight, 3> lower, upper;  // rounded outwards
    /// Disks: the triangles of a child are between two planes across an axis through the middle of its box, at the
    /// heights `low` and `high` over the middle, and within a radius of the axis.
    std::array<Eight, 3> axis = {};
    Eight low = {}, high = {}, radius = {};
    std::array<std::uint32_t, kWidth> below = {};                  // index of a node, or kBlock and that of a block
    std::array<std::uint32_t, kWidth> origin = {};                 // the nodes of the Bvh with these boxes
    std::array<std::uint32_t, kWidth> first = {}, triangles = {};  // the positions below each child, and their number
    std::uint32_t count = 0;                                       // of used children, which are the first
  };
  /// Triangles that follow each other in Bvh::order().
  struct alignas(32) Block {
    std::array<std::array<Eight, 3>, 3> corners;  // [corner][axis]
    std::uint32_t first = 0, count = 0;           // positions
    bool is_last = true;                          // else the next block belongs to the same child
  };

  std::uint32_t add_node(const Bvh& bvh, const Ranges& ranges, std::uint32_t origin);
  std::uint32_t add_blocks(std::uint32_t first, std::uint32_t count);
  std::vector<std::uint32_t> children_of(const Bvh& bvh, const Ranges& ranges, std::uint32_t origin) const;
  void fit_box(const Bvh& bvh, Node& node, std::size_t k) const;
  void fit_disk(const Bvh& bvh, Node& node, std::size_t k) const;
  /// Of a box along an axis, eight of them or one, with equal rounding.
  template <class Number>
  static MEDIAL_VK_INLINE Number middle_of(const Number& lower, const Number& upper) {
    return 0.5f * (lower + upper);
  }
  /// Relative to the centre, in units in which the box has a size of about one.
  Point scaled(const Point& p) const;

  bool has_disks_;
  std::vector<Node> nodes_;
  std::vector<Block> blocks_;
  Point centre_ = {0, 0, 0};
  double scale_ = 1;  // a power of two
  double reach_ = 0;  // in these units, of a corner of the box from the centre
};

}  // namespace medial_vk
