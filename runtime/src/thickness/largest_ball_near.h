// The largest ball in a solid, or outside it, that comes close to a point (docs/theory.md, "Thickness").
#pragma once

#include "thickness/cell_search.h"
#include "thickness/facet_search.h"

namespace medial_vk {

/// Searches for one point after another in the same memory. The next point had better be near: contacts that were of
/// use at one are tried first at the next, and the ball is sought in a direction that leans as the last one did.
class LargestBallNear {
 public:
  explicit LargestBallNear(const ThicknessField& field)
      : options_(field.options), balls_(field), facets_(balls_), cells_(balls_) {}
  LargestBallNear(const LargestBallNear&) = delete;
  LargestBallNear& operator=(const LargestBallNear&) = delete;

  /// `inward`: a unit vector that is likely to lead to the ball.
  Thickness find(const Point& p, const Point& inward);

 private:
  void describe(const Point& p, Thickness& out);

  const ThicknessOptions& options_;
  BallsNear balls_;
  FacetSearch facets_;
  CellSearch cells_;
  std::vector<BallContact> touched_;
  Point lean_ = {0, 0, 0};  // the direction of the last ball less the likely one
};

}  // namespace medial_vk
