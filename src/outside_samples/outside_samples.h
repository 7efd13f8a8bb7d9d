// How much of balls that may reach out of a solid does, by samples.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "medial_vk/ball.h"

namespace medial_vk {

/// A volume from samples.
struct OutsideEstimate {
  double volume = 0;
  /// Of the volume. Where no sample is outside, the volume of three samples: the true one is less, with a probability
  /// of 95 %.
  double standard_error = 0;
};

/// Balls reach out of a solid within layers of a known thickness on their surfaces. Points of these layers, uniform by
/// volume and the same in each run, of which the caller finds out whether they are outside.
class OutsideSamples {
 public:
  /// No ball reaches out by more than `protrusion`: with a radius that is less by that it is inside. Balls of radius 0
  /// are left out.
  OutsideSamples(std::span<const Ball> balls, double protrusion, std::size_t count);

  /// As many as asked for; none if there is no ball, or no layer.
  std::span<const Point> points() const { return points_; }
  /// Of the union of the balls outside the solid. One depth for each point, negative outside, as by measure_depths().
  OutsideEstimate estimate(std::span<const double> depths) const;

 private:
  double radius_inside(const Ball& ball) const;
  double weight(const Point& p) const;

  std::vector<Ball> balls_;
  double protrusion_;
  double volume_ = 0;  // of all layers
  std::vector<Point> points_;
};

}  // namespace medial_vk
