#pragma once

#include <cstdint>

#include "base/internals.h"
#include "medial_vk/bvh.h"

namespace medial_vk {

/// The same tree with its leaves split further, for scattered queries on the host. It equals the tree that Bvh::build()
/// makes of the same triangles for `leaf_size`, if none has moved since and Bvh::kMaxDepth does not matter, but without
/// a second sort; leaves that are smaller stay as they are. Error: kOutOfMemory.
inline Result<Bvh> refined_tree(const Bvh& bvh, std::uint32_t leaf_size) { return Internals::refined(bvh, leaf_size); }

}  // namespace medial_vk
