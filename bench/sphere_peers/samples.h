// Points of a solid and of its boundary, and depths, for methods that work on samples.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "solid/solid.h"

namespace medial_vk::bench {

/// `count` points in the solid, uniformly distributed: those of a box that are inside. The same seed gives the same
/// points. Precondition: the solid has a positive volume.
std::vector<Point> points_inside(const Solid& solid, std::size_t count, std::uint64_t seed, unsigned threads);

/// A point of the boundary with the unit normal of its triangle, which points outwards.
struct SurfacePoint {
  Point at, normal;
};

/// `count` points, evenly by area.
std::vector<SurfacePoint> points_of_boundary(const Solid& solid, std::size_t count);

/// The distance to the boundary, negative outside of the solid, and its gradient there.
struct Depth {
  double depth;
  Point gradient;  ///< Of length 1; 0 on the boundary.
};
Depth depth_of(const Solid& solid, const Point& p);

/// The largest balls inside the solid at those centres that are inside; others have none. Proved like the result of
/// measure_depths(). Ends the program if that call fails.
std::vector<Ball> largest_inside(const Solid& solid, std::span<const Point> centres, unsigned threads);

}  // namespace medial_vk::bench
