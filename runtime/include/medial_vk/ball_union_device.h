// Unions of balls on the device: each ball's share of the volume and of the surface in float, with bounds of the
// errors.
//
// What ball_union.h finds in double precision, faster where there is a GPU. Figures that must be exact are
// ball_union.h's (docs/theory.md, "Unions of balls", "On the device").
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/context.h"
#include "medial_vk/result.h"

namespace medial_vk {

struct DeviceBallUnionOptions {
  unsigned threads = 0;  ///< Of the host, which builds the tree and measures what the device leaves: 0 is one per core.
  /// The greatest error bound that is accepted, as a share of the cube of a ball's radius for its volume, and ten times
  /// that of the square for its surface.
  double tolerance = 1e-3;
};

/// What measure_ball_union() finds on a device. Lengths in the units of the balls. Against the exact figures, each
/// number is wrong by its bound at most; bounds are of the worst case, errors are mostly hundreds of times smaller.
struct DeviceBallUnion {
  double volume = 0;  ///< Of the union.
  double area = 0;    ///< Of its surface.
  double volume_bound = 0;
  double area_bound = 0;
  std::vector<double> volumes;  ///< Per ball, as BallUnion::volumes.
  std::vector<double> areas;    ///< Per ball, as BallUnion::areas.
  std::vector<double> volume_bounds;
  std::vector<double> area_bounds;
  std::vector<std::uint32_t> redone;  ///< Balls that the host measured in double precision, ascending.
};

/// Measures a union of balls on the device; for balls as measure_ball_union() of ball_union.h takes them. Those that
/// the device cannot measure (cells of more than 64 corners, coincidences beyond what float tells apart, bounds above
/// the tolerance) are measured by the host, so the answer holds for all. The same bytes for the same device, whatever
/// `threads`. Errors: kUsage (names the ball; a tolerance that is not positive), kOutOfMemory (of the host or of the
/// device), kInternal (device lost).
Result<DeviceBallUnion> measure_ball_union(Context& context, std::span<const Ball> balls,
                                           const DeviceBallUnionOptions& options = {});

}  // namespace medial_vk
