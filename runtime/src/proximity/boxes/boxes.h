// Boxes around points, in float, eight side by side: docs/theory.md, "Exact distances".
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "base/point_ops.h"

namespace medial_vk {

/// All points c + s_1 e_1 + s_2 e_2 + s_3 e_3 with the centre c, half edges e_i and |s_i| <= 1.
struct FloatBox {
  std::array<float, 3> centre = {0, 0, 0};
  std::array<std::array<float, 3>, 3> half_edges = {};
};

struct alignas(32) EightBoxes {
  static constexpr std::size_t kWidth = 8;

  std::array<std::array<float, kWidth>, 3> centre = {};                     ///< [axis][box]
  std::array<std::array<std::array<float, kWidth>, 3>, 3> half_edges = {};  ///< [edge][axis][box]

  void set(std::size_t k, const FloatBox& box);
};

/// A box that holds all points, of which no coordinate is wrong by more than 2^-51 of its distance from the origin, up
/// to 2^-147 where floats underflow. Its first edge is along `normal`, where that has a length; of the others the sum
/// is small. Perpendicular up to rounding, it is no longer along any edge than the points are, so |c| + |e_1| + |e_2| +
/// |e_3| is at most 3.001 times the greatest distance of a point from the origin: along each edge, its middle and its
/// half add up to no more than that.
FloatBox box_around(std::span<const Point> points, const Point& normal);

}  // namespace medial_vk
