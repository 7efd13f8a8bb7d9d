// How far the region "full foam of one site minus empty foam" reaches (Section 3.4; docs/foam.md, "Width").
#pragma once

#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/mesh_view.h"

namespace medial_vk {

/// The region of one site A, seen from A: all points X with |X - v| <= |v| + slack for some v of `centres` and
/// |X - e| >= r for every ball (e, r) of `empty`.
struct FoamRegion {
  std::vector<Point> centres;
  std::vector<Ball> empty;
  double slack = 0;
};

/// No two points of the region are further apart. Found by dividing the directions around A until the bound is at most
/// `enough`, or is known to be above `too_much`, or is within 5 % of the least one, or the parts get too many.
double width_of_region(const FoamRegion& region, double enough, double too_much);

}  // namespace medial_vk
