#include "balls/ball_in_cell.h"

#include <algorithm>
#include <cmath>

#include "balls/cell_edge.h"

namespace medial_vk {
namespace {

/// One edge of one face, in a ball of radius 1. The triangle between the foot of the centre on the face's plane and the
/// edge is the base of a pyramid with its apex at the centre; what the ball has of it is measured. Odd in `height` and
/// in `gap`: the sum over the edges of all faces is that of the polyhedron, wherever the centre is.
struct Pyramid {
  double height, gap, foot_squared;
  BallInCell sum;

  double rho(double t) const { return std::sqrt(foot_squared + t * t); }

  /// The part of the edge within the ball: a pyramid, whole.
  void add_inside(double a, double b) { sum.volume += height * gap * (b - a) / 6; }

  /// The part [a, b] of the edge outside the ball, at distances rho_a and rho_b. In polar coordinates (s, phi) around
  /// the foot, the base reaches from the ball's disk, s^2 = 1 - height^2, to gap / cos phi. Per phi, the disk has half
  /// its squared radius, and the solid angle from 0 to s is 1 - height / sqrt(height^2 + s^2); over the edge the latter
  /// integrates to an arc sine in phi, here an arc tangent that stays accurate near a right angle.
  void add_outside(double a, double b, double rho_a, double rho_b) {
    const double phi = std::atan2(gap * (b - a), gap * gap + a * b);
    const double psi =
        std::atan2(height * gap * (b * rho_a - a * rho_b), gap * gap * rho_a * rho_b + height * height * a * b);
    const double low = std::clamp(height, -1.0, 1.0);  // a plane that misses the ball has no disk
    const double solid_angle = low * phi - psi;
    sum.area += solid_angle;
    sum.volume += (0.5 * low * (1 - low * low) * phi + solid_angle) / 3;
  }
};

BallInCell measure_pyramid(const CellEdge& edge, std::size_t side) {
  Pyramid pyramid{edge.height[side], edge.gap[side], dot(edge.foot, edge.foot), {}};
  if (!(edge.half_chord_squared > 0)) {
    pyramid.add_outside(edge.from, edge.to, pyramid.rho(edge.from), pyramid.rho(edge.to));
    return pyramid.sum;
  }
  const double half = std::sqrt(edge.half_chord_squared);
  const double enter = edge.enter(half), leave = edge.leave(half);
  pyramid.add_inside(enter, leave);
  if (enter > edge.from) {
    pyramid.add_outside(edge.from, enter, pyramid.rho(edge.from), std::max(1.0, pyramid.rho(enter)));
  }
  if (leave < edge.to) {
    pyramid.add_outside(leave, edge.to, std::max(1.0, pyramid.rho(leave)), pyramid.rho(edge.to));
  }
  return pyramid.sum;
}

}  // namespace

BallInCell measure_ball_in_cell(const PowerCell& cell, double radius) {
  BallInCell sum;
  for_each_edge(cell, radius, [&](const CellEdge& edge) {
    for (std::size_t side = 0; side < 2; ++side) {
      const BallInCell part = measure_pyramid(edge, side);
      sum.volume += part.volume;
      sum.area += part.area;
    }
  });
  // Each is a sum of terms of both signs: what rounding leaves of nothing may be below 0.
  sum.volume = std::max(0.0, sum.volume) * radius * radius * radius;
  sum.area = std::max(0.0, sum.area) * radius * radius;
  return sum;
}

}  // namespace medial_vk
