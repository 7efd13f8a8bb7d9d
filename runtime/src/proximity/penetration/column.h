// A column: a rectangle in x and y, and the volume that two unions of balls have in common over it, at least.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/ball.h"

namespace medial_vk {

struct Rectangle {
  std::array<double, 2> from = {0, 0}, to = {0, 0};

  double area() const { return (to[0] - from[0]) * (to[1] - from[1]); }
};

/// Whether the circle around a ball's projection comes into the rectangle, up to rounding.
bool meets(const Ball& ball, const Rectangle& rectangle);

/// Bounds of the common volume over a rectangle.
struct ColumnVolume {
  double lower = 0;    ///< Proved, but for the roundings of the sum that the caller takes off.
  double missing = 0;  ///< An estimate of what a division may add.
};

/// Balls of radius 0 are no part of a union.
ColumnVolume measure_column(std::span<const Ball> a, std::span<const Ball> b, const Rectangle& rectangle);

}  // namespace medial_vk
