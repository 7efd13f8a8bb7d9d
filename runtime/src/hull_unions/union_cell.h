// What hulls of balls cover of a cubic cell, between bounds.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ball_hulls/axis_point.h"
#include "base/point_ops.h"

namespace medial_vk {

/// The hulls of a union, ready for distances.
struct UnionHulls {
  std::vector<AxisQuery> queries;
  /// A bound of the error of a signed distance in the cube around the union, and of a cell's centre.
  double rounding = 0;
};

/// A hull that may meet a cell, with its signed distance from the cell's centre.
struct HullAtCell {
  std::uint32_t hull = 0;
  AxisPoint nearest;
};

/// Bounds of the volume that hulls cover, for a cell [-1, 1]^3 of volume 8.
struct CoveredCell {
  double lower = 0, upper = 0;
};

/// Bounds for the cell with that centre and half side. `may_meet` names all hulls that may meet it; `meets` becomes
/// those of them that do or may, the nearest first if they are few, unless the bounds are equal.
CoveredCell cover_cell(const UnionHulls& hulls, const Point& centre, double half_side,
                       std::span<const std::uint32_t> may_meet, std::vector<HullAtCell>& meets);

}  // namespace medial_vk
