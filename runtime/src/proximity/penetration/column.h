// A column: a rectangle in x and y, and the volume that two unions of balls have in common over it, at least.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "medial_vk/ball.h"

namespace medial_vk {

struct Rectangle {
  std::array<double, 2> from = {0, 0}, to = {0, 0};

  double area() const { return (to[0] - from[0]) * (to[1] - from[1]); }
};

/// Whether the circle around a ball's projection comes into the rectangle, up to rounding.
bool meets(const Ball& ball, const Rectangle& rectangle);

struct Column {
  Rectangle rectangle;
  std::vector<Ball> a, b;  ///< Those of both sets that matter over the rectangle.
  double lower = 0;    ///< Of the common volume: proved, but for the roundings of the sum that the caller takes off.
  double missing = 0;  ///< An estimate of what a division may add.
};

class ColumnMeter {
 public:
  ColumnMeter();
  ~ColumnMeter();

  /// Finds both numbers, and takes balls out of the lists that change nothing over the rectangle. Balls of radius 0 are
  /// no part of a union.
  void measure(Column& column);

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace medial_vk
