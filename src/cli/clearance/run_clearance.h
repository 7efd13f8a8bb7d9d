// `medial-vk clearance`: the least distance among the links of a robot and its surroundings, in many configurations.
#pragma once

#include <string>
#include <vector>

#include "medial_vk/result.h"

namespace medial_vk::cli {

/// Reads robot, scene and joints, computes and writes the distances. `arguments` without the program's name and without
/// "clearance". A failed `--check` is kCheckFailed.
Status run_clearance(const std::vector<std::string>& arguments);

}  // namespace medial_vk::cli
