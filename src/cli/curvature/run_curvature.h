// `medial-vk curvature`: the curvature of a boundary from medial balls.
#pragma once

#include <string>
#include <vector>

#include "medial_vk/result.h"

namespace medial_vk::cli {

/// Reads the balls, measures and writes. `arguments` without the program's name and without "curvature".
Status run_curvature(const std::vector<std::string>& arguments);

}  // namespace medial_vk::cli
