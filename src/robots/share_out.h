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
  /// No more balls than these are of use.
  bool ends = false;
};

/// `total` balls, at least one each: every next ball goes where it covers the most, on average over those that would
/// follow it there up to curve_length(), as a ball may pay off only together with the next; but none counts for less
/// than the fall of error as count^-0.6. Beyond its end a curve goes on as a power of the count, as steep as its last
/// half was. Parts that are balls get one, so fewer may be given out. Ties go to the first part. `total` is not below
/// the number of parts.
///
/// What the next ball is worth to a part depends on that part alone and on how many it has. So if the curves do not
/// depend on `total` and reach far enough, a larger total gives no part fewer (the shares are house-monotone; M.
/// Balinski and H. P. Young, "Fair Representation", 1982).
std::vector<std::size_t> share_out(std::span<const NeedCurve> curves, std::size_t total);

/// How far a curve must be known to say what one more ball than `count` is worth.
std::size_t curve_length(std::size_t count);

}  // namespace medial_vk
