// Queries of two bodies for other rooms: bounds below a given distance, in poses that were computed with an error.
#pragma once

#include <array>
#include <stop_token>

#include "medial_vk/ball.h"
#include "medial_vk/proximity.h"
#include "proximity/placement.h"

namespace medial_vk {

/// A small ball that holds the solid of a body; nothing if the body has neither a mesh nor a cover. A few hundred
/// operations for each corner or ball.
bool find_ball_around(const Body& body, Ball& ball);

/// Two bodies in a pose. Bounds hold wherever no point of b is farther than `error` from where the pose takes it.
class PairQuery {
 public:
  PairQuery(const Body& a, const Body& b, const Pose& pose, double error);

  bool is_in_range() const { return placement_.is_in_range(); }
  bool has_covers() const;
  bool has_insides() const;

  /// `most`, or a lower bound of the distance that is less. `pair` becomes the two balls of the covers that give it, if
  /// it is less, and is where the search starts. Precondition: has_covers().
  double lower_bound(double most, BallPair& pair) const;
  /// The same for an upper bound, by balls inside. Precondition: has_insides().
  double upper_bound(double most, BallPair& pair) const;
  /// As the public call. Precondition: both bodies have meshes; the options are good. Throws LoopStopped after a
  /// request to `stop`.
  Distance distance(const DistanceOptions& options, const Distance& start, const std::stop_token& stop = {}) const;

 private:
  const BodyImpl& in_a_;
  const BodyImpl& in_b_;
  Placement placement_;
};

}  // namespace medial_vk
