// Points spread evenly over a mesh, over the envelope of balls, and over single spheres. The same input gives the same
// points on every machine.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/mesh.h"
#include "sphere_fits/quality/envelope.h"
#include "sphere_fits/quality/threads.h"

namespace medial_vk {

/// One for each equal share of the area, at a position in its triangle from a low-discrepancy sequence (the generalised
/// golden ratio, M. Roberts 2018).
std::vector<Point> sample_surface(const Mesh& mesh, std::size_t count);

/// Of the sphere of radius 1, the k-th of `count`, along a spiral.
Point spiral_point(std::size_t k, std::size_t count);

struct WeightedPoint {
  Point at;
  double area;  ///< The area that the sample represents.
};

/// About `count` points of the envelope: evenly on each sphere, without those in other balls. The remaining points of a
/// ball represent its share of the envelope, which is exact.
std::vector<WeightedPoint> sample_envelope(const Envelope& envelope, std::size_t count, const Threads& threads);

}  // namespace medial_vk
