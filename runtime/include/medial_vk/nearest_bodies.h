// The bodies of many that are nearest to one: a tree over the balls around bodies leaves most of them out, and bounds
// of distances (proximity.h) decide among the others (docs/theory.md, "The nearest of many bodies").
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "medial_vk/proximity.h"

namespace medial_vk {

/// A body, and the pose that takes its frame to that of the world. Bodies share their data when they are copied.
struct PlacedBody {
  Body body;
  Pose pose;
};

/// Bodies in the world, and a tree over balls around them. Immutable: any number of threads may query it.
class PlacedBodies {
 public:
  /// Time: n log n, a second for 100,000 bodies. Precondition: the rotations are as for distance_bounds(). Errors:
  /// kUsage (a pose that shifts beyond 1e18 or is no number; more than kMostBodyBalls bodies), kOutOfMemory.
  static Result<PlacedBodies> create(std::span<const PlacedBody> bodies);

  std::size_t size() const;

 private:
  friend struct Internals;
  struct Impl;
  explicit PlacedBodies(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

  std::shared_ptr<const Impl> impl_;
};

struct NearestBodiesOptions {
  std::size_t count = 1;  ///< k, at least 1.
  /// Bodies that are proved to be farther away are left out.
  double limit = std::numeric_limits<double>::infinity();
  /// Distances of bodies with meshes are those of their triangles, to within rounding and `tolerance`. Otherwise, and
  /// for bodies without a mesh, they are those of balls.
  bool by_triangles = true;
  double tolerance = 0;  ///< As in DistanceOptions.
};

/// A body by its index, and an interval that contains its distance.
struct NearBody {
  std::size_t index = 0;
  double lower = 0, upper = std::numeric_limits<double>::infinity();
};

struct NearBodies {
  /// Every body that may be one of the k nearest, by upper ends of the intervals, and of equal ones by index. At least
  /// k, where there are as many within the limit: more, where intervals overlap so that the k nearest are not proved,
  /// or where several are at the same distance, such as 0.
  std::vector<NearBody> bodies;
  /// All other bodies are proved to be at least so far away: farther than each of the first k, or beyond the limit.
  /// Infinite: there are no others.
  double others = std::numeric_limits<double>::infinity();
};

/// The bodies of `among` that are nearest to `body`, whose frame `pose` takes to that of the world. All rounding errors
/// are included. Distances are exact where both bodies have meshes, and intervals then as wide as rounding allows;
/// without covers a lower end is 0, and without balls inside an upper one infinite. Precondition: the rotation is as
/// for distance_bounds(). Errors: kUsage (an option out of range, a pose as above), kOutOfMemory.
Result<NearBodies> nearest_bodies(const PlacedBodies& among, const Body& body, const Pose& pose,
                                  const NearestBodiesOptions& options = {});

}  // namespace medial_vk
