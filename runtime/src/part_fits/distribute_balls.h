// Distribution of a number of balls among the parts of an assembly.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace medial_vk {

/// The benefit of balls to a part.
struct NeedCurve {
  /// The volume that k + 1 balls leave uncovered, for every k that was evaluated; cubed mesh units.
  std::vector<double> uncovered;
  /// True if the part is a ball, which requires one ball only.
  bool is_ball = false;
  /// True if more balls than these have no benefit.
  bool ends = false;
  /// The widest gap that k + 1 balls leave, for every k that was evaluated; mesh units. For distribute_by_gap() alone.
  std::vector<double> gaps = {};
};

/// Distributes `total` balls, at least one to each part: every next ball goes to the part where it covers the most.
/// This is an average over the balls that would follow it there up to curve_length(), since a ball may cover much only
/// together with the next one; it is at least the decrease of an error that falls as count^-0.6. Beyond its end a curve
/// continues as a power of the count, as steep as its last half. Parts that are balls get one, so fewer than `total`
/// may be distributed. Ties go to the first part. `total` is not below the number of parts.
///
/// The worth of the next ball to a part depends on that part alone and on its number of balls. So if the curves do not
/// depend on `total` and reach far enough, a larger total gives no part fewer (the shares are house-monotone; M.
/// Balinski and H. P. Young, "Fair Representation", 1982).
std::vector<std::size_t> distribute_balls(std::span<const NeedCurve> curves, std::size_t total);

/// Distributes them such that the widest gap of all parts is narrow: every next ball goes to the part with the widest
/// one. As gaps do not widen with the number of balls, no distribution of as many balls has a narrower one. Beyond its
/// end a curve continues as count^-0.5, as on a sheet. Otherwise as above.
std::vector<std::size_t> distribute_by_gap(std::span<const NeedCurve> curves, std::size_t total);

/// The length of a curve that determines the worth of one more ball than `count`.
std::size_t curve_length(std::size_t count);

}  // namespace medial_vk
