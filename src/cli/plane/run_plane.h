// `medial-vk plane`: the medial axis of a shape in the plane.
#pragma once

#include <string>
#include <vector>

#include "medial_vk/result.h"

namespace medial_vk::cli {

/// Reads the shape, finds its axis and writes. `arguments` without the program's name and without "plane".
Status run_plane(const std::vector<std::string>& arguments);

}  // namespace medial_vk::cli
