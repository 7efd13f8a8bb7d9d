// Mode certified: an octree whose cells are dismissed with proof, or searched.
#pragma once

#include <cstdint>
#include <vector>

#include "any_boundary/cell_search.h"
#include "base/loop_watch.h"

namespace medial_vk::any_boundary {

struct SearchResult {
  std::vector<FoundBall> found;           ///< In the order of voxel codes, at most one of each.
  std::vector<UndecidedVoxel> undecided;  ///< In the order of voxel codes.
  ExtractionCounters counters;
};

/// Throws std::bad_alloc, LoopStopped, BadAnswer, and whatever the boundary's functions throw.
SearchResult search_certified(const SearchFrame& frame, unsigned threads, LoopWatch& watch);

}  // namespace medial_vk::any_boundary
