// Which balls of a hull have a part of its surface, and how these parts meet.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "ball_hulls/axis_parts.h"
#include "medial_vk/ball_hull.h"

namespace medial_vk {

/// How the surface of a hull is composed.
enum class HullForm : std::uint8_t {
  kBall,   // one sphere
  kCone,   // two caps and a cone or cylinder between them
  kChain,  // two cones that do not meet, at one middle ball: no flat triangle
  kSlab,   // two flat triangles, three cones and a part of each sphere
};

/// A hull by the balls that have a part of its surface.
struct HullShape {
  HullForm form = HullForm::kBall;
  std::size_t count = 1;
  std::array<Ball, 3> balls = {};  // the middle one of a chain is the second
  AxisFace face;                   // of a slab: indices are of `balls`

  BallHull hull() const { return {balls, static_cast<std::uint32_t>(count)}; }
};

/// Balls that reach out of the hull of the others by less than rounding are left out.
HullShape shape_of(const BallHull& hull);

}  // namespace medial_vk
