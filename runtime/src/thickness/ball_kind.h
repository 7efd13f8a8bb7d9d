// What limits a ball: facets, a crease, a corner or a wall, by the normals where it may touch (docs/theory.md,
// "Thickness").
#pragma once

#include <array>
#include <span>

#include "medial_vk/ball.h"
#include "medial_vk/thickness.h"

namespace medial_vk {

/// A point of the boundary, and the unit vector there that is normal to the boundary and points away from the ball.
struct BallContact {
  Point at = {0, 0, 0};
  Point normal = {0, 0, 0};
};

struct BallKind {
  double object_angle = 0;
  std::array<BallContact, 2> widest = {};  ///< The contacts with the greatest angle between their normals.
  ThicknessKind kind = ThicknessKind::kFacets;
};

/// Of a ball that was found, by its contacts.
BallKind kind_of_ball(std::span<const BallContact> contacts, double wall_angle, double crease_angle);

}  // namespace medial_vk
