// Balls and their tree as the device reads them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ball_types.h"
#include "balls/cells/ball_tree.h"
#include "medial_vk/ball.h"

namespace medial_vk {

/// By place in the tree's order. `exact`: every number is the sum of its three parts.
struct SplitBalls {
  std::vector<gpu::SplitBall> balls;
  bool exact = true;
};
SplitBalls split_balls(std::span<const Ball> balls, std::span<const std::uint32_t> order);

/// Nodes that promise no more than the tree's, whatever rounding does to them here and on the device, up to the margin
/// that ball_walk.glsl keeps.
std::vector<gpu::BallNode> split_nodes(const BallTree& tree, unsigned threads);

}  // namespace medial_vk
