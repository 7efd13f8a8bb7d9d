// One number of balls for a whole robot: who gets how many.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace medial_vk {

/// How a part gains from balls.
struct NeedCurve {
  /// Volume that k + 1 balls leave uncovered, for as many k as were tried; cubic metres.
  std::vector<double> uncovered;
  /// The part is a ball: one is all it needs.
  bool is_ball = false;
};

/// `total` balls, at least one each: every next ball goes where it covers the most. Curves are taken for their lower
/// convex hulls, so that a ball that pays off only together with the next counts with it. A curve is that of beginnings
/// of one set; a set made for its count does better, so no ball counts for less than the fall of error as count^-0.6;
/// beyond its end a curve goes on as a power of the count, as steep as its last half was. Parts that are balls get one,
/// so fewer may be given out. Ties go to the first part. `total` is not below the number of parts.
std::vector<std::size_t> share_out(std::span<const NeedCurve> curves, std::size_t total);

}  // namespace medial_vk
