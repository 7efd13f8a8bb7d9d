// The thinnest wall of a solid, or the narrowest gap outside it, with a proof (docs/theory.md, "Least wall").
#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>

#include "medial_vk/ball.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/progress.h"
#include "medial_vk/result.h"
#include "medial_vk/sphere_measures.h"
#include "medial_vk/thickness.h"

namespace medial_vk {

struct LeastWallOptions {
  ThicknessSide side = ThicknessSide::kWalls;
  /// Radians, between pi / 4 and pi / 2: half the angle at the centre between both contacts of a ball in a wall. An
  /// edge whose faces meet at an angle of less than pi minus twice this (42 degrees by default) is a wall of no
  /// thickness.
  double object_angle = 1.2;
  /// Of the interval, relative to its lower end.
  double width = 0.01;
  /// In mesh units: walls that are not thinner are not searched for. 0: the longest side, which no ball inside exceeds.
  double limit = 0;
  std::uint32_t cells = 1u << 21;  ///< That may be examined, and up to seven more; then the interval is left wider.
  unsigned threads = 0;            ///< Of the host, 0: one per core. The result does not depend on it.
};

/// A medial ball: inside the solid up to rounding, with two points of the boundary on its sphere.
struct WallBall {
  Ball ball;
  Point a = {0, 0, 0}, b = {0, 0, 0};  ///< The contacts.
  double object_angle = 0;             ///< Half the angle between them, seen from the centre, in radians.
};

struct LeastWall {
  /// Holds the least diameter of a medial ball with the object angle, or the limit if that is less. In mesh units,
  /// rounded outwards. The object angle of the ball that gives the upper end may be smaller by 0.001.
  Bounds diameter;
  std::optional<WallBall> thinnest;  ///< The ball of the upper end; none if no ball below the limit was found, as where
                                     ///< the only one is isolated.
  std::uint64_t cells = 0;           ///< Examined.
};

/// No medial ball with the object angle has a smaller diameter than the lower end, by a bound for all centres in a cell
/// of space; the search divides cells where smaller balls may be. Needs a closed mesh, and may prove nothing near
/// faces whose normals are not trusted (kTrustedNormal). Time: some 10 microseconds a cell; the number of cells grows
/// with the area over the squared thickness, and where walls are curved with 1 / width^2. `progress` gets the share of
/// the cells that may be examined, on the calling thread. Errors: kUsage (an option out of range, a mesh that is not
/// closed), kOutOfMemory, kInterrupted.
Result<LeastWall> measure_least_wall(const IndexedMesh& mesh, const LeastWallOptions& options = {},
                                     const ProgressCallback& progress = {}, const std::stop_token& stop = {});

}  // namespace medial_vk
