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
  /// boundary determines the radius. Zero if no direction gains anything. `touched`: triangles that may limit the ball,
  /// those of its last step for instance; replaced by those that limit this one.
  Point direction(const Ball& ball, const Exposure& exposure, double step, std::vector<std::uint32_t>& touched);

 private:
  /// The point of a triangle that is nearest to the ball's centre: the centre lies `gap` + radius from it, along the
  /// unit vector `away`.
  struct Contact {
    std::uint32_t triangle;
    Point away;
    double gap;
  };
  bool add_contact(const Ball& ball, std::uint32_t triangle);
  bool has_contact(std::uint32_t triangle) const;
  bool last_limits(const Point& move) const;
  void remember(std::vector<std::uint32_t>& touched) const;
  Point average_of_contacts(const Exposure& exposure, double pace, double accuracy);

  const Solid& solid_;
  std::vector<Contact> contacts_;
  std::vector<double> weights_;
};

}  // namespace medial_vk
