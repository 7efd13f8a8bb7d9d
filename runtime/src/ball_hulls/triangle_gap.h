// How near a hull of balls comes to a triangle: a closed form.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "ball_hulls/axis_point.h"
#include "base/point_ops.h"
#include "bvh/triangle_distance.h"
#include "medial_vk/ball_hull.h"

namespace medial_vk {

/// The least |p - c(l)| - r(l) over the points p of a triangle and the balls of a hull. It is a convex problem over the
/// product of both, and has its minimum where a corner is nearest to a ball inside of the axis, the triangle to one of
/// the balls at the corners of the axis, two edges to each other, or where axis and triangle meet; on faces that are
/// parallel it is also at one of these.
class TriangleGap {
 public:
  explicit TriangleGap(const AxisQuery& query) : query_(query), hull_(query.hull()) {}

  AxisPoint nearest(const std::array<Point, 3>& triangle) const {
    AxisPoint best = query_.nearest(triangle[0]);
    for (std::size_t j = 1; j < 3; ++j) keep(best, query_.nearest(triangle[j]));
    for (std::uint32_t i = 0; i < hull_.count; ++i) keep(best, at_corner(i, triangle));
    if (hull_.count == 1) return best;
    const std::uint32_t edges = hull_.count == 2 ? 1 : 3;
    for (std::uint32_t e = 0; e < edges; ++e) {
      const std::uint32_t from = e, to = (e + 1) % hull_.count;
      for (std::size_t j = 0; j < 3; ++j) edge_pair(from, to, triangle[j], triangle[(j + 1) % 3], best);
      pierce(from, to, triangle, best);
    }
    if (hull_.count == 3) {
      for (std::size_t j = 0; j < 3; ++j) be_pierced(triangle[j], triangle[(j + 1) % 3], best);
    }
    return best;
  }

 private:
  static void keep(AxisPoint& best, const AxisPoint& other) {
    if (other.distance < best.distance) best = other;
  }

  AxisPoint at_corner(std::uint32_t i, const std::array<Point, 3>& triangle) const {
    const Ball& ball = hull_.corners[i];
    AxisPoint result;
    result.weight[i] = 1;
    result.distance = std::sqrt(nearest_on_triangle(ball.centre, triangle).squared_distance) - ball.radius;
    return result;
  }

  /// The stationary point inside of both edges. The unit vector n from the axis to the triangle has the product -s with
  /// the direction e of the axis, s the slope of the radius, and 0 with that of the other edge, f: in the plane of both
  /// n is -s (e - (e.f) f) / (1 - (e.f)^2), which leaves its part across them, and with it the distance.
  void edge_pair(std::uint32_t from, std::uint32_t to, const Point& start, const Point& end, AxisPoint& best) const {
    const Ball &a = hull_.corners[from], &b = hull_.corners[to];
    const Point along = b.centre - a.centre, other = end - start;
    const double extent = length(along), other_extent = length(other);
    const double growth = b.radius - a.radius;
    if (!(std::fabs(growth) < extent) || !(other_extent > 0)) return;
    const Point e = (1 / extent) * along, f = (1 / other_extent) * other;
    const double s = growth / extent, ef = dot(e, f);
    const Point across = cross(e, f);
    const double sine = dot(across, across);
    const double rest = sine - s * s;  // sine times the square of the part of n across
    if (!(rest > 0)) return;           // also for parallel edges
    const Point w = start - a.centre;
    const double distance = std::fabs(dot(w, across)) / std::sqrt(rest);
    const double we = dot(w, e), wf = dot(w, f);
    const double t = (distance * s + we - ef * wf) / sine;
    const double u = t * ef - wf;
    if (t < 0 || t > extent || u < 0 || u > other_extent) return;
    const Point offset = w + u * f - t * e;
    AxisPoint found;
    found.weight[from] = 1 - t / extent;
    found.weight[to] = t / extent;
    found.distance = length(offset) - (a.radius + t * s);
    keep(best, found);
  }

  /// Where an edge of the axis passes through the triangle.
  void pierce(std::uint32_t from, std::uint32_t to, const std::array<Point, 3>& triangle, AxisPoint& best) const {
    const Ball &a = hull_.corners[from], &b = hull_.corners[to];
    std::array<double, 3> weight;
    double share;
    if (!passes(a.centre, b.centre, triangle, share, weight)) return;
    AxisPoint found;
    found.weight[from] = 1 - share;
    found.weight[to] = share;
    const Point p = weight[0] * triangle[0] + weight[1] * triangle[1] + weight[2] * triangle[2];
    keep_at(best, found, p);
  }

  /// Where an edge of the triangle passes through the axis.
  void be_pierced(const Point& start, const Point& end, AxisPoint& best) const {
    AxisPoint found;
    double share;
    const std::array<Point, 3> axis = {hull_.corners[0].centre, hull_.corners[1].centre, hull_.corners[2].centre};
    if (!passes(start, end, axis, share, found.weight)) return;
    keep_at(best, found, start + share * (end - start));
  }

  /// The distance of a meeting point, which is 0 only up to the rounding of a normal: that of a thin triangle may have
  /// any direction.
  void keep_at(AxisPoint& best, AxisPoint& found, const Point& p) const {
    const Ball ball = ball_at(hull_, found.weight);
    found.distance = length(p - ball.centre) - ball.radius;
    keep(best, found);
  }

  static bool passes(const Point& start, const Point& end, const std::array<Point, 3>& t, double& share,
                     std::array<double, 3>& weight) {
    const Point normal = cross(t[1] - t[0], t[2] - t[0]);
    const double before = dot(normal, start - t[0]), after = dot(normal, end - t[0]);
    if (before * after > 0 || before == after) return false;
    share = before / (before - after);
    const Point p = start + share * (end - start);
    const double area = dot(normal, normal);
    for (std::size_t k = 0; k < 3; ++k) {
      const Point &q = t[(k + 1) % 3], &r = t[(k + 2) % 3];
      weight[k] = dot(cross(q - p, r - p), normal) / area;
      if (!(weight[k] >= 0)) return false;
    }
    return true;
  }

  const AxisQuery& query_;
  const BallHull& hull_;
};

}  // namespace medial_vk
