// The boxes of a tree whose links are known.
#pragma once

#include <array>
#include <span>

#include "medial_vk/bvh.h"

namespace medial_vk {

/// The least boxes around the triangles below each node, from the leaves up. `nodes` in the order of
/// BvhBuilder::build(), `corners` by leaf position; threads at least 1. The same for any number of threads.
void fit_boxes(std::span<BvhNode> nodes, std::span<const std::array<Point, 3>> corners, unsigned threads);

}  // namespace medial_vk
