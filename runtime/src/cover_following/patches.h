// The boundary of a solid, divided among balls: each part of a triangle belongs to one ball.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/mesh_view.h"

namespace medial_vk {

/// A convex hull of points of one triangle. Together, the patches of all balls are the triangle.
struct Patch {
  std::uint32_t triangle;
  std::uint32_t first, count;  ///< In Patches::corners.
  double area;                 ///< In the frame in which it was made.
};

/// A point of a triangle: multiples of 2^-10 that sum to 1, exactly.
using Weights = std::array<double, 3>;

/// Patches by ball.
struct Patches {
  std::vector<std::uint32_t> first;  ///< Of ball i: patches [first[i], first[i + 1]).
  std::vector<Patch> patches;
  std::vector<Weights> corners;

  std::span<const Patch> of(std::size_t ball) const {
    return {patches.data() + first[ball], first[ball + 1] - first[ball]};
  }
};

/// Every part goes to a ball that holds it, to the one in which it is deepest; at the end of the division, to the ball
/// that must grow least. Balls of radius 0 get none. At least one ball has a positive radius. Deterministic. Throws
/// std::bad_alloc.
Patches divide_boundary(std::span<const Point> vertices, std::span<const Triangle> triangles,
                        std::span<const Ball> balls, unsigned threads);

inline Point point_of(const Weights& weights, const std::array<Point, 3>& corner) {
  Point p;
  for (std::size_t k = 0; k < 3; ++k) {
    p[k] = weights[0] * corner[0][k] + weights[1] * corner[1][k] + weights[2] * corner[2][k];
  }
  return p;
}

}  // namespace medial_vk
