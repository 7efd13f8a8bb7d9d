// Volumes of the balls of a union as a table.
#pragma once

#include <string>
#include <vector>

#include "medial_vk/medial_spheres.h"
#include "medial_vk/sheets.h"
#include "medial_vk/significance.h"

namespace medial_vk {

/// Columns `point,sheet,volume,area,significance`, one row per sphere.
std::string encode_ball_volumes(const Significance& significance, const std::vector<MedialSphere>& spheres);

}  // namespace medial_vk
