// The greatest radii with which a hull with given centres fits into a solid.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "ball_hulls/axis_point.h"
#include "hull_fits/search/node_slabs.h"
#include "medial_vk/ball_hull.h"
#include "solid/solid.h"

namespace medial_vk {

using IsPromising = std::function<bool(const BallHull& hull)>;

/// Makes hulls of centres inside a solid. Several threads may use one object.
class FreeRadii {
 public:
  /// Radii are at least `least`, and triangles may be deeper in a hull by `tolerance`; both in mesh units.
  FreeRadii(const Solid& solid, double least, double tolerance)
      : solid_(solid), slabs_(solid.bvh()), least_(least), tolerance_(tolerance) {}

  double least() const { return least_; }
  /// The hull of the first `count` centres with the greatest radii, by their sum, such that no triangle meets it, or
  /// for two `equal` ones. No value: there are none, or the first centre is outside of the solid. Radii are at most
  /// those of the balls around the centres, so the hull is nearly free where these are small, too.
  /// `is_promising`, if given, is called once with the radii that the distances of a few balls of the axis permit,
  /// which nearly always hold more than the final ones; no value if it returns false.
  std::optional<BallHull> fit(const std::array<Point, 3>& centres, std::uint32_t count, bool equal,
                              const IsPromising& is_promising = {}) const;
  /// By how much the deepest triangle is in the hull; not positive if none is.
  double greatest_depth(const BallHull& hull) const;

 private:
  class Walk;

  const Solid& solid_;
  NodeSlabs slabs_;
  double least_, tolerance_;
};

}  // namespace medial_vk
