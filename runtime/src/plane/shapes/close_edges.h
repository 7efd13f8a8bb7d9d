// Pairs of segments, and of points without segments, that come close to each other.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "base/loop_watch.h"
#include "plane/sites/site_set.h"

namespace medial_vk::plane {

/// Pairs of segments and of points that are an end of none, by site, whose boxes are no farther apart than `gap`, and
/// of which neither lies beside the other's line by more: sorted. None if the boxes of so many segments overlap, as
/// those of long ones do that lie side by side in many directions, that another way is faster. Throws std::bad_alloc
/// and LoopStopped.
std::optional<std::vector<std::pair<std::uint32_t, std::uint32_t>>> close_edges(const SiteSet& sites, double gap,
                                                                                unsigned threads,
                                                                                const LoopWatch& watch);

}  // namespace medial_vk::plane
