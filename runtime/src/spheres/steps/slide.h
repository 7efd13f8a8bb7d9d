// Where a ball of a union should go so that the union grows most, while it stays inside the solid.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/dynamic_union.h"
#include "mesh/solid.h"

namespace medial_vk {

/// A step of steepest ascent under contacts (docs/theory.md, "Tight spheres"). For one thread.
class Slider {
 public:
  explicit Slider(const Solid& solid) : solid_(solid) {}

  /// How the centre of the ball should move, at most by `step`, for the union to gain most to first order, where the
  /// boundary within reach lets the radius follow. Zero if no direction gains anything.
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
