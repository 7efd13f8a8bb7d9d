// Lemma M (docs/theory.md): linear conditions on a point with two spokes that cannot hold together in a box.
#pragma once

#include <span>

#include "dismissal/carriers.h"
#include "geometry/box.h"

namespace medial_vk::reference {

/// False: no point of the box has spokes to both carriers, at least 2 * angle apart, and is no nearer to the others.
/// `rounding`: of a distance.
bool can_hold_jointly(const Carrier& a, const Carrier& b, std::span<const Carrier> others, const Box& box, double angle,
                      double rounding);

}  // namespace medial_vk::reference
