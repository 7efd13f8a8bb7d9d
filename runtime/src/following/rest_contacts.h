// The contacts by which a ball follows the surface, found where it is given.
#pragma once

#include "following/surface/moving_surface.h"
#include "following/tracked_ball.h"

namespace medial_vk {

/// The greatest ball that touches the surface where `ball`, which lies inside, does. Of more than two contacts it keeps
/// two that are far from each other, so that the ball of a tube's axis is held from both sides; which ones depends on
/// the mesh alone, not on its position. Throws std::bad_alloc.
TrackedBall ball_with_contacts(const MovingSurface& surface, const Ball& ball);

}  // namespace medial_vk
