// Mode thesis: Sections 2.3 and 2.4 as published, with the corrected sign of 2.4.2.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "any_boundary/certified_search.h"
#include "base/loop_watch.h"

namespace medial_vk::any_boundary {

/// Depths of cells, as in the source.
inline constexpr int kThesisDepths = 4;

/// `spirals`: by depth, the voxels' last, the directions of samples. Throws as search_certified() does.
SearchResult search_as_published(const SearchFrame& frame, const ThesisOptions& options,
                                 const std::array<std::vector<Point>, kThesisDepths>& spirals, unsigned threads,
                                 LoopWatch& watch);

}  // namespace medial_vk::any_boundary
