// Voronoi diagrams of segments by others, beside which ours is timed.
#pragma once

#include "medial_vk/plane_shape.h"

namespace medial_vk::bench {

/// Boost.Polygon's diagram of all segments, both sides of each, with coordinates rounded to 2^26 steps of the longest
/// side. Returns the number of its vertices; 0 without Boost. One thread.
std::size_t boost_voronoi(const PreparedShape& shape);

/// CGAL's segment Delaunay graph with its filtered traits; the number of its faces, 0 without CGAL. One thread.
std::size_t cgal_delaunay_graph(const PreparedShape& shape);

}  // namespace medial_vk::bench
