// The closest two balls of two trees: docs/theory.md, "Distances".
#pragma once

#include "medial_vk/proximity.h"
#include "proximity/body_tree.h"
#include "proximity/tree_search.h"

namespace medial_vk {

/// A separation is negative if the balls overlap.
struct ClosestBalls {
  float separation = kFarther;
  BallPair balls;
};

/// The closest two balls, by computed separations, or, once a computed separation is at most `enough`, some two with
/// such a separation; `most` and no balls, if none are closer than `most`. Preconditions: no tree is empty; `start`
/// names two balls, or none. Allocates nothing.
ClosestBalls closest_balls(const BodyTree& a, const BodyTree& b, const FloatPose& pose, const BallPair& start,
                           float enough, float most = kFarther);

/// Balls near the closest points of two balls of other sets of the bodies, each in its frame: where closest_balls() may
/// start. Precondition: no tree is empty. Allocates nothing.
BallPair balls_near(const BodyTree& a, const BodyTree& b, const FloatPose& pose, const FloatBall& of_a,
                    const FloatBall& of_b);

}  // namespace medial_vk
