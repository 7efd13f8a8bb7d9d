// Parts of a set of balls, made tighter by exchanges.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/point_ops.h"

namespace medial_vk {

/// Balls by their indices in a set.
struct IndexedBalls {
  std::span<const Point> centres;
  std::span<const double> radii;
};

/// Moves balls from one part to another, or exchanges two, while the sum of the squared radii of the balls around the
/// parts falls. (The pairs of nodes that a search compares grow with these squares.) No part becomes empty or larger
/// than `most`. The parts lie side by side, and do so afterwards, with other limits. The result depends on the order of
/// the parts and of the balls in them. Time: the number of balls times a constant.
void exchange(const IndexedBalls& balls, std::size_t most, std::vector<std::span<std::uint32_t>>& parts);

}  // namespace medial_vk
