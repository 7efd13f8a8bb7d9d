// Algorithm 4 (DECIDEMA) in the coordinates of a frame, and the bisection that follows it (Section 4.4).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/plane_thesis.h"
#include "plane/thesis/boundary_tree.h"

namespace medial_vk::plane {

/// Feet, and points of a circle, at most this far apart are one; cross products of a gradient and a difference of two
/// points below it have no sign (docs/theory.md).
inline constexpr double kSamePoint = 0x1p-44;

/// A point of Theta.
struct Sample {
  Vec2 at;
  Foot foot;
  std::uint32_t opposite = 0;
};

/// What Algorithm 4 finds at two points of Theta: a medial point lies on the segment between them.
struct Finding {
  DecisionReason reason = DecisionReason::kNone;
  std::uint32_t a = 0, b = 0;
};

/// Theta, counter-clockwise, each point once. `disc` lies inside the boundary.
std::vector<Sample> sample_circle(const BoundaryTree& tree, Vec2 centre, double radius, std::span<const double> angles);

/// The angles of so many samples at equal distances.
std::vector<double> equal_angles(unsigned samples);

/// All findings of lines 3 and 8; if there are none, those of line 13. None: 'Undetermined'.
std::vector<Finding> decide(std::span<const Sample> theta);

/// A point within `epsilon` of a medial point, and the nearest boundary points on either side of it.
struct Retraction {
  Vec2 at;
  Foot first, second;
};

/// Bisection between the two points of a finding.
Retraction retract(const BoundaryTree& tree, std::span<const Sample> theta, const Finding& finding, double epsilon);

}  // namespace medial_vk::plane
