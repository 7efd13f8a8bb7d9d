// What all readers of balls ask of a ball, and of its spokes.
#pragma once

#include <string>

#include "ball_files/read_balls.h"

namespace medial_vk {

/// A spoke that was read from text, as the program writes it to all formats, in floats: results then do not depend on
/// the format of the file. What cannot be part of a unit vector remains, for fault_of_ball().
Point as_written(Point spoke);

/// Why a ball cannot be used; empty if it can. `spokes`: null if it has none.
std::string fault_of_ball(const Ball& ball, const SpokePair* spokes);

/// Error: kInvalidMesh, which names the file and the first ball that has a fault.
Status check_all(const BallsWithSpokes& read, const std::string& name);

/// Error: kUsage. What reads balls takes them for those of a solid, which points outside of it are not (--side).
Error outside_error(const std::string& name);

}  // namespace medial_vk
