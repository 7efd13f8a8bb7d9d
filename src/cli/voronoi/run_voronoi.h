#pragma once

#include <string>
#include <vector>

#include "medial_vk/result.h"

namespace medial_vk::cli {

/// `medial-vk voronoi`, with the arguments after that word.
Status run_voronoi(const std::vector<std::string>& arguments);

}  // namespace medial_vk::cli
