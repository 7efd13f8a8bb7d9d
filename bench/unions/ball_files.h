// Balls from the CSV files that medial-vk writes.
#pragma once

#include <string>
#include <vector>

#include "medial_vk/ball.h"

namespace medial_vk::bench {

/// The columns x, y, z, radius, which come first. Ends the program with a message if there are none.
std::vector<Ball> read_balls(const std::string& file);

}  // namespace medial_vk::bench
