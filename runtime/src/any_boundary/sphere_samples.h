// Samples of the sphere around a cell, and the average outward flux through it (Section 2.3).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "any_boundary/boundary_queries.h"

namespace medial_vk::any_boundary {

/// For one thread at a time.
class SphereSamples {
 public:
  /// Queries the nearest points of centre + radius * d for all directions d.
  void query(const Point& centre, double radius, std::span<const Point> directions, const BoundaryQueries& queries);

  std::size_t size() const { return points_.size(); }
  const Point& point(std::size_t i) const { return points_[i]; }
  const Point& nearest(std::size_t i) const { return nearest_[i]; }
  double greatest_distance() const { return greatest_distance_; }
  /// Equation 2.4, without two-sided fans, which only boundaries with edges have.
  double flux() const { return flux_; }

 private:
  std::vector<Point> points_, nearest_;
  double greatest_distance_ = 0, flux_ = 0;
};

}  // namespace medial_vk::any_boundary
