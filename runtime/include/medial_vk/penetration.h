// How far two solids lie in each other, held between bounds by balls inside them and by balls that cover them
// (docs/theory.md, "Penetration").
#pragma once

#include <cstdint>
#include <limits>

#include "medial_vk/proximity.h"

namespace medial_vk {

struct PenetrationOptions {
  /// Directions along which a way out is sought at first, 1 to 2^20. More directions may find a shorter one.
  std::uint32_t directions = 128;
  /// Queries for the lower bound of the depth, each of the deepest two balls in a shifted pose. More may raise it.
  std::uint64_t most_queries = 2000;
  /// The lower bound of the volume in common is not improved further once it is within this share of that of the balls,
  /// from 0 to 1, or once it has cost `most_columns`. 1: no volume is measured.
  double volume_tolerance = 1e-2;
  std::uint64_t most_columns = 4000;
};

/// What is proved about two solids that overlap. Lengths and volumes are in the units of the bodies.
struct Penetration {
  /// An interval that contains the depth: the length of the shortest translation of b after which the interiors of the
  /// solids have no point in common.
  double depth_lower = 0;
  double depth_upper = std::numeric_limits<double>::infinity();
  /// Of b, in the frame of a, and no longer than `depth_upper`: the interiors are disjoint after it, also if its sum
  /// with the shift of the pose is rounded.
  Point translation = {0, 0, 0};
  double common_volume_lower = 0;  ///< The solids have at least this volume in common.
  /// That of the two unions of balls inside, by their exact union (ball_union.h). It is a lower bound as well, but for
  /// the rounding of double, whose errors have no proved bound there.
  double common_volume_of_balls = 0;
  BallPair deepest;  ///< The two balls inside that overlap most, up to the rounding of float; none if none overlap.
};

/// Bounds of the penetration of the solid of `a` and that of `b`, whose frame `pose` takes to the frame of `a`. The
/// bounds include all rounding errors. Lower bounds come from the balls inside, and are 0 where a body has none; the
/// upper one and the translation come from the covers, and there is none, with an infinite bound, where a body has no
/// cover. The translation is the shortest that was found, which need not be the shortest. Solids that are proved to be
/// apart, by balls or by triangles, have zeros throughout. Time: 10 to 70 ms for bodies of 500 balls that overlap, of
/// which the volume takes two thirds or more. Precondition: as for distance_bounds(); where a coordinate of the shift
/// is beyond 1e18, or no number, nothing is proved. Errors: kUsage (an option out of range), kOutOfMemory.
Result<Penetration> penetration(const Body& a, const Body& b, const Pose& pose, const PenetrationOptions& options = {});

}  // namespace medial_vk
