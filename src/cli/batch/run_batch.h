// Runs `medial-vk batch`: the main command on many meshes, in one process.
#pragma once

#include <string>
#include <vector>

#include "medial_vk/result.h"

namespace medial_vk::cli {

/// `arguments`: without the program's name and without "batch". Errors: with the codes that become exit codes;
/// kSomeFailed if all else went well but some meshes have no results.
Status run_batch(const std::vector<std::string>& arguments);

}  // namespace medial_vk::cli
