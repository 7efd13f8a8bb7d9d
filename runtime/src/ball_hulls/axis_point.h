// The ball of a hull that is nearest to a point: the closed form behind signed_distance().
//
// Over a segment with the slope s of the radius, |s| < 1, the minimum of |p - c| - r is where the direction from c to
// p makes the angle with cosine s with the segment: ahead of the foot of p by h s / sqrt(1 - s^2), where h is the
// distance of p from the line. Over the plane of a triangle it is ahead of the foot by h w / sqrt(1 - w^2) in the
// direction of the gradient w of the radius, |w| < 1. The function is convex: where that point is beyond an end the
// minimum is at that end, and where it is outside of the triangle the way from it to any point of the triangle enters
// through a side beyond which it lies, so that the minimum is on such a side.
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

/// The nearest ball over an edge of the axis.
inline AxisPoint nearest_on_edge(const BallHull& hull, const AxisEdge& edge, const Point& p) {
  const Ball &a = hull.corners[edge.from], &b = hull.corners[edge.to];
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

/// The same over the whole plane of a face that exists; weights may be negative. At the minimum the direction from c to
/// p is w + sqrt(1 - w^2) n, and its product with p - c is the distance of the centres.
inline AxisPoint nearest_in_plane(const BallHull& hull, const AxisFace& face, const Point& p) {
  const Ball& first = hull.corners[face.from];
  const Point offset = p - first.centre;
  const double x = dot(offset, face.along), y = dot(offset, face.across);
  const double height = std::fabs(dot(offset, face.normal));
  AxisPoint result;
  result.weight = face.weights_at(x + height * face.ahead_along, y + height * face.ahead_across);
  result.distance = height * face.cosine - x * face.slope_along - y * face.slope_across - first.radius;
  return result;
}

/// The nearest ball of a hull of three, whose edge k, from ball k to ball (k + 1) mod 3, is edge_of(k).
template <class EdgeOf>
AxisPoint nearest_of_three(const BallHull& hull, const AxisFace& face, const EdgeOf& edge_of, const Point& p) {
  AxisPoint best;
  best.distance = std::numeric_limits<double>::infinity();
  std::array<bool, 3> behind = {true, true, true};  // whether the minimum may be on the edge opposite a corner
  if (face.exists) {
    const AxisPoint inside = nearest_in_plane(hull, face, p);
    for (std::size_t k = 0; k < 3; ++k) behind[k] = inside.weight[k] < 0;
    if (!behind[0] && !behind[1] && !behind[2]) return inside;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (!behind[k]) continue;
    const AxisPoint other = nearest_on_edge(hull, edge_of((k + 1) % 3), p);
    if (other.distance < best.distance) best = other;
  }
  return best;
}

/// The nearest ball of a hull to points, with all that does not depend on the point computed once.
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
    if (hull_.count == 2) return nearest_on_edge(hull_, edges_[0], p);
    return nearest_of_three(
        hull_, face_, [this](std::size_t k) -> const AxisEdge& { return edges_[k]; }, p);
  }

 private:
  BallHull hull_;
  std::array<AxisEdge, 3> edges_ = {};
  AxisFace face_;
};

}  // namespace medial_vk
