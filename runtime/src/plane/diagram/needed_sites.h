// The sites that a diagram of one side of a boundary needs: corners at which that side is convex are left out.
#pragma once

#include <cstdint>
#include <vector>

#include "plane/diagram/diagram_query.h"

namespace medial_vk::plane {

/// No point of the wanted side is nearest to a corner that is convex there. Such a corner is left out, and one of its
/// segments stands for it, so that the least distance from the sites that are left is that from all sites.
struct NeededSites {
  NeededSites(const SiteSet& sites, Wanted wanted);

  std::vector<std::uint32_t> list;  ///< Ascending: points first.
  /// By segment, in the order of the set: 1 if it stands for its begin, 2 for its end, 3 for both.
  std::vector<std::uint8_t> stands_for;
};

}  // namespace medial_vk::plane
