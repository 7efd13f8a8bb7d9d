// Widest paths on a graph of places between sites, from and to places beside it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "site_voronoi/line_clearance.h"

namespace medial_vk {

/// A way between two places that are numbered: those of the graph, then those beside it.
struct PlaceJoin {
  static constexpr std::uint32_t kStraight = 0xffffffffu;

  std::uint32_t from = 0, to = 0;
  double width = 0;  // no point of it is nearer to a site
  double length = 0;
  std::uint32_t curve = kStraight;  // what the caller knows of it
};

/// A place of a way, and the curve of the join that leads to it.
struct WayStep {
  std::uint32_t place = 0;
  std::uint32_t curve = PlaceJoin::kStraight;
};

struct WidestWay {
  std::vector<WayStep> steps;      // from the first end to the last
  std::vector<ClearPlace> beside;  // places that are none of the graph
  double width = 0;                // of its joins and both ends
};

/// Tests both ends of a path. Errors: kUsage, naming `from` or `to`.
Status check_ends(const SiteForest& forest, double rounding, const std::array<Point, 2>& ends);

/// Of the ways with the greatest width, the shortest; none: no straight lines from the ends to the graph or to each
/// other are found to be clear, or both ends are in different components. `rounding` bounds the error of distances
/// around the graph. Errors: those of check_ends().
Result<std::optional<WidestWay>> find_widest_way(const SiteForest& forest, double rounding,
                                                 const std::vector<ClearPlace>& places, std::vector<PlaceJoin> joins,
                                                 const std::array<Point, 2>& ends);

}  // namespace medial_vk
