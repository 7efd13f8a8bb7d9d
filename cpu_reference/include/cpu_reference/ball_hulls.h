// The distance of convex hulls of balls by its dual, without projections onto segments or triangles.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace medial_vk::reference {

struct HullBall {
  Eigen::Vector3d centre;
  double radius;
};

/// The minimum of |c(l) - c'(m)| - r(l) - r'(m) over the weights l and m of the balls of two hulls, as the maximum of
///   min over i, k of  n (c_i - c'_k) - r_i - r'_k
/// over all vectors n with |n| <= 1 (docs/theory.md, "Hulls of balls": the two are equal). Each vector gives a lower
/// bound of the minimum, so that no error of the search can make the result too great by more than rounding. The
/// maximum is at a vector that a set of at most four of these functions determines; all sets are tried, in extended
/// precision. At most three balls each; the hull of one ball of radius 0 is a point.
double hull_distance(const std::vector<HullBall>& first, const std::vector<HullBall>& second);

}  // namespace medial_vk::reference
