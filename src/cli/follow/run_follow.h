// The command `medial-vk follow`.
#pragma once

#include <string>
#include <vector>

#include "medial_vk/result.h"

namespace medial_vk::cli {

/// `arguments` without the program's name and without "follow".
Status run_follow(const std::vector<std::string>& arguments);

}  // namespace medial_vk::cli
