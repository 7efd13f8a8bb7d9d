// Where other solids are likely to come near a solid: docs/theory.md, "Sets for distances".
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "base/point_ops.h"
#include "solid/solid.h"

namespace medial_vk {

/// A point outside a solid, and the point of the boundary closest to it.
struct Probe {
  Point at = {0, 0, 0};         ///< On the boundary.
  Point direction = {0, 0, 0};  ///< A unit vector from there, to
  double distance = 0;          ///< the point outside, at this positive distance.

  Point outside() const { return at + distance * direction; }
};

/// `count` probes, or fewer where a solid is as small as the rounding of its coordinates. Their closest points are
/// those of points evenly spread around the solid, up to its longest side away from it; the points outside are moved
/// towards these, so that all shares of the distance are equally frequent. The result does not depend on the number of
/// threads (0: one per core). `check` is called often, from any of them, and may throw.
std::vector<Probe> probes_around(const Solid& solid, std::size_t count, unsigned threads,
                                 const std::function<void()>& check = {});

}  // namespace medial_vk
