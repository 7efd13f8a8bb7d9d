// The volume of a ball, and the area of its sphere, inside its power cell, in closed form.
#pragma once

#include "ball_unions/cells/power_cell.h"

namespace medial_vk {

struct BallInCell {
  double volume = 0;              ///< Of the ball in the cell.
  double area = 0;                ///< Of the sphere in the cell.
  Point area_vector = {0, 0, 0};  ///< The integral of the outward unit normals over that part, by area.
};

/// `radius` of the cell's ball.
BallInCell measure_ball_in_cell(const PowerCell& cell, double radius);

}  // namespace medial_vk
