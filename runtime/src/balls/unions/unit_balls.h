// What every way to measure a union of balls begins and ends with.
#pragma once

#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// Error: kUsage, naming the ball that is none.
Status check_balls(std::span<const Ball> balls);
/// A power of two that brings all numbers to at most 1, which costs no rounding.
double scale_of(std::span<const Ball> balls);
/// The balls by that scale, tiny numbers to multiples of 2^-150.
Ball scaled_ball(const Ball& ball, double scale);
std::vector<Ball> scaled_balls(std::span<const Ball> balls, double scale);
/// Sums with the rounding errors of the additions carried along (Neumaier): the result does not wear out with n.
class CarefulSum {
 public:
  void add(double term);
  double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0, lost_ = 0;
};
double careful_sum(std::span<const double> terms);

}  // namespace medial_vk
