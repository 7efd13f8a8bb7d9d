// Balls in the rest pose as kernels read them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "follow_types.h"
#include "following/surface/moving_surface.h"
#include "medial_vk/ball.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// The greatest balls at the contacts of `balls`, which are inside the surface in its rest pose, in the order of these
/// contacts in the tree: neighbours run together. Lengths are multiplied by `scale`. `places`: of each triangle in the
/// tree. Errors: kOutOfMemory, and those of measure_ball_union().
Result<std::vector<gpu::FollowRest>> make_rest_balls(const MovingSurface& surface, std::span<const Ball> balls,
                                                     std::span<const std::uint32_t> places, double scale,
                                                     unsigned threads);

/// For each ball one that overlaps it, such that few of these links lead from any ball to one without: to itself, of
/// which there is one for each connected part of the union. Errors: as make_rest_balls().
Result<std::vector<std::uint32_t>> overlapping_parents(std::span<const Ball> balls, unsigned threads);

}  // namespace medial_vk
