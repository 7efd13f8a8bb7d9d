// Segments that are cut wherever they cross or touch, so that they meet in common points only.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <vector>

#include "base/loop_watch.h"
#include "plane/shapes/meetings.h"
#include "plane/sites/frame.h"

namespace medial_vk::plane {

/// A segment between two points, traversed `times` more often from the first to the second than back.
struct CountedEdge {
  std::array<std::uint32_t, 2> ends = {};
  std::int32_t times = 1;

  auto operator<=>(const CountedEdge&) const = default;  // NOLINT(modernize-use-nullptr): false alarm of clang-tidy 14
};

struct Arrangement {
  std::vector<Vec2> points;        ///< The given ones first.
  std::vector<CountedEdge> edges;  ///< Sorted; each pair of ends once, the lesser first; `times` may be 0.
  std::size_t merged_points = 0, crossings = 0, touching_points = 0;
};

/// Points at crossings are representable in `frame`. Throws std::bad_alloc and LoopStopped.
Arrangement arrange(std::vector<Vec2> points, const std::vector<CountedEdge>& edges, const Frame& frame,
                    unsigned threads, const LoopWatch& watch);

}  // namespace medial_vk::plane
