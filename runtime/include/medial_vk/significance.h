// What share of the volume each sheet accounts for, and the order in which sheets are removed (Chapter 6).
// docs/theory.md, "Significance".
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/ball_union.h"

namespace medial_vk {

/// Of the radius of a ball: how far from its centre a sheet is one of those that it is of.
inline constexpr double kSeamReach = 0.7;

struct Significance {
  double volume = 0;            ///< Of the union of the balls.
  double area = 0;              ///< Of its surface.
  BettiNumbers topology;        ///< Of the union.
  std::vector<double> of_ball;  ///< lambda(b), equation 6.1; sums to 1.
  /// lambda(T), equation 6.2; sums to 1. A ball at a seam is of all sheets there: it counts for each by the
  /// weights of its points within kSeamReach of its radius, or two voxels, the nearer the more.
  std::vector<double> of_sheet;
  std::vector<double> areas;  ///< Per ball: of its sphere on the surface of the union.
};

/// The order in which sheets go.
struct SheetRemoval {
  std::vector<std::uint32_t> sheets;  ///< The first to go first.
  std::vector<double> volume_left;    ///< After each: share of the volume of the whole union.
  std::vector<std::uint32_t> kept;    ///< Those that stay, by decreasing significance.
};

enum class RemovalRule {
  kSignificance,  ///< The least significant goes first (Section 6.3).
  /// The least significant goes first of those without which the union has as many components, tunnels and cavities as
  /// the whole (Section 6.4.1).
  kTopology,
};

}  // namespace medial_vk
