// Poses of the host as the kernel reads them.
#pragma once

#include <span>

#include "medial_vk/proximity.h"
#include "proximity_types.h"

namespace medial_vk {

/// The body of a pose that the kernel is to leave to the host.
constexpr std::uint32_t kNoBody = ~std::uint32_t{0};

/// Relative to the origins of the trees, with the errors of separations there: docs/theory.md, "Many poses on a
/// device". Precondition: the indices are those of `bodies`.
void pack_poses(std::span<const Body> bodies, std::span<const PosedPair> pairs, std::span<gpu::ProximityPose> packed,
                unsigned threads);

}  // namespace medial_vk
