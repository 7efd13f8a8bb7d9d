// A step of every ball towards a greater volume of the union (docs/theory.md, "Balls that follow a surface").
#pragma once

#include "following/surface/moving_surface.h"
#include "following/tracked_ball.h"
#include "medial_vk/dynamic_union.h"

namespace medial_vk {

/// Moves the ball along its medial sheet, in the direction in which the union grows most to first order, by the ball's
/// step, and adapts the step. The ball stays where no greatest ball is found, where nothing of it is exposed, or where
/// the union would lose more than a little by the move, to first order.
void ascend(const MovingSurface& surface, const Exposure& exposure, TrackedBall& tracked);

}  // namespace medial_vk
