// The balls of a body in the frame of a query, in double, with their tree.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/point_ops.h"
#include "medial_vk/ball.h"
#include "proximity/body_tree.h"
#include "proximity/placement.h"

namespace medial_vk {

/// The errors of positions in the frame of a query, whose origin is that of the tree of a.
///
/// Let S be the sum of the lengths of the placement and of twice the distance of the origins and both reaches: it
/// bounds every length below, where translations are no longer than longest_translation(). With u = 2^-53, a centre of
/// b in the frame of a has an error of 7 u S (nearest_triangles.cpp), its difference to the origin u S more, the sum
/// with a translation and the difference to another centre 2 u S more, the length of that 4 u S, and the sum with radii
/// 3 u S: less than 32 u S. A translation that is added to the shift of the pose, and rounded, costs 2 u S more. The
/// error is taken twice as large. A rotation that is one to within 1e-12 stretches a ball by less than 4e-12 of its
/// radius.
struct QueryFrame {
  QueryFrame(const Placement& placement, double reach_a, double reach_b)
      : longest(placement.distance() + reach_a + reach_b), error(0x1p-46 * (placement.lengths() + 2 * longest)) {}

  /// Any translation of this length, and one error, ends in a pose with no common point.
  double longest_translation() const { return longest * (1 + 0x1p-37) + 8 * error; }

  static constexpr double kStretch = 4e-12;

  double longest;
  double error;  ///< Of a distance of two balls after a translation.
};

/// Balls of a node of a BodyTree, as that has them.
struct PlacedNode {
  std::array<Ball, BodyNode::kWidth> balls = {};
  std::array<std::uint32_t, BodyNode::kWidth> below = {};
  std::uint32_t count = 0;
  bool is_lowest = true;
};

struct PlacedBalls {
  std::vector<PlacedNode> nodes;  ///< Node 0 is the root. Every ball of a node holds all balls of the set below it.
  std::vector<Ball> balls;        ///< By index in the set.
};

/// The balls of a, relative to the origin of its tree.
PlacedBalls place_a(const BodyTree& tree, std::span<const Ball> balls, const Placement& placement);
/// The balls of b, in the same frame. All radii are larger by the stretch of the rotation.
PlacedBalls place_b(const BodyTree& tree, std::span<const Ball> balls, const Placement& placement);

/// Whether some ball of the set comes closer than `margin` to `ball`; negative: overlaps it by more than that.
bool comes_near(const PlacedBalls& set, const Ball& ball, double margin);

}  // namespace medial_vk
