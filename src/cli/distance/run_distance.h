// `medial-vk distance`: distances of two solids, in one pose or in many.
#pragma once

#include <string>
#include <vector>

#include "medial_vk/result.h"

namespace medial_vk::cli {

/// Reads both meshes and the poses, computes and writes the distances. `arguments` without the program's name and
/// without "distance". A failed `--check` is kCheckFailed.
Status run_distance(const std::vector<std::string>& arguments);

}  // namespace medial_vk::cli
