#pragma once

#include "site_voronoi/site_forest.h"

namespace medial_vk {

/// A place, and a lower bound of its distance to the nearest site.
struct ClearPlace {
  Point at = {0, 0, 0};
  double clearance = 0;
};

/// A lower bound of the distance to the nearest site along the straight line between two places, at most a hundredth
/// below the least distance found on it unless it is much below those of both ends; 0 if no positive one is proved.
double clearance_of_line(const SiteForest& forest, double rounding, const ClearPlace& from, const ClearPlace& to);

}  // namespace medial_vk
