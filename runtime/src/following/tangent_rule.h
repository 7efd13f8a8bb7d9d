// The default rule: a ball follows both of its contacts (docs/theory.md, "Balls that follow a surface").
#pragma once

#include "following/surface/moving_surface.h"
#include "following/tracked_ball.h"

namespace medial_vk {

/// The ball in the present frame, from that in the last one. One contact stays, with the direction that its triangle
/// carries, and the ball is the greatest that touches there; the other contact bounds its radius. Where that ball is
/// not medial or has shrunk, the ball that lies between the images of both contacts is tried too, and the greater one
/// is the result.
TrackedBall follow_tangent(const MovingSurface& surface, const TrackedBall& last);

/// Of a ball with two contacts in the rest pose, by the images of these contacts: 1 where they have moved as a rigid
/// body, 0 where the radius through both, or the cosine between their directions, has changed by kNoLongerRest or more.
double share_of_rest(const MovingSurface& surface, const TrackedBall& rest);

/// The ball in the present frame that is the image of that in the rest pose, moved towards `followed` as
/// share_of_rest() is below 1; `followed` if it is 0. So balls return to their places as the surface returns to its
/// shape.
TrackedBall drawn_to_rest(const MovingSurface& surface, const TrackedBall& rest, double share,
                          const TrackedBall& followed);

/// For a ball that is lost in this frame: the greatest ball at one of its contacts, straight behind that triangle, if
/// one is inside; else `lost`.
TrackedBall recovered_ball(const MovingSurface& surface, const TrackedBall& lost);

/// The greatest ball around a point off the surface that touches it at the point nearest to `guess`; radius 0: `guess`
/// is outside, as far as the normal of the nearest triangle tells. `a` and `b`: the contacts of a ball nearby, if
/// known; the one farther from that nearest point is the `other` of greatest_ball().
TrackedBall greatest_ball_at(const MovingSurface& surface, const Point& guess, const SurfacePoint& a,
                             const SurfacePoint& b);

}  // namespace medial_vk
