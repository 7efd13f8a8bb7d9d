// The volume of a union of hulls of balls, between proved bounds (docs/theory.md, "Hulls of balls").
#pragma once

#include <span>
#include <stop_token>

#include "medial_vk/ball_hull.h"
#include "medial_vk/result.h"
#include "medial_vk/sphere_measures.h"

namespace medial_vk {

struct HullUnionOptions {
  double width = 0;      ///< The greatest difference of the bounds, in cubed mesh units; positive.
  unsigned threads = 0;  ///< Of the host, 0: one per core. The result does not depend on it.
};

/// Bounds of the volume of the union of at most 2^20 hulls, in cubed mesh units: sums over cubic cells, of which each
/// is outside of all hulls, in one of them, or cut by planes that leave a part outside and a part inside of them. Cells
/// are divided until the bounds differ by at most `width`, or by what rounding or 2^24 cells allow. Errors: kUsage (a
/// width that is not positive, too many hulls, a number that is not finite or beyond 1e18, or a negative radius; names
/// the hull), kOutOfMemory, kInterrupted.
Result<Bounds> measure_hull_union(std::span<const BallHull> hulls, const HullUnionOptions& options,
                                  const std::stop_token& stop = {});

}  // namespace medial_vk
