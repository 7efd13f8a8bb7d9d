// Balls in the solid where a union of balls leaves gaps.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "solid/solid.h"
#include "sphere_fits/steps/gaps.h"
#include "threads/worker_pool.h"

namespace medial_vk {

/// The largest ball through the deepest vertex of the envelope, or near the boundary's farthest point.
std::optional<Ball> ball_in_widest_gap(const Solid& solid, GapFinder& gaps);

/// The largest balls through the deepest vertices of the envelope on these balls of the union, different ones.
std::vector<Ball> balls_at_vertices(const Solid& solid, GapFinder& gaps, std::span<const std::uint32_t> slots,
                                    WorkerPool& pool);

/// The largest of the balls that touch the boundary at its samples, if there is one.
std::optional<Ball> largest_at_samples(const Solid& solid, const GapFinder& gaps);

}  // namespace medial_vk
