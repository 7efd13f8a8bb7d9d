// The vertices of the Voronoi diagram of points.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/mesh_view.h"

namespace medial_vk::bench {

struct VoronoiVertex {
  Point at;
  double slack;                         ///< The true vertex is at most this far from `at`.
  std::array<std::uint32_t, 4> points;  ///< The nearest ones, or of more than four of them some.
};

/// Up to rounding, by the regular triangulation of balls of radius 0; where more than four points are equally near
/// there are several vertices at one place, and each of these points is one of `points` of one of them. Vertices far
/// away from all points may be missing. Ends the program if there are more than 24 vertices a point.
std::vector<VoronoiVertex> voronoi_vertices(std::span<const Point> points, unsigned threads);

}  // namespace medial_vk::bench
