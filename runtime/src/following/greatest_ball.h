// The greatest ball that touches a surface at a given point and does not meet it elsewhere.
#pragma once

#include "following/surface/moving_surface.h"
#include "following/tracked_ball.h"

namespace medial_vk {

/// Balls end this share of the longest side before the surface, so that a contact that is known up to rounding is found
/// to be that contact, and one query suffices. It costs as small a share of a ball's radius.
inline constexpr double kContactSlack = 1e-10;
/// With rounding, as a distance.
double contact_slack(const MovingSurface& surface);

/// The least radius of a ball, as a share of the longest side: a smaller one has the radius 0. At a distance of s times
/// its size, a solid angle has an error of some 2^-50 / s, so that the sum of those of a hundred thousand triangles is
/// certain beside an integer.
inline constexpr double kLeastRadius = 0x1p-30;

/// The radius of the ball that touches `at` with the centre along the unit vector `towards_centre`, and passes through
/// `other`: |w - R u| = R. Infinite, if `other` lies on the other side of the plane across that vector.
double radius_through(const Point& at, const Point& towards_centre, const Point& other);

/// Shrinks the ball that touches the surface at `contact` until no point of the surface is in it: from the radius of
/// the ball through `other`, a point of the surface, if that is known, else from half the longest side (the shrinking
/// ball of J. Ma, S. W. Bae, S. Choi, 2012). The open ball of the result does not meet the surface, whatever the
/// contacts are worth: its radius is at most the distance of its centre, less all rounding. Radius 0: nothing is left.
/// The second contact is the point that ended the shrinking, or `other`.
TrackedBall greatest_ball(const MovingSurface& surface, const BallContact& contact, const SurfacePoint& other);

/// The same with a radius of at most `most`, whatever `other` permits.
TrackedBall greatest_ball_up_to(const MovingSurface& surface, const BallContact& contact, const SurfacePoint& other,
                                double most);

}  // namespace medial_vk
