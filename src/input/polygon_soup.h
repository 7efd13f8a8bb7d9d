// What the readers of polygon files fill, and the step from there to triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/mesh.h"

namespace medial_vk {

/// Polygons over shared vertices: the corners of all of them one after the other, and how many each has.
struct PolygonSoup {
  std::vector<Point> vertices;
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> sizes;
};

/// Cuts every polygon into triangles over its own corners; all indices must be valid. Polygons of fewer than three
/// corners are left out and counted, those that cannot be cut without overlap become a fan and are counted; so do those
/// that would take too long.
Mesh triangulate(PolygonSoup soup);

/// Cuts one polygon and appends its triangles. False: it crosses itself, or `work_left` (looks at a corner or a cell of
/// a grid, taken from it as they are made) was used up, and a fan was appended.
bool triangulate_polygon(const std::vector<Point>& vertices, const std::uint32_t* corners, std::uint32_t size,
                         std::int64_t& work_left, std::vector<Triangle>& triangles);

}  // namespace medial_vk
