// Overlapping discs of varying radii inside a shape (Section 4.4).
#pragma once

#include <vector>

#include "base/loop_watch.h"
#include "plane/thesis/boundary_tree.h"

namespace medial_vk::plane {

struct Disc {
  Vec2 centre;
  double radius = 0;
};

struct Cover {
  std::vector<Disc> discs;
  /// Every point of the inside that is farther than this from the boundary lies in the square of a disc.
  double missed_radius = 0;
};

/// A disc is this much larger than the circle around its square, so that each point of the square lies at least a third
/// of the radius deep in it.
inline constexpr double kOverlap = 1.5;
/// The boundary is at least this many radii from the centre of a disc: discs are small near it.
inline constexpr double kClearance = 2;

/// A disc for each of the squares of a quadtree over [-1/2, 1/2]^2 that is as large as `largest` and the boundary
/// allow, and not divided where a disc would be below `least` / 2.
Cover cover_inside(const SiteSet& sites, const BoundaryTree& tree, double largest, double least, unsigned threads,
                   const LoopWatch& watch);

}  // namespace medial_vk::plane
