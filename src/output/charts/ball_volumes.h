// What every single ball has of the union's volume.
#pragma once

#include <string>
#include <vector>

#include "medial_vk/extraction.h"
#include "sheets/significance.h"

namespace medial_vk {

/// One header line and one line per ball: `point,sheet,volume,area,significance` (--ball-volumes).
std::string encode_ball_volumes(const Significance& significance, const std::vector<MedialSphere>& spheres);

}  // namespace medial_vk
