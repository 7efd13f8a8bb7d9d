// The first and last steps of all methods that measure a union of balls.
#pragma once

#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// Error: kUsage (names the invalid ball).
Status check_balls(std::span<const Ball> balls);
/// A power of two that scales all numbers to at most 1, without rounding.
double scale_of(std::span<const Ball> balls);
/// The balls multiplied by that scale, with tiny numbers rounded to multiples of 2^-150.
Ball scaled_ball(const Ball& ball, double scale);
std::vector<Ball> scaled_balls(std::span<const Ball> balls, double scale);
/// A sum that also adds up the rounding errors of its additions (Neumaier), so that the error of the result does not
/// grow with n.
class CarefulSum {
 public:
  void add(double term);
  double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0, lost_ = 0;
};
double careful_sum(std::span<const double> terms);

}  // namespace medial_vk
