// Carriers that leave one vertex: the configuration is the same in a box of any smaller size, so only directions can
// decide whether both may hold a foot of one medial point (docs/theory.md, Lemma J).
#pragma once

#include "dismissal/carriers.h"

namespace medial_vk::reference {

/// False if no point has feet on both, with spokes that differ by 2 * angle or more. True if they have no vertex in
/// common, or one of them is a vertex or a triangle without a known normal.
bool can_meet_at_corner(const Carrier& a, const Carrier& b, double angle);

}  // namespace medial_vk::reference
