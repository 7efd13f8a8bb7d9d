// The volume that two unions of balls have in common.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// By exact unions, vol(A) + vol(B) - vol(A and B together), up to rounding. Balls that meet none of the other set
/// change nothing and cost time.
Result<double> common_volume_of(std::span<const Ball> a, std::span<const Ball> b);

/// A lower bound of it with all rounding errors: columns along the z axis are divided until the bound is within the
/// share `tolerance` of `estimate`, or there are `most_columns`.
double common_volume_at_least(std::span<const Ball> a, std::span<const Ball> b, double estimate, double tolerance,
                              std::uint64_t most_columns);

}  // namespace medial_vk
