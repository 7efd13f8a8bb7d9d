// The directions in which balls spread.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "medial_vk/ball.h"

namespace medial_vk::bench {

/// Of balls as bodies of equal density: the centroid, and the axes of the covariance matrix, perpendicular unit vectors
/// by falling variance. (The moments of the balls themselves add the same to all variances.) Balls of radius 0 count
/// equally among themselves. Precondition: one ball or more.
struct PrincipalAxes {
  Point centroid = {0, 0, 0};
  std::array<Point, 3> axes = {};

  PrincipalAxes(std::span<const Ball> balls, std::span<const std::uint32_t> chosen);
};

}  // namespace medial_vk::bench
