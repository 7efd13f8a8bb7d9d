// The command line from options to exit code.
#pragma once

#include <string>
#include <vector>

namespace medial_vk::cli {

/// Parses, runs and prints; returns the exit code (0 or an exit code of the command line). Does not throw.
int run(const std::vector<std::string>& arguments);

}  // namespace medial_vk::cli
