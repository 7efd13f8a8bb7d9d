// Balls and their spokes from the arrays and the JSON that this program writes.
#pragma once

#include <string>
#include <string_view>

#include "ball_files/read_balls.h"

namespace medial_vk {

/// NumPy arrays `centre` and `radius`, with both `spoke_a` and `spoke_b` or neither: those of medial points and of
/// curvatures. Errors: kInvalidMesh, which names the file and the array; kOutOfMemory.
Result<BallsWithSpokes> balls_of_arrays(std::string_view bytes, const std::string& name);

/// A list `points` (medial points, with their spokes), `spheres` (fitted spheres; of several `levels`, the last) or
/// `balls` (curvatures), of objects with `centre` and `radius`, and all with both `spoke_a` and `spoke_b`, rounded to
/// floats, or none with either. `links`, of a robot, is refused. Errors: kInvalidMesh, which names the file and the
/// ball; kOutOfMemory.
Result<BallsWithSpokes> balls_of_json(std::string_view text, const std::string& name);

}  // namespace medial_vk
