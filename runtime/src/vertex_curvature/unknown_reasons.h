// Why nothing is known at a vertex.
#pragma once

#include <span>

#include "medial_vk/curvature.h"
#include "sphere_fits/quality/nearest_ball_tree.h"

namespace medial_vk {

class UnknownReasons {
 public:
  /// The balls and their curvatures outlive it.
  UnknownReasons(std::span<const Ball> balls, const BoundaryCurvature& curvature);

  /// The state of the tip that is next to p, of the ball nearest to p: what is not known there is not known at p.
  /// kEdge if that tip is known, so that p is beyond it; kFew if there are no balls.
  CurvatureState at(const Point& p) const;

 private:
  std::span<const Ball> balls_;
  const BoundaryCurvature& curvature_;
  NearestBallTree tree_;
};

}  // namespace medial_vk
