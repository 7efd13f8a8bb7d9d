// The side of a point on a line, exactly.
#pragma once

#include <cmath>

#include "base/expansion.h"
#include "plane/sites/vec2.h"

namespace medial_vk::plane {

/// The sign of cross(b - a, c - a): 1 where c lies to the left of the line from a to b, 0 on it. Exact.
inline int orientation(Vec2 a, Vec2 b, Vec2 c) {
  const double left = (b.x - a.x) * (c.y - a.y), right = (b.y - a.y) * (c.x - a.x);
  // Three roundings in each product, and that of the difference, in units of 2^-53; a fifth covers their products.
  const double bound = 5 * 0x1p-53 * (std::fabs(left) + std::fabs(right));
  if (left - right > bound) return 1;
  if (left - right < -bound) return -1;
  ExpansionArena arena;
  ExpansionMath math(arena);
  const Expansion first = math.product(math.difference(b.x, a.x), math.difference(c.y, a.y));
  const Expansion second = math.product(math.difference(b.y, a.y), math.difference(c.x, a.x));
  return sign(math.difference(first, second));
}

/// By x, then by y.
constexpr bool precedes(Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

}  // namespace medial_vk::plane
