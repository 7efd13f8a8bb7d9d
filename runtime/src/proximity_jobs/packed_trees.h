// The trees of bodies as the kernel reads them.
#pragma once

#include <span>
#include <vector>

#include "medial_vk/proximity.h"
#include "proximity_types.h"

namespace medial_vk {

struct PackedTrees {
  std::vector<gpu::ProximityNode> nodes;
  std::vector<gpu::ProximityBody> bodies;

  explicit PackedTrees(std::span<const Body> bodies);
};

}  // namespace medial_vk
