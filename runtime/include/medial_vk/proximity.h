// The distance between two solids, held between the distances of balls inside them and of balls that cover them
// (S. Stolpner, "Medial Spheres for Shape Representation", 2011, Chapter 8; docs/theory.md, "Distances").
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>

#include "medial_vk/ball.h"
#include "medial_vk/pose.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// The greatest number of balls in a set of a body.
constexpr std::size_t kMostBodyBalls = std::size_t{1} << 24;

/// A solid for queries of distances: balls inside it, balls that cover it, and a tree over each set. Immutable: any
/// number of threads may query it.
class Body {
 public:
  /// Either set may be empty: without `inside` there are no upper bounds, without `cover` no lower ones. Centres and
  /// radii are finite, radii are not negative, and no coordinate of a ball's surface is beyond 1e18. Copies the balls.
  /// Time: n log n, a second for 100,000 balls. Errors: kUsage (names the ball; also for two empty sets, and for more
  /// than kMostBodyBalls), kOutOfMemory.
  static Result<Body> create(std::span<const Ball> inside, std::span<const Ball> cover);

  std::span<const Ball> inside() const;
  std::span<const Ball> cover() const;

 private:
  friend struct Internals;
  struct Impl;
  explicit Body(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

  std::shared_ptr<const Impl> impl_;
};

/// One ball of each of two bodies, by its index in its set.
struct BallPair {
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  std::uint32_t a = kNone, b = kNone;

  bool operator==(const BallPair&) const = default;
};

/// What balls alone decide about two solids in a pose.
enum class Collision {
  kFree,       ///< The solids have no point in common.
  kHit,        ///< They have one.
  kUndecided,  ///< The balls do not decide it.
};

/// An interval that contains the distance between two solids. That distance is 0 if they have a point in common, even
/// where one holds the other.
struct DistanceBounds {
  double lower = 0;                                        ///< Proved by the covers.
  double upper = std::numeric_limits<double>::infinity();  ///< Proved by the balls inside.
  /// The balls of the covers, and those inside, that give the two bounds; no pair where a set is empty.
  BallPair cover_pair, inside_pair;

  Collision collision() const {
    return lower > 0 ? Collision::kFree : upper == 0 ? Collision::kHit : Collision::kUndecided;
  }
};

struct DistanceOptions {
  unsigned threads = 0;  ///< 0: one per core. The result does not depend on it.
};

/// Bounds of the distance between the solid of `a` and that of `b`, whose frame `pose` takes to the frame of `a`. The
/// bounds include all rounding errors: they hold if the balls inside are inside and the covers cover. They are within
/// 3e-6 M + 1e-17 of the distances of the sets, where M is the distance of the bodies' middles plus the size of both.
/// `start` may be the result of an earlier query of the same two bodies: the search then begins with its pairs, and is
/// faster if the pose has changed little. A start may change the bounds within that accuracy, and which of nearly equal
/// pairs is named; indices that the bodies do not have are ignored. Allocates nothing. Precondition: the rows of the
/// rotation are perpendicular unit vectors to within 1e-12. Where a coordinate of the shift is beyond 1e18, or no
/// number, the bounds may be 0 and infinity.
DistanceBounds distance_bounds(const Body& a, const Body& b, const Pose& pose, const DistanceBounds& start = {});

/// The same for every pose; most searches start from the result before them. Precondition: `bounds` has the size of
/// `poses`.
void distance_bounds(const Body& a, const Body& b, std::span<const Pose> poses, std::span<DistanceBounds> bounds,
                     const DistanceOptions& options = {});

}  // namespace medial_vk
