// Balls and their tree in the form that the device reads.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ball_types.h"
#include "ball_unions/cells/ball_tree.h"
#include "medial_vk/ball.h"

namespace medial_vk {

/// By position in the tree's order. `exact`: every number is the sum of its three parts.
struct SplitBalls {
  std::vector<gpu::SplitBall> balls;
  bool exact = true;
};
SplitBalls split_balls(std::span<const Ball> balls, std::span<const std::uint32_t> order);

/// Nodes whose bounds are no tighter than those of the tree, for any rounding here and on the device, up to the margin
/// in ball_walk.glsl.
std::vector<gpu::BallNode> split_nodes(const BallTree& tree, unsigned threads);

}  // namespace medial_vk
