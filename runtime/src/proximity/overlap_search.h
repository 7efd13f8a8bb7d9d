// A search for two balls of two trees that are closer than a given separation: docs/theory.md, "Many poses".
#pragma once

#include <array>
#include <bit>
#include <type_traits>

#include "medial_vk/proximity.h"
#include "proximity/tree_search.h"

namespace medial_vk {

/// The centres of a node's balls in the frame of a.
struct EightCentres {
  EightFloats x, y, z;
};

MEDIAL_VK_INLINE EightCentres in_frame_of_a(const BodyNode& b, const FloatPose& pose) {
  const EightFloats x = load(b.centre[0]), y = load(b.centre[1]), z = load(b.centre[2]);
  const auto& [row_x, row_y, row_z] = pose.rows;
  return {row_x[0] * x + row_x[1] * y + row_x[2] * z + pose.shift[0],
          row_y[0] * x + row_y[1] * y + row_y[2] * z + pose.shift[1],
          row_z[0] * x + row_z[1] * y + row_z[2] * z + pose.shift[2]};
}

struct StoredCentres {
  std::array<float, BodyNode::kWidth> x, y, z;
};

MEDIAL_VK_INLINE StoredCentres stored(const EightCentres& centres) {
  return {stored(centres.x), stored(centres.y), stored(centres.z)};
}

/// Where a vector is shorter than the reach, and by how much in squares.
struct Closer {
  EightInts where;
  EightFloats by;
};

MEDIAL_VK_INLINE Closer closer(const EightFloats& x, const EightFloats& y, const EightFloats& z,
                               const EightFloats& reach) {
  const EightFloats square = x * x + y * y + z * z, square_of_reach = reach * reach;
  return {(square < square_of_reach) & (reach > 0), square_of_reach - square};
}

/// A node of the lowest level is not replaced, so all pairs of its balls with one of the other node lead to the same
/// two nodes. Those that lead where the pair of the bit 8 k + j leads, for nodes of which one is of the lowest level:
MEDIAL_VK_INLINE std::uint64_t pairs_like(std::uint32_t bit, const BodyNode& a) {
  return a.is_lowest ? std::uint64_t{0x0101010101010101} << bit % 8 : std::uint64_t{0xff} << bit / 8 * 8;
}

/// One pair stays of those that lead to the same two nodes.
MEDIAL_VK_INLINE std::uint64_t without_repeats(std::uint64_t pairs, const BodyNode& a) {
  std::uint64_t rest = 0;
  for (std::uint32_t i = 0; i < BodyNode::kWidth; ++i) {
    const std::uint32_t bit = a.is_lowest ? i : i * 8;
    if ((pairs & pairs_like(bit, a)) != 0) rest |= std::uint64_t{1} << bit;
  }
  return rest;
}

/// Depth first, and of the pairs of a division the one that overlaps most first. Separations are compared by squares,
/// as separation_error() allows. Everything is inlined into its caller, which chooses the processor. Allocates nothing.
class OverlapSearch {
 public:
  /// Precondition: no tree is empty.
  OverlapSearch(const NodeTree& a, const NodeTree& b, const FloatPose& pose, float separation)
      : a_(a), b_(b), pose_(pose), separation_(separation) {}

  /// Whether two items have balls with a smaller computed separation than the given one.
  MEDIAL_VK_INLINE bool find() {
    Nodes nodes = {0, 0, kNoBall};
    while (!compare(nodes)) {
      if (count_ == 0) return false;
      nodes = next();
    }
    return true;
  }

  /// Two such items. Precondition: find() has found some.
  MEDIAL_VK_INLINE const BallPair& found() const { return found_; }

 private:
  static constexpr std::uint32_t kWidth = BodyNode::kWidth;
  static constexpr std::uint32_t kNoBall = ~std::uint32_t{0};

  /// One of each tree, whose balls are closer.
  struct Nodes {
    std::uint32_t a, b;
    std::uint32_t above_a;  ///< Ball k of node n, 8 n + k, holds the balls of a; kNoBall: the root has none.
  };

  /// Two nodes and what is still to be followed below them. Without initial values, which would take time.
  struct Division {
    Nodes nodes;
    std::uint32_t first;  ///< 8 k + j: ball k of a and ball j of b are followed first,
    std::uint64_t rest;   ///< and then those of the bits 8 k + j.
  };
  static_assert(std::is_trivially_default_constructible_v<Division>);

  MEDIAL_VK_INLINE Nodes next() {
    Division& division = divisions_[count_ - 1];
    const Nodes nodes = division.nodes;
    const std::uint32_t k = division.first / kWidth, j = division.first % kWidth;
    if (division.rest == 0) {
      --count_;
    } else {
      division.first = static_cast<std::uint32_t>(std::countr_zero(division.rest));
      division.rest &= division.rest - 1;
    }
    const BodyNode &a = a_.node(nodes.a), &b = b_.node(nodes.b);
    const std::uint32_t below_b = b.is_lowest ? nodes.b : b.below[j];
    return a.is_lowest ? Nodes{nodes.a, below_b, nodes.above_a} : Nodes{a.below[k], below_b, nodes.a * kWidth + k};
  }

  /// The balls of b that are closer to the ball around those of the other node: bit j.
  MEDIAL_VK_INLINE std::uint32_t near_balls(const Nodes& nodes, const BodyNode& b, const EightCentres& centres) const {
    if (nodes.above_a == kNoBall) return (1u << b.count) - 1;
    const BodyNode& above = a_.node(nodes.above_a / kWidth);
    const std::size_t k = nodes.above_a % kWidth;
    return bits_of(closer(centres.x - above.centre[0][k], centres.y - above.centre[1][k],
                          centres.z - above.centre[2][k], load(b.radius) + (above.radius[k] + separation_))
                       .where);
  }

  /// All balls of one node with the near ones of the other, eight pairs at a time. True: two items were found.
  MEDIAL_VK_INLINE bool compare(const Nodes& nodes) {
    const BodyNode &a = a_.node(nodes.a), &b = b_.node(nodes.b);
    const EightCentres centres = in_frame_of_a(b, pose_);
    std::uint32_t near = near_balls(nodes, b, centres);
    if (near == 0) return false;
    const StoredCentres to = stored(centres);
    const EightFloats x = load(a.centre[0]), y = load(a.centre[1]), z = load(a.centre[2]),
                      reach_a = load(a.radius) + separation_;
    EightInts closer_to_a{}, most{};  // bit j of element k: ball k of a and ball j of b
    for (; near != 0; near &= near - 1) {
      const auto j = static_cast<std::int32_t>(std::countr_zero(near));
      const auto row = static_cast<std::size_t>(j);
      const Closer found = closer(x - to.x[row], y - to.y[row], z - to.z[row], reach_a + b.radius[row]);
      closer_to_a |= found.where & std::int32_t{1 << j};
      most = greater(most, key_of(found, j));
    }
    const std::uint64_t pairs = bytes_of(closer_to_a);
    if (pairs == 0) return false;
    if (a.is_lowest && b.is_lowest) {
      const auto bit = static_cast<std::uint32_t>(std::countr_zero(pairs));
      found_ = {a.below[bit / kWidth], b.below[bit % kWidth]};
      return true;
    }
    const std::uint32_t first = static_cast<std::uint32_t>(greatest_of(most)) % (kWidth * kWidth);
    const std::uint64_t rest = pairs & ~(std::uint64_t{1} << first);
    divisions_[count_++] = {nodes, first,
                            a.is_lowest || b.is_lowest ? without_repeats(rest & ~pairs_like(first, a), a) : rest};
    return false;
  }

  /// An order by overlap that ends in the number of the pair: of positive floats the greater one has the greater bits.
  /// Of its last seven, one makes the key of a close pair greater than 0, and six are 8 k + j.
  MEDIAL_VK_INLINE static EightInts key_of(const Closer& found, std::int32_t j) {
    const EightInts pair = EightInts{64, 72, 80, 88, 96, 104, 112, 120} + j;
    return ((reinterpret_cast<EightInts>(found.by) & ~127) | pair) & found.where;
  }

  const NodeTree& a_;
  const NodeTree& b_;
  const FloatPose& pose_;
  float separation_;
  BallPair found_;
  std::size_t count_ = 0;
  /// At most one for each level: below the lowest level of both trees there is nothing.
  std::array<Division, node_levels(kMostBodyBalls)> divisions_;
};

}  // namespace medial_vk
