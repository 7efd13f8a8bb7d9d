// Points spread evenly over a mesh, over the envelope of balls, and over single spheres. The same numbers give the same
// points everywhere.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/mesh.h"
#include "spheres/measures/envelope.h"
#include "spheres/measures/threads.h"

namespace medial_vk {

/// One for each equal share of the area, at a place in its triangle that a low-discrepancy sequence gives (the
/// generalised golden ratio, M. Roberts 2018).
std::vector<Point> sample_surface(const Mesh& mesh, std::size_t count);

/// Of the sphere of radius 1, the k-th of `count`, along a spiral.
Point spiral_point(std::size_t k, std::size_t count);

struct WeightedPoint {
  Point at;
  double area;  ///< That it stands for.
};

/// About `count` points of the envelope: on each sphere evenly, those in other balls left out, those that are left
/// standing for that ball's share of the envelope, which is exact.
std::vector<WeightedPoint> sample_envelope(const Envelope& envelope, std::size_t count, const Threads& threads);

}  // namespace medial_vk
