// Rectangle swept spheres: all points within a radius of a rectangle (S. Stolpner, "Medial Spheres for Shape
// Representation", 2011, Section 8.4; E. Larsen, S. Gottschalk, M. Lin, D. Manocha, "Fast Proximity Queries with Swept
// Sphere Volumes", 1999).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "medial_vk/ball.h"
#include "medial_vk/pose.h"

namespace medial_vk::bench {

struct SweptRectangle {
  /// Perpendicular unit vectors: along both sides of the rectangle, and its normal.
  std::array<Point, 3> axes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Point corner = {0, 0, 0};
  std::array<double, 2> sides = {0, 0};  ///< Their lengths, either of which may be 0.
  double radius = 0;

  /// Holds the chosen balls, up to rounding; exactly the ball if one is chosen. Precondition: one or more.
  static SweptRectangle around(std::span<const Ball> balls, std::span<const std::uint32_t> chosen);
  /// Searches divide the larger of two volumes.
  double size() const;
  double volume() const;
};

/// The distance of a point from the rectangle.
double distance_to_rectangle(const SweptRectangle& rectangle, const Point& p);

/// Between the rectangles, exact up to rounding; 0 if they meet. `pose` takes the frame of `b` to that of `a`.
double distance_of_rectangles(const SweptRectangle& a, const SweptRectangle& b, const Pose& pose);

/// Between the swept spheres: the distance of the rectangles less both radii.
double separation(const SweptRectangle& a, const SweptRectangle& b, const Pose& pose);

}  // namespace medial_vk::bench
