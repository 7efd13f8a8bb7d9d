// The distance between two solids, held between the distances of balls inside them and of balls that cover them
// (S. Stolpner, "Medial Spheres for Shape Representation", 2011, Chapter 8; docs/theory.md, "Distances").
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <stop_token>
#include <utility>

#include "medial_vk/ball.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/pose.h"
#include "medial_vk/progress.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// The greatest number of balls in a set of a body.
constexpr std::size_t kMostBodyBalls = std::size_t{1} << 24;

struct BodyOptions {
  unsigned threads = 0;  ///< Of the host, 0: one per core. The body does not depend on it.
};

/// A solid for queries of distances: its mesh, balls inside it, balls that cover it, and a tree over each. Immutable:
/// any number of threads may query it.
class Body {
 public:
  /// A body with a mesh, for exact distances; either set of balls may be empty. The solid is what the mesh encloses
  /// (winding number at least 1/2), and its triangles; a mesh that is not closed encloses nothing. The mesh is shared,
  /// not copied. Time: some 20 microseconds a triangle, on one core. `progress` is called one call at a time but from
  /// any thread; a request to `stop` ends the call soon after the trees over balls. Errors: those of the other form;
  /// kUsage (balls `inside` a mesh that is not closed), kInvalidMesh (the mesh reaches beyond 1e18), kInterrupted.
  static Result<Body> create(const IndexedMesh& mesh, std::span<const Ball> inside = {},
                             std::span<const Ball> cover = {}, const BodyOptions& options = {},
                             const ProgressCallback& progress = {}, const std::stop_token& stop = {});
  /// A body of balls alone. Either set may be empty: without `inside` there are no upper bounds, without `cover` no
  /// lower ones. Centres and radii are finite, radii are not negative, and no coordinate of a ball's surface is beyond
  /// 1e18. Copies the balls. Time: n log n, a second or two for 8,192 or 100,000 balls. Errors: kUsage (names the ball;
  /// also for two empty sets, and for more than kMostBodyBalls), kOutOfMemory.
  static Result<Body> create(std::span<const Ball> inside, std::span<const Ball> cover);

  std::span<const Ball> inside() const;
  std::span<const Ball> cover() const;
  bool has_mesh() const;

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

/// What is proved about two solids in a pose, by balls alone or by triangles.
enum class Collision {
  kFree,       ///< The solids have no point in common.
  kHit,        ///< They have one.
  kUndecided,  ///< Neither is proved.
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

struct BatchOptions {
  unsigned threads = 0;  ///< Of the host, 0: one per core.
};

/// Two of many bodies, by their indices, and a pose that takes the frame of `b` to the frame of `a`.
struct PosedPair {
  Pose pose;
  std::uint32_t a = 0, b = 0;
};

/// Bounds of the distance between the solid of `a` and that of `b`, whose frame `pose` takes to the frame of `a`. The
/// bounds include all rounding errors: they hold if the balls inside are inside and the covers cover. They are within
/// 3e-6 M + 4e-15 L + 1e-17 of the distances of the sets, where M is the distance of the bodies' middles plus the size
/// of both, and L the length of the shift plus the distances of both middles from the origins of their frames. `start`
/// may be the result of an earlier query of the same two bodies: the search then begins with its pairs, and is faster
/// if the pose has changed little. A start may change the bounds within that accuracy, and which of nearly equal pairs
/// is named; indices that the bodies do not have are ignored. Allocates nothing. Precondition: the rows of the rotation
/// are perpendicular unit vectors to within 1e-12. Where a coordinate of the shift is beyond 1e18, or no number, the
/// bounds may be 0 and infinity.
DistanceBounds distance_bounds(const Body& a, const Body& b, const Pose& pose, const DistanceBounds& start = {});

/// An estimate of the distance, in the interval of `bounds`, a result for `a` and `b`. It divides the interval as the
/// errors of the four balls that give the bounds are to each other on average, which Body::create() measures around a
/// mesh with both sets; at the middle if it knows none. Without an upper bound, the lower one. Allocates nothing.
double estimated_distance(const Body& a, const Body& b, const DistanceBounds& bounds);

/// The same for every pose; most searches start from the result before them. Precondition: `bounds` has the size of
/// `poses`.
void distance_bounds(const Body& a, const Body& b, std::span<const Pose> poses, std::span<DistanceBounds> bounds,
                     const BatchOptions& options = {});

/// The same for pairs of `bodies`, whose indices they hold. Searches start from nothing.
void distance_bounds(std::span<const Body> bodies, std::span<const PosedPair> pairs, std::span<DistanceBounds> bounds,
                     const BatchOptions& options = {});

struct DistanceOptions {
  /// The interval may be as wide as this, in the units of the mesh. 0: as narrow as rounding allows.
  double tolerance = 0;
  /// Where the distance is greater, only that is proved: `lower` is then at least the limit, and `upper` the distance
  /// of some two points.
  double limit = std::numeric_limits<double>::infinity();
  /// Of the surfaces, even where one solid lies inside the other.
  bool surfaces_only = false;
  /// A budget: the search ends after so many comparisons, each of up to 64 pairs of balls around triangles, besides a
  /// first way down both trees, with the best interval so far. Of two budgets the greater one never gives a wider
  /// interval. The greatest number: none; the search is then in an order that takes the least time in all.
  std::uint64_t most_comparisons = std::numeric_limits<std::uint64_t>::max();
};

/// An interval that contains the distance of two solids, and the points that prove its upper end.
struct Distance {
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  double lower = 0;
  double upper = std::numeric_limits<double>::infinity();
  /// Points of the solid of a and of that of b, in the frame of a, at most `upper` apart, up to the rounding of their
  /// coordinates. They lie on the two surfaces, but where one solid lies inside the other or balls decide: then they
  /// are one point of both.
  Point on_a = {0, 0, 0}, on_b = {0, 0, 0};
  /// The triangles of the two meshes that hold the points on the surfaces.
  std::uint32_t triangle_a = kNone, triangle_b = kNone;
  /// Two balls inside with a common point, by their indices in Body::inside(), where they prove the hit, as where
  /// a tolerance ends the search before triangles do; elsewhere no pair, since triangles give both ends. The balls that
  /// bound a distance without triangles are those of DistanceBounds.
  BallPair inside_pair = {};

  /// Undecided: no common point is proved, and the surfaces may touch, to within rounding or the tolerance.
  Collision collision() const {
    return lower > 0 ? Collision::kFree : upper == 0 ? Collision::kHit : Collision::kUndecided;
  }
};

/// The distance between the solid of `a` and that of `b`, whose frame `pose` takes to the frame of `a`, by their
/// triangles. Solids that have a point in common are at distance 0, even where one holds the other. All rounding errors
/// are included: the interval contains the distance of the meshes as they are, and is wider than the tolerance by about
/// 2e-14 times the coordinates (more next to very thin triangles and to edges that are nearly parallel). `upper` is 0
/// only where a common point is proved. `start` may be the result of an earlier query of the same two bodies, as for
/// distance_bounds(). Allocates nothing, unless stopped. Precondition: as for distance_bounds(); likewise for shifts
/// beyond 1e18.
/// A request to `stop` ends the search at its next comparison of triangles. Errors: kUsage (a body without a mesh, an
/// option that is negative or no number), kInterrupted.
Result<Distance> distance(const Body& a, const Body& b, const Pose& pose, const DistanceOptions& options = {},
                          const Distance& start = {}, const std::stop_token& stop = {});

/// The same for every pose; most searches start from the result before them. The intervals do not depend on the number
/// of threads. Precondition: `results` has the size of `poses`. After kInterrupted some results are those of their
/// poses, and the others are as before.
Status distances(const Body& a, const Body& b, std::span<const Pose> poses, std::span<Distance> results,
                 const DistanceOptions& options = {}, const BatchOptions& batch = {}, const std::stop_token& stop = {});

/// Decides by balls, and where they do not, by the triangles of bodies with meshes. Allocates nothing. Precondition: as
/// for distance_bounds().
Collision collide(const Body& a, const Body& b, const Pose& pose);

/// A rigid motion of a body from one pose to another while t grows from 0 to 1: a point of the body, its pivot, moves
/// along a straight line, and the body turns about it about a fixed axis, by at most half a turn, both at constant
/// rates. With the pivot on the axis of the screw that takes `from` to `to`, the motion is that screw.
struct Motion {
  Pose from, to;
  Point pivot = {0, 0, 0};  ///< In the frame of the body.
};

/// `motion.from` at 0, and `motion.to` at 1, up to rounding and to what their rotations lack of a rotation.
Pose pose_at(const Motion& motion, double t);

struct ContactOptions {
  /// Bodies count as in contact where their distance is at most this, in the units of the meshes.
  double clearance = 0;
  double tolerance = 1e-6;  ///< Of t, at least 1e-12.
  bool surfaces_only = false;
};

/// What is proved about a motion.
struct FirstContact {
  double free_until = 0;  ///< There is no contact before this t; 1: there is none at all.
  double contact_at =
      std::numeric_limits<double>::infinity();  ///< There is contact at this t; infinite: none was found.
  /// At `contact_at`, or else at the last t that was tried.
  Distance nearest;

  /// Undecided: the bodies come closer than the tolerance times the greatest speed of a point, and no contact is found.
  Collision collision() const {
    return contact_at <= 1 ? Collision::kHit : free_until >= 1 ? Collision::kFree : Collision::kUndecided;
  }
};

/// The first contact of `b`, in motion, with `a`: not before `free_until`, and no later than `contact_at`, which is no
/// more than the tolerance after a time without proved contact. By conservative advancement: a time at which the
/// distance is d is followed by one until which no point of b moves farther than d. Takes some tens of distances; more,
/// up to the inverse of the tolerance, where the bodies slide past each other. Allocates nothing, unless stopped.
/// Precondition: both poses are as for distance_bounds(). A request to `stop` ends the search at its next comparison of
/// triangles. Errors: those of distance(); kUsage (an option that is negative, too small or no number).
Result<FirstContact> first_contact(const Body& a, const Body& b, const Motion& motion,
                                   const ContactOptions& options = {}, const std::stop_token& stop = {});

}  // namespace medial_vk
