// The edges of a power cell, relative to the centre of its ball.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "ball_unions/cells/power_cell.h"
#include "base/point_ops.h"

namespace medial_vk {

/// An edge in units of the ball's radius, relative to its centre.
struct CellEdge {
  std::uint32_t corner, other;          ///< `corner` < `other`.
  std::array<std::uint32_t, 2> planes;  ///< Into PowerCell::planes().
  Point foot;                           ///< The point of the edge's line that is nearest to the centre.
  Point direction;                      ///< A unit vector, from `other` to `corner`, along normal 0 x normal 1.
  double from, to;                      ///< The edge is foot + t direction for t in [from, to].
  std::array<double, 2> height;         ///< Of the centre under each plane: plane . foot.
  std::array<double, 2> gap;            ///< In each plane, from the foot of the centre outwards to the edge.
  double half_chord_squared;            ///< Of the ball on the edge's line; below 0: the line misses the ball.

  /// The chord's ends on the edge; enter > leave is possible only if the line misses the ball.
  double enter(double half_chord) const { return std::clamp(-half_chord, from, to); }
  double leave(double half_chord) const { return std::clamp(half_chord, from, to); }
};

/// The direction of an edge. Its ends are inaccurate for an edge hardly longer than their rounding, and a direction
/// that is not in both planes can put the foot anywhere; normals are inaccurate if planes are nearly parallel. The
/// longer vector decides.
inline Point direction_of_edge(const Point& between_ends, const Point& between_normals) {
  const double ends = dot(between_ends, between_ends), normals = dot(between_normals, between_normals);
  if (ends >= normals) return ends > 0 ? (1 / std::sqrt(ends)) * between_ends : Point{};
  return (1 / std::sqrt(normals)) * between_normals;
}

/// Calls f(edge) for every edge, including those whose length is zero by rounding, since they locate their faces.
template <class Function>
void for_each_edge(const PowerCell& cell, double radius, const Function& f) {
  const double unit = 1 / radius;
  const auto& corners = cell.corners();
  for (std::uint32_t c = 0; c < corners.size(); ++c) {
    for (std::size_t slot = 0; slot < 3; ++slot) {
      CellEdge edge;
      edge.corner = c;
      edge.other = corners[c].neighbours[slot];
      if (edge.other < c) continue;
      const Point begin = unit * corners[edge.other].at, along = unit * corners[c].at - begin;
      edge.planes = {corners[c].planes[(slot + 1) % 3], corners[c].planes[(slot + 2) % 3]};
      const Point& p = cell.planes()[edge.planes[0]].normal;
      const Point& q = cell.planes()[edge.planes[1]].normal;
      edge.direction = direction_of_edge(along, cross(p, q));
      edge.from = dot(edge.direction, begin);
      edge.to = edge.from + std::max(0.0, dot(edge.direction, along));  // rounding may swap the ends
      edge.foot = begin - edge.from * edge.direction;
      // Both are relative to the same foot, so that they are consistent near an edge through the centre.
      edge.height = {dot(p, edge.foot), dot(q, edge.foot)};
      edge.gap = {dot(cross(edge.direction, p), edge.foot), dot(cross(q, edge.direction), edge.foot)};
      edge.half_chord_squared = 1 - dot(edge.foot, edge.foot);
      f(edge);
    }
  }
}

}  // namespace medial_vk
