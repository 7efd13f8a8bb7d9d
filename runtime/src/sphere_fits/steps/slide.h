// The motion of a ball for which a union grows most, while the ball stays inside the solid.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/dynamic_union.h"
#include "solid/solid.h"

namespace medial_vk {

/// A step of steepest ascent under contacts (docs/theory.md, "Tight spheres"). For one thread.
class Slider {
 public:
  explicit Slider(const Solid& solid) : solid_(solid) {}

  /// The motion of the centre, at most by `step`, with the greatest gain of the union to first order, where the
  /// boundary within reach determines the radius. Zero if no direction gains anything.
  Point direction(const Ball& ball, const Exposure& exposure, double step);

 private:
  /// A point of the boundary: the ball's centre lies `gap` + radius from it, along the unit vector `away`.
  struct Contact {
    Point away;
    double gap;
  };
  void find_contacts(const Ball& ball, double reach);
  Point average_of_contacts(const Exposure& exposure, double pace, double accuracy);

  const Solid& solid_;
  std::vector<Contact> contacts_;
  std::vector<double> weights_;
  std::vector<std::uint32_t> nearby_;
};

}  // namespace medial_vk
