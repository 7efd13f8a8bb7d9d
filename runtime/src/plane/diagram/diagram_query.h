// Which part of a Voronoi diagram is wanted.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "plane/sites/bisector.h"

namespace medial_vk::plane {

/// Points at equal distance from two contacts are wanted if the contacts lie on these sides, and all on the same side;
/// or, between sites of different owners, wherever they lie.
enum class Wanted : std::uint8_t { kLeft, kRight, kBothSides, kBetweenOwners };

/// Lengths are in the coordinates of the sites, which the library keeps within [-1/2, 1/2].
struct DiagramQuery {
  Wanted wanted = Wanted::kLeft;
  /// Points are salient with an object angle of at least `object_angle`, or with `deep_angle` and at least `radius`.
  /// In radians, none below kLeastAngle.
  double object_angle = 0.6, deep_angle = 0.15;
  double radius = std::numeric_limits<double>::infinity();
  Vec2 centre;        ///< Of the square that is searched.
  double half = 0.5;  ///< Of its side.
  double slack = 0;   ///< Sites by so much farther than the nearest one count as nearest.
  unsigned threads = 0;
  /// Cells below one of the first few hundred, beyond 32 for each of its sites; others are not divided further.
  std::size_t cells_of_branch = std::size_t{1} << 16;

  /// The object angle that a point needs if its radius may be this.
  double least_angle(double at_radius) const {
    return at_radius >= radius ? std::min(object_angle, deep_angle) : object_angle;
  }
};

/// Angles below are rounding.
inline constexpr double kLeastAngle = 0x1p-13;

/// Of a distance r that was computed from coordinates within [-1/2, 1/2]: roundings of the coordinates of a centre, and
/// of the few operations from there. Sites whose distances differ by less are taken to be equally far.
constexpr double tie(double r) { return 0x1p-43 * r + 0x1p-50; }

/// Of nodes and arcs: the distance from the exact ones (docs/theory.md, "In the plane").
inline constexpr double kEpsilon = 0x1p-36;

inline bool allows(Wanted wanted, Side side) {
  return wanted == Wanted::kBothSides || wanted == Wanted::kBetweenOwners ||
         (wanted == Wanted::kLeft) == (side == Side::kLeft);
}

}  // namespace medial_vk::plane
