#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "medial_vk/bvh.h"
#include "medial_vk/site_voronoi.h"

namespace medial_vk {

inline double greatest_coordinate(const BvhBox& box) {
  double greatest_size = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    greatest_size = std::max({greatest_size, std::fabs(box.lower[k]), std::fabs(box.upper[k])});
  }
  return greatest_size;
}

constexpr std::uint32_t kVoxelsOfATile = 16;  // along its side

/// Bounds the error of a distance from a point of the grid, rounded up to whole tiles, to an element in it: middles of
/// tiles at the upper end are beyond the grid itself. As distance_rounding() of a solid:
/// below 16 u times the lengths involved, u = 2^-53, which are below twice the longest side of the grid; and one
/// rounding of coordinates, u times their size, for each difference of points. Middles of cubes are sums of an origin
/// and at most twelve halves of sides, each with a rounding of that size along each axis, which moves a distance by
/// less than 12 sqrt(3) u times the size.
inline double rounding_in(const SiteGrid& grid) {
  constexpr double u = 0x1p-53;
  std::array<std::uint32_t, 3> tiled = grid.size;
  for (std::uint32_t& voxels : tiled) voxels = (voxels + kVoxelsOfATile - 1) / kVoxelsOfATile * kVoxelsOfATile;
  const Point upper = grid.corner(tiled);
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, upper[k] - grid.origin[k]);
  return 32 * u * longest + 28 * u * greatest_coordinate({grid.origin, upper});
}

}  // namespace medial_vk
