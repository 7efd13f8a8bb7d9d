#include "any_boundary/sphere_samples.h"

#include <algorithm>

#include "base/point_ops.h"

namespace medial_vk::any_boundary {

void SphereSamples::query(const Point& centre, double radius, std::span<const Point> directions,
                          const BoundaryQueries& queries) {
  points_.clear();
  points_.reserve(directions.size());
  for (const Point& direction : directions) points_.push_back(centre + radius * direction);
  nearest_.resize(points_.size());
  queries.nearest(points_, nearest_);
  greatest_distance_ = flux_ = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Point spoke = nearest_[i] - points_[i];
    const double distance = length(spoke);
    greatest_distance_ = std::max(greatest_distance_, distance);
    if (distance > 0) flux_ += dot(spoke, directions[i]) / distance / static_cast<double>(points_.size());
  }
}

}  // namespace medial_vk::any_boundary
