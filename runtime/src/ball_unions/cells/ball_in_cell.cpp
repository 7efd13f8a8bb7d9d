#include "ball_unions/cells/ball_in_cell.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "ball_unions/cells/cell_edge.h"

namespace medial_vk {
namespace {

/// The contribution of an edge, in a ball of radius 1: to the volume, to the sphere's area, and to that of its face in
/// the ball.
struct Part {
  double volume = 0, area = 0, face = 0;
};

/// One edge of one face, in a ball of radius 1. The triangle between the foot of the centre on the face's plane and the
/// edge is the base of a pyramid with its apex at the centre; the part of it in the ball is measured. Odd in `height`
/// and in `gap`: the sum over the edges of all faces is that of the polyhedron, for any position of the centre.
struct Pyramid {
  double height, gap, foot_squared;
  Part sum;

  double rho(double t) const { return std::sqrt(foot_squared + t * t); }

  /// The part of the edge within the ball: a whole pyramid.
  void add_inside(double a, double b) {
    sum.volume += height * gap * (b - a) / 6;
    sum.face += gap * (b - a) / 2;
  }

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
    const double disk = 0.5 * (1 - low * low) * phi;
    sum.volume += (low * disk + solid_angle) / 3;
    sum.face += disk;
  }
};

Part measure_pyramid(const CellEdge& edge, std::size_t side) {
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

// Where more than three planes meet in a point, or nearly, rounding leaves edges whose direction is arbitrary, so that
// they could subtend any angle at the foot of the centre. For edges this short, terms of the square of their length are
// below a rounding, so the integrands are evaluated at their middles.
constexpr double kShortEdge = 0x1p-26;

Part measure_short_edge(const PowerCell& cell, const CellEdge& edge, std::size_t side) {
  const Point& normal = cell.planes()[edge.planes[side]].normal;
  const double size = edge.to - edge.from;
  const Point middle = edge.foot + (0.5 * (edge.from + edge.to)) * edge.direction;
  const double sense = side == 0 ? size : -size;
  // Twice the area of the triangle between the edge and the foot of the centre on the face's plane, with its sign.
  const double moment = sense * dot(cross(edge.direction, normal), middle);
  const double height = dot(normal, middle), squared = dot(middle, middle);
  if (squared <= 1) return {height * moment / 6, 0, moment / 2};
  const double h = std::fabs(height), rho = std::sqrt(squared), from_foot = std::max(squared - h * h, DBL_MIN);
  const double disk = std::max(0.0, 1 - h * h) / from_foot;  // at most 1
  // h (1 - 1 / rho) / (rho^2 - h^2), but 1 - h / rho where there is no disk
  const double angle = h < 1 ? h * (rho - 1) / (rho * from_foot) : 1 / (rho * (rho + h));
  const double solid_angle = std::copysign(moment, height * moment) * std::min(angle, 0.5);
  const double face = 0.5 * moment * std::min(disk, 1.0);
  return {(height * face + solid_angle) / 3, solid_angle, face};
}

}  // namespace

BallInCell measure_ball_in_cell(const PowerCell& cell, double radius) {
  BallInCell sum;
  for_each_edge(cell, radius, [&](const CellEdge& edge) {
    for (std::size_t side = 0; side < 2; ++side) {
      const bool is_short = edge.to - edge.from < kShortEdge;
      const Part part = is_short ? measure_short_edge(cell, edge, side) : measure_pyramid(edge, side);
      sum.volume += part.volume;
      sum.area += part.area;
      // The sphere's part and the faces form a closed surface: their normals, weighted by area, sum to zero.
      sum.area_vector = sum.area_vector - part.face * cell.planes()[edge.planes[side]].normal;
    }
  });
  // Each is a sum of terms of both signs: a zero may become negative by rounding.
  sum.volume = std::max(0.0, sum.volume) * radius * radius * radius;
  sum.area = std::max(0.0, sum.area) * radius * radius;
  sum.area_vector = (radius * radius) * sum.area_vector;
  return sum;
}

}  // namespace medial_vk
