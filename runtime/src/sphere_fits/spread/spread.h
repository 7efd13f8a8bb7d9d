// Sets of balls inside a solid that leave a narrow gap, for any number of balls.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "sphere_fits/spread/spread_search.h"

namespace medial_vk {

/// The set of n balls is that of the greatest number T of 1, 2, 3 ... 8, 10, 12, 14, 16, 20 ... (four for each
/// doubling) that is not above n, with n - T balls added where the gap is widest; that of T is the set before it with
/// balls added, improved. No step widens the gap, so that of n + 1 balls is not wider than that of n. Functions throw
/// std::bad_alloc and Stopped.
class BallSpread {
 public:
  /// Keeps a reference to the solid.
  BallSpread(const Solid& solid, const Threads& threads);

  /// The balls, fewer where no more are found.
  std::vector<Ball> of(std::size_t count);
  /// The widest gaps of sets of 1, 2, 3 ... `count` balls, among places of the boundary; fewer where no more balls are
  /// found.
  std::vector<double> gaps(std::size_t count);

 private:
  void grow(std::size_t count);
  void go_to(std::size_t count);

  SpreadSearch search_;
  bool ends_ = false;
  bool is_within_step_ = false;  // true after a stop: the balls of the search are none of those that there have been
  std::vector<double> gaps_;     // by number of balls
  std::map<std::size_t, std::vector<Ball>> tops_;  // the improved sets
};

/// How many balls as large as the largest in the solid have half of its volume together: with fewer balls inside, most
/// of it is uncovered however they lie. 0 if its volume is not known.
std::size_t sparse_count(const Solid& solid);

}  // namespace medial_vk
