// A short translation that takes one cover off another one.
#pragma once

#include "medial_vk/mesh_view.h"
#include "proximity/placed/placed_balls.h"

namespace medial_vk {

struct WayOut {
  Point translation = {0, 0, 0};
  double length = 0;  ///< At least that of the translation.
};

/// No ball of b, after the translation, has an interior point in common with a ball of a: proved, with all errors of
/// `frame`. Along `directions` directions, and then along others near the best of them.
WayOut way_out(const PlacedBalls& a, const PlacedBalls& b, const QueryFrame& frame, std::uint32_t directions);

}  // namespace medial_vk
