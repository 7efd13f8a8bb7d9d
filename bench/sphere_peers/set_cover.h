// Balls chosen greedily by the samples of the boundary that they cover when dilated, as Coverage Axis++ does (Z. Wang,
// Z. Dou, R. Xu, C. Lin, Y. Liu, X. Long, S. Xin, T. Komura, X. Yuan, W. Wang, "Coverage Axis++: Efficient Inner Point
// Selection for 3D Shape Skeletonization", 2024), written anew from the paper's description.
//
// Choices that the paper leaves open, or that differ from its experiments:
// - Candidates are the Voronoi vertices inside the solid of points of the boundary, 10,000 or, if these are more,
//   40 for each ball, instead of those of the vertices of the mesh, so that large triangles have candidates, too.
// - The radius of a candidate is its distance to the boundary, not to the nearest of these points: balls then lie
//   inside. (With that of the points they reach out by less than the points are apart, and cover a little more.)
// - The samples to be covered are 1,500, as in the published settings, or, if these are more, 20 for each ball: the
//   paper seeks some tens of balls.
// - The offset is 2 % of the longest side of the box, or fitted: the least, within 3 %, with which the greedy choice of
//   no more than the given number of balls covers all samples.
// - Both scores, the number of uncovered samples that a candidate covers and its distance from the nearest chosen one,
//   are standardised over all candidates that are left (mean 0, variance 1; 0 where all are equal) and added with equal
//   weights. The term for centrality, which later versions of the paper add, is left out.
// - The choice goes on until the number of balls is reached, also if all samples are covered before: then the distance
//   from chosen ones alone decides.
#pragma once

#include <cstddef>
#include <vector>

#include "medial_vk/ball.h"
#include "solid/solid.h"

namespace medial_vk::bench {

struct SetCoverOptions {
  std::size_t count = 0;
  double offset = 0.02;        ///< As a share of the longest side of the box.
  bool fits_offset = false;    ///< Then `offset` is where the search for it begins.
  std::size_t candidates = 0;  ///< Points of the boundary whose Voronoi vertices are candidates; 0: as above.
  std::size_t samples = 0;     ///< To be covered; 0: as above.
  double uniformity = 1;       ///< Weight of the distance from chosen candidates.
  unsigned threads = 0;
};

/// Balls inside the solid, without the offset: at most `count`, fewer only if there are not so many candidates.
std::vector<Ball> greedy_set_cover(const Solid& solid, const SetCoverOptions& options);

}  // namespace medial_vk::bench
