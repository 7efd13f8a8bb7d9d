// Shapes in the plane by all of their segments: simple, slow, and shared with nothing. In double: up to rounding.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace medial_vk::reference {

/// Segments with the inside on their left, as pairs of ends.
using PlaneSegments = std::vector<std::array<Eigen::Vector2d, 2>>;

double distance_to_segment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// The distance of the nearest segment.
double distance_to_segments(const Eigen::Vector2d& p, const PlaneSegments& segments);

/// The winding number of the segments around a point that is on none of them is not 0.
bool is_inside(const Eigen::Vector2d& p, const PlaneSegments& segments);

struct PlaneBall {
  Eigen::Vector2d centre;
  double radius = 0;
  double object_angle = 0;  ///< Between the place where it was begun and the other one that it touches.
};

/// The greatest disc that touches segment `own` in `p`, between its ends, with its centre in the unit direction `n`
/// perpendicular to it, and no point of another segment inside. Nothing if there is no greatest one.
std::optional<PlaneBall> greatest_disc(const Eigen::Vector2d& p, const Eigen::Vector2d& n, std::size_t own,
                                       const PlaneSegments& segments);

}  // namespace medial_vk::reference
