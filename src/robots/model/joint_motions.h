// How the joints of a URDF move: kinds, axes, limits, and joints that mimic others.
#pragma once

#include <tinyxml2.h>

#include <string>
#include <vector>

#include "medial_vk/result.h"
#include "robots/model/robot.h"

namespace medial_vk {

/// Reads these of every <joint> of `root` into the `joints`, which are in the same order. Errors: as of read_urdf().
Status read_motions(const tinyxml2::XMLElement& root, const std::string& name, std::vector<Joint>& joints);

}  // namespace medial_vk
