// Where segments and points in the plane meet.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "base/loop_watch.h"
#include "plane/sites/site_set.h"

namespace medial_vk::plane {

/// Two points this close are one, and a point this close to a segment lies on it. Of coordinates within [-1/2, 1/2].
inline constexpr double kSnap = 0x1p-44;

/// What two sites have in common: two segments that cross in an end of neither, a point on a segment of which it is no
/// end, or two points in one place.
struct Meeting {
  std::uint32_t first, second;                       // sites
  auto operator<=>(const Meeting&) const = default;  // NOLINT(modernize-use-nullptr): false alarm of clang-tidy 14
};

/// All of them, sorted, each once. Throws std::bad_alloc and LoopStopped.
std::vector<Meeting> find_meetings(const SiteSet& sites, unsigned threads, const LoopWatch& watch);

}  // namespace medial_vk::plane
