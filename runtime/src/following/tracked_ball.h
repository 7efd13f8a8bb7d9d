// A ball that follows the surface, with its two contacts.
#pragma once

#include <cmath>

#include "base/point_ops.h"
#include "following/surface/surface_point.h"
#include "medial_vk/ball.h"

namespace medial_vk {

struct BallContact {
  SurfacePoint on;
  Point towards_centre = {0, 0, 0};  ///< A unit vector.
};

struct TrackedBall {
  Ball ball;  ///< Of radius 0: lost in this frame. Its contacts move on, and it may return.
  BallContact a, b;
  double rest_radius = 0;

  // Of the ascent: the share of the radius by which the next step moves the centre, and the direction of the last one.
  double step = 0.05;
  Point last_direction = {0, 0, 0};

  bool has_two_contacts() const { return a.on.is_known() && b.on.is_known(); }
  /// Half the angle between the spokes (Kahan's formula, accurate for all angles); 0 without two contacts.
  double object_angle() const {
    if (!has_two_contacts()) return 0;
    return std::atan2(length(a.towards_centre - b.towards_centre), length(a.towards_centre + b.towards_centre));
  }
};

}  // namespace medial_vk
