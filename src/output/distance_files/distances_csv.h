// Distances as a table.
#pragma once

#include <span>
#include <string>

#include "medial_vk/proximity.h"

namespace medial_vk {

/// "free", "hit" or "undecided".
const char* name_of(Collision collision);

/// A line per distance, after a line of names: lower, upper, state, ax, ay, az, bx, by, bz (the points, in the frame of
/// a). Numbers read back as the same doubles; an infinite one is "inf", and what is no number "nan".
std::string encode_distances_csv(std::span<const Distance> distances);

}  // namespace medial_vk
