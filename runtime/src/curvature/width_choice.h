// Which of several widths of a window is the best at a tip (docs/theory.md, "Curvature from balls").
#pragma once

#include <cstddef>
#include <span>

namespace medial_vk {

/// How much a width differs from the next narrower one at a tip; NaN where one of them gives no result.
struct WidthDifference {
  double form, angle;
};

struct WidthChoice {
  std::size_t step = 0;         ///< 0: no width gives a result.
  double form_difference = 0;   ///< From the next narrower and wider ones, 1 / length.
  double angle_difference = 0;  ///< Likewise, of the normals, radians.
};

/// The width with the least likely error, by the differences of each width but the narrowest, the first one, which is
/// not chosen. Each width is about sqrt(2) of the one before. Where windows lie within single facets, narrow ones
/// differ little from each other, and are wrong. So a width is no better than the wider ones would let it be if their
/// differences were bias, of which the next narrower one has a quarter.
WidthChoice choose_width(std::span<const WidthDifference> differences);

}  // namespace medial_vk
