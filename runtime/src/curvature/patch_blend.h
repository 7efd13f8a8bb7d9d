// Patches of the boundary at some of the tips, and what they say at the others.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "curvature/tip_fit.h"

namespace medial_vk {

inline constexpr double kAnchorShare = 0.16;  ///< Of a window's radius: how far patches are apart.
inline constexpr double kBlendShare = 0.3;    ///< Within which they are blended.

/// The tips with patches: those of lower numbers first, and none nearer than `distance` to another one on its side.
/// Every tip has one within that distance.
inline std::vector<std::uint32_t> anchors_of(const TipCloud& cloud, const PointGrid& grid, double distance) {
  std::vector<std::uint8_t> is_free(cloud.tips.size(), 1);
  std::vector<std::uint32_t> out;
  out.reserve(cloud.tips.size());
  for (std::uint32_t i = 0; i < is_free.size(); ++i) {
    if (is_free[i] == 0) continue;
    out.push_back(i);
    grid.visit_within(cloud.tips[i], distance, [&](std::uint32_t other, double) {
      if (are_on_one_side(cloud.normals[i], cloud.normals[other])) is_free[other] = 0;
    });
  }
  return out;
}

/// From sums over patches to their mean, which is not known where their normals cancel.
inline TipFit mean_of(TipFit sum, double weights) {
  const double size = length(sum.normal);
  if (!(size > 0)) return {};
  sum.is_known = true;
  sum.normal = 1 / size * sum.normal;
  sum.form /= weights;
  sum.spread /= weights;
  return sum;
}

/// The mean of the patches on the same side within `reach`, each at its own place over the tip, with the weights
/// (1 - d^2 / reach^2)^2 for middles at the distances d. `grid` holds the tips of `middles`, which are by patch. Not
/// known where one of them is not: there the boundary bends too much within the window, or tips end, and the others
/// would be continued beyond what they were fitted to.
inline TipFit blend_patches(std::span<const TipPatch> patches, const TipCloud& middles, const PointGrid& grid,
                            const Point& tip, const Point& normal, double reach) {
  TipFit sum;
  double weights = 0, nearest = 2 * reach * reach;
  bool are_all_known = true;
  grid.visit_within(tip, reach, [&](std::uint32_t i, double squared) {
    if (!are_all_known || !are_on_one_side(middles.normals[i], normal)) return;
    are_all_known = patches[i].is_known;
    const double left = 1 - squared / (reach * reach), weight = left * left;
    if (!are_all_known || !(weight > 0)) return;
    patches[i].add_at(tip, weight, sum);
    weights += weight;
    if (squared >= nearest) return;
    nearest = squared;
    sum.is_cut = patches[i].is_cut;
  });
  return are_all_known ? mean_of(sum, weights) : TipFit{};
}

}  // namespace medial_vk
