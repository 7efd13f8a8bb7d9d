// The ball of a hull that is nearest to a point: the closed form behind signed_distance().
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "ball_hulls/axis_parts.h"
#include "base/point_ops.h"
#include "medial_vk/ball_hull.h"

namespace medial_vk {

/// A ball of a hull by its weights, and the signed distance of a point to that ball.
struct AxisPoint {
  double distance = 0;                // |p - c(l)| - r(l)
  std::array<double, 3> weight = {};  // l
};

/// The centre and the radius of the ball with these weights.
inline Ball ball_at(const BallHull& hull, const std::array<double, 3>& weight) {
  Ball ball = {{0, 0, 0}, 0};
  for (std::uint32_t i = 0; i < hull.count; ++i) {
    ball.centre = ball.centre + weight[i] * hull.corners[i].centre;
    ball.radius += weight[i] * hull.corners[i].radius;
  }
  return ball;
}

/// The nearest ball of a hull to points, with all that does not depend on the point computed once.
///
/// Over a segment with the slope s of the radius, |s| < 1, the minimum of |p - c| - r is where the direction from c to
/// p makes the angle with cosine s with the segment: ahead of the foot of p by h s / sqrt(1 - s^2), where h is the
/// distance of p from the line. Over the plane of a triangle it is ahead of the foot by h w / sqrt(1 - w^2) in the
/// direction of the gradient w of the radius, |w| < 1. The function is convex: where that point is beyond an end the
/// minimum is at that end, and where it is outside of the triangle the way from it to any point of the triangle enters
/// through a side beyond which it lies, so that the minimum is on such a side.
class AxisQuery {
 public:
  explicit AxisQuery(const BallHull& hull) : hull_(hull) {
    if (hull.count >= 2) edges_[0] = AxisEdge(hull, 0, 1);
    if (hull.count < 3) return;
    edges_[1] = AxisEdge(hull, 1, 2);
    edges_[2] = AxisEdge(hull, 2, 0);
    face_ = AxisFace(hull);
  }

  const BallHull& hull() const { return hull_; }
  /// Edge k is from ball k to ball (k + 1) mod 3; a hull of two balls has edge 0 alone.
  const AxisEdge& edge(std::size_t k) const { return edges_[k]; }
  std::size_t edge_count() const { return hull_.count == 3 ? 3 : hull_.count - 1; }
  const AxisFace& face() const { return face_; }

  double distance(const Point& p) const { return nearest(p).distance; }

  AxisPoint nearest(const Point& p) const {
    if (hull_.count == 1) return {length(p - hull_.corners[0].centre) - hull_.corners[0].radius, {1, 0, 0}};
    if (hull_.count == 2) return nearest_on_edge(0, p);
    AxisPoint best;
    best.distance = std::numeric_limits<double>::infinity();
    if (face_.exists) {
      const AxisPoint inside = in_face(p);
      if (inside.weight[0] >= 0 && inside.weight[1] >= 0 && inside.weight[2] >= 0) return inside;
      for (std::size_t k = 0; k < 3; ++k) {
        if (inside.weight[k] < 0) keep_lesser(nearest_on_edge((k + 1) % 3, p), best);
      }
      return best;
    }
    for (std::size_t k = 0; k < 3; ++k) keep_lesser(nearest_on_edge(k, p), best);
    return best;
  }

  AxisPoint nearest_on_edge(std::size_t k, const Point& p) const {
    const AxisEdge& edge = edges_[k];
    const Ball &a = hull_.corners[edge.from], &b = hull_.corners[edge.to];
    AxisPoint result;
    if (!edge.is_cone) {
      const bool second = b.radius > a.radius;
      const Ball& larger = second ? b : a;
      result.weight[second ? edge.to : edge.from] = 1;
      result.distance = length(p - larger.centre) - larger.radius;
      return result;
    }
    const Point offset = p - a.centre;
    const double along = dot(offset, edge.direction);
    const double height = length(offset - along * edge.direction);
    const double share = std::clamp((along + height * edge.ahead) / edge.extent, 0.0, 1.0);
    result.weight[edge.from] = 1 - share;
    result.weight[edge.to] = share;
    const double rest = along - share * edge.extent;
    result.distance = std::sqrt(rest * rest + height * height) - (a.radius + share * (b.radius - a.radius));
    return result;
  }

 private:
  static void keep_lesser(const AxisPoint& other, AxisPoint& best) {
    if (other.distance < best.distance) best = other;
  }

  /// Over the whole plane; weights may be negative. At the minimum the direction from c to p is w + sqrt(1 - w^2) n,
  /// and its product with p - c is the distance.
  AxisPoint in_face(const Point& p) const {
    const Point offset = p - hull_.corners[face_.from].centre;
    const double x = dot(offset, face_.along), y = dot(offset, face_.across);
    const double height = std::fabs(dot(offset, face_.normal));
    AxisPoint result;
    result.weight = face_.weights_at(x + height * face_.ahead_along, y + height * face_.ahead_across);
    result.distance =
        height * face_.cosine - x * face_.slope_along - y * face_.slope_across - hull_.corners[face_.from].radius;
    return result;
  }

  BallHull hull_;
  std::array<AxisEdge, 3> edges_ = {};
  AxisFace face_;
};

}  // namespace medial_vk
