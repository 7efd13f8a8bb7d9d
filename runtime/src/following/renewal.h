// Balls that leave their places for gaps between the surface and a union of balls (docs/theory.md, "Balls chosen
// anew").
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "following/gap_samples.h"
#include "following/surface/moving_surface.h"
#include "following/tracked_ball.h"
#include "medial_vk/ball_union.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// A ball that leaves its place.
struct BallExchange {
  std::uint32_t ball;
  TrackedBall by;                     ///< Inside the surface.
  std::vector<std::uint32_t> others;  ///< Balls next to which it was or is.
};

/// Where balls may come to.
struct ExchangeRegions {
  const GapSamples& samples;
  std::span<const std::uint8_t> chosen;  ///< By region: 1 if they may.
};

/// Up to `most` exchanges, in their order: each of them enlarges the union of all balls, and none makes the greatest
/// distance to them larger, of the samples and of the middles of triangles (of very fine meshes, of a part of these).
/// `measured` is the union of `balls`, with its vertices; balls of radius 0 are lost. The result does not depend on
/// `threads`. Errors: kOutOfMemory, kUsage (as DynamicUnion::add()).
Result<std::vector<BallExchange>> find_exchanges(const MovingSurface& surface, std::span<const Ball> balls,
                                                 const BallUnion& measured, const ExchangeRegions& regions,
                                                 std::uint32_t most, unsigned threads);

}  // namespace medial_vk
