// What a follower is given.
#pragma once

#include <cstddef>
#include <span>

#include "following/surface/moving_surface.h"
#include "following/tracked_ball.h"
#include "medial_vk/ball.h"
#include "medial_vk/follower.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// By which a given ball may reach out of the mesh, as a share of the longest side: that of coordinates in float.
constexpr double kGivenError = 1e-6;

/// Errors: kUsage.
Status check_options(std::span<const Ball> balls, const FollowerOptions& options, bool is_closed);

/// The ball in the rest pose with its first contact. Error: kUsage, which names it by its index, if it is not inside up
/// to `error`.
Result<TrackedBall> track(const MovingSurface& surface, const Ball& ball, std::size_t index, double error);

}  // namespace medial_vk
