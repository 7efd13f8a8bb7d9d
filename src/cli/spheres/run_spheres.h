// `medial-vk spheres` from options to files.
#pragma once

#include <string>
#include <vector>

#include "medial_vk/result.h"

namespace medial_vk::cli {

/// `arguments` after "spheres". Errors have the exit codes of the command line.
Status run_spheres(const std::vector<std::string>& arguments);

}  // namespace medial_vk::cli
