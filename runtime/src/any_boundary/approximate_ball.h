// Points with two contacts at nearly equal distances, and how far from the medial axis they can be.
#pragma once

#include <optional>

#include "any_boundary/boundary_queries.h"
#include "any_boundary/cell_grid.h"
#include "medial_vk/medial_spheres.h"

namespace medial_vk::any_boundary {

/// Thresholds of salience, in the units of the points.
struct Salience {
  double object_angle = 0, deep_angle = 0, radius = 0;  ///< radius 0: object_angle decides alone.

  /// The least object angle of a medial point whose radius is at most `radius_bound`.
  double least_angle(double radius_bound) const {
    return radius > 0 && radius_bound >= radius ? deep_angle : object_angle;
  }
};

/// A point with its nearest boundary point, and two other boundary points.
struct Contacts {
  Point at = {0, 0, 0};
  Point nearest = {0, 0, 0}, a = {0, 0, 0}, b = {0, 0, 0};
};

/// Half the angle between the directions to a and b.
double object_angle(const Contacts& contacts);

/// A length within which a point of the closure of the medial axis lies, on the same side of the boundary; infinity if
/// none is proved. All boundary points are known to within `error`.
double axis_distance(const Contacts& contacts, double error);

struct ApproximateBall {
  MedialSphere sphere;
  double axis_distance = 0;
};

/// The ball at a point, without its flux, unless it is not salient or its axis_distance() exceeds `most`.
std::optional<ApproximateBall> ball_at(const Contacts& contacts, std::uint64_t voxel, const Salience& salience,
                                       double error, double most);

}  // namespace medial_vk::any_boundary
