#include "output/medial_formats/glb_balls.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "output/medial_formats/ball_colours.h"

namespace medial_vk {

float shortened(double x) {
  const auto rounded = static_cast<float>(x);
  return std::abs(static_cast<double>(rounded)) > std::abs(x) ? std::nextafter(rounded, 0.0f) : rounded;
}

float lengthened(double x) {
  const auto rounded = static_cast<float>(x);
  return double{rounded} < x ? std::nextafter(rounded, std::numeric_limits<float>::infinity()) : rounded;
}

void CentreBox::add(const Point& centre) {
  if (is_empty_) lower_ = upper_ = centre;
  is_empty_ = false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lower_[axis] = std::min(lower_[axis], centre[axis]);
    upper_[axis] = std::max(upper_[axis], centre[axis]);
  }
}

Point CentreBox::middle() const {
  Point middle;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    middle[axis] = static_cast<float>(lower_[axis] + (upper_[axis] - lower_[axis]) / 2);
  }
  return middle;
}

namespace {

/// A centre in float, relative to the middle.
struct RoundedCentre {
  std::array<float, 3> centre = {};
  double moved = 0;    // from the exact one
  double largest = 0;  // coordinate of the exact one
};

RoundedCentre rounded_centre(const Point& centre, const Point& middle) {
  RoundedCentre rounded;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double from_middle = centre[axis] - middle[axis];
    rounded.centre[axis] = static_cast<float>(from_middle);
    rounded.moved = std::hypot(rounded.moved, from_middle - double{rounded.centre[axis]});
    rounded.largest = std::max(rounded.largest, std::abs(from_middle));
  }
  return rounded;
}

}  // namespace

// The radius is reduced by the motion of the centre: the distance of the rounded centre from the exact one, and the
// error of that distance, from the difference of doubles (2^-53 of the largest) and some operations (2^-50 of the
// result).
GlbBall glb_ball(const Ball& of, const Point& middle) {
  const RoundedCentre at = rounded_centre(of.centre, middle);
  const double radius = of.radius - at.moved * (1 + 0x1p-50) - 0x1p-51 * at.largest;
  return {at.centre, shortened(std::max(0.0, radius))};
}

// As above, with the same bounds added; 2^-49 of the sum is more than its own rounding.
GlbBall glb_ball_around(const Ball& of, const Point& middle) {
  const RoundedCentre at = rounded_centre(of.centre, middle);
  const double radius = (of.radius + at.moved + 0x1p-51 * at.largest) * (1 + 0x1p-49);
  return {at.centre, of.radius > 0 ? lengthened(radius) : 0};
}

std::array<std::vector<std::uint32_t>, kColourSteps> spheres_by_colour(std::span<const MedialSphere> spheres,
                                                                       double least_angle) {
  std::array<std::vector<std::uint32_t>, kColourSteps> by_colour;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const float position = colour_share(spheres[i].object_angle, least_angle) * static_cast<float>(kColourSteps);
    by_colour[std::min(static_cast<std::uint32_t>(position), kColourSteps - 1)].push_back(
        static_cast<std::uint32_t>(i));
  }
  return by_colour;
}

}  // namespace medial_vk
