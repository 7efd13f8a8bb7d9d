// The extent of the region "full foam of one site minus empty foam" (Section 3.4; docs/foam.md, "Width").
#pragma once

#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/mesh_view.h"

namespace medial_vk {

/// The region of one site A, relative to A: all points X with |X - v| <= |v| + slack for some v of `centres` and
/// |X - e| >= r for every ball (e, r) of `empty`.
struct FoamRegion {
  std::vector<Point> centres;
  std::vector<Ball> empty;
  double slack = 0;
};

/// An upper bound of the diameter of the region. The directions around A are divided until the bound is at most
/// `enough`, or the diameter is known to be above `too_much`, or the bound is within 5 % of the least one, or there are
/// too many parts.
double width_of_region(const FoamRegion& region, double enough, double too_much);

}  // namespace medial_vk
