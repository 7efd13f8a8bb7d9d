// The significance of balls and sheets, and the order in which sheets are removed (Chapter 6): results of analyse().
// docs/theory.md, "Significance".
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/ball_union.h"

namespace medial_vk {

/// The share of the volume that each ball and each sheet holds.
struct Significance {
  double volume = 0;      ///< Of the union of the balls.
  double area = 0;        ///< Of its envelope.
  BettiNumbers topology;  ///< Of the union.
  /// The shares of the components of the union, decreasing. Most of the many small ones are balls at edges of the solid
  /// that are smaller than a voxel, so that they reach no other ball.
  std::vector<double> of_component;
  std::vector<double> of_ball;  ///< lambda(b), equation 6.1; sums to 1.
  /// lambda(T), equation 6.2; sums to 1. A ball at a seam belongs to all sheets there: its share is divided among their
  /// points at a distance d below R, the larger of 0.7 times its radius and two voxels, in proportion to the
  /// areas of the points and to 1 - d / R.
  std::vector<double> of_sheet;
  std::vector<double> areas;  ///< Per ball: of the part of its sphere on the envelope.
};

/// The order in which sheets are removed.
struct SheetRemoval {
  std::vector<std::uint32_t> sheets;  ///< The first removed comes first.
  std::vector<double> volume_left;    ///< After each removal: share of the volume of the whole union.
  std::vector<std::uint32_t> kept;    ///< The remaining sheets, by decreasing significance.
};

}  // namespace medial_vk
