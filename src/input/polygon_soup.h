// The common output of the readers of polygon files, and its conversion to triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/mesh.h"

namespace medial_vk {

/// Polygons over shared vertices: the corners of all polygons in sequence, and the number of corners of each.
struct PolygonSoup {
  std::vector<Point> vertices;
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> sizes;
};

/// Cuts every polygon into triangles over its own corners; all indices must be valid. Polygons of fewer than three
/// corners are left out and counted. Polygons that cannot be cut without overlap, or would take too long, become a fan
/// and are counted.
Mesh triangulate(PolygonSoup soup);

/// Cuts one polygon and appends its triangles. False: it crosses itself, or `work_left` (visits of a corner or of a
/// cell of a grid, which are subtracted from it) was used up, and a fan was appended.
bool triangulate_polygon(const std::vector<Point>& vertices, const std::uint32_t* corners, std::uint32_t size,
                         std::int64_t& work_left, std::vector<Triangle>& triangles);

}  // namespace medial_vk
