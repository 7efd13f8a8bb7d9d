#pragma once

#include <string>
#include <vector>

#include "medial_vk/result.h"

namespace medial_vk::cli {

/// `medial-vk fit`, with the arguments after that word; or `medial-vk spheres` with --primitives.
Status run_fit(const std::vector<std::string>& arguments);

}  // namespace medial_vk::cli
