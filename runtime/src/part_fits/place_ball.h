// Balls that are moved from the frame of a part to that of its link.
#pragma once

#include "medial_vk/ball.h"
#include "medial_vk/pose.h"

namespace medial_vk {

/// The ball in the other frame. `grow` adds the motion by rounding to the radius: -1 to stay inside, 1 to cover, 0 for
/// none.
Ball place_ball(const Pose& pose, const Ball& ball, int grow);

/// A bound of the distance of `pose * p` from its exact value by rounding, for points with coordinates of at most
/// `reach`. The exact motion has the rotation by the exact angles of make_pose(), or that nearest to the matrix.
double placement_rounding(const Pose& pose, double reach);

/// True for finite numbers and a matrix that is a rotation to a few digits of single precision.
bool is_rigid(const Pose& pose);

}  // namespace medial_vk
