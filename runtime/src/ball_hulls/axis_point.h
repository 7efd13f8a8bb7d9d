// The ball of a hull that is nearest to a point: the closed form behind signed_distance().
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

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
/// direction of the gradient w of the radius, |w| < 1. The function is convex, so where that point is beyond an end the
/// minimum is at that end, and where it is outside of the triangle it is on an edge.
class AxisQuery {
 public:
  explicit AxisQuery(const BallHull& hull) : hull_(hull) {
    if (hull.count >= 2) edges_[0] = Edge(hull, 0, 1);
    if (hull.count < 3) return;
    edges_[1] = Edge(hull, 1, 2);
    edges_[2] = Edge(hull, 2, 0);
    prepare_face();
  }

  const BallHull& hull() const { return hull_; }
  double distance(const Point& p) const { return nearest(p).distance; }

  AxisPoint nearest(const Point& p) const {
    if (hull_.count == 1) return {length(p - hull_.corners[0].centre) - hull_.corners[0].radius, {1, 0, 0}};
    if (hull_.count == 2) return on_edge(edges_[0], p);
    if (has_face_) {
      const AxisPoint inside = in_face(p);
      if (inside.weight[0] >= 0 && inside.weight[1] >= 0 && inside.weight[2] >= 0) return inside;
    }
    AxisPoint best = on_edge(edges_[0], p);
    for (std::size_t k = 1; k < 3; ++k) {
      const AxisPoint other = on_edge(edges_[k], p);
      if (other.distance < best.distance) best = other;
    }
    return best;
  }

 private:
  struct Edge {
    std::uint8_t from = 0, to = 0;
    Point direction{};     // of unit length
    double extent = 0;     // the distance of the centres
    double slope = 0;      // of the radius
    double ahead = 0;      // slope / sqrt(1 - slope^2)
    bool is_cone = false;  // false: one ball holds the other

    Edge() = default;
    Edge(const BallHull& hull, std::uint8_t i, std::uint8_t j) : from(i), to(j) {
      const Point along = hull.corners[j].centre - hull.corners[i].centre;
      extent = length(along);
      const double growth = hull.corners[j].radius - hull.corners[i].radius;
      is_cone = std::fabs(growth) < extent;
      if (!is_cone) return;
      direction = (1 / extent) * along;
      slope = growth / extent;
      ahead = slope / std::sqrt((1 - slope) * (1 + slope));
    }
  };

  AxisPoint on_edge(const Edge& edge, const Point& p) const {
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

  void prepare_face() {
    const auto& [a, b, c] = hull_.corners;
    const Point ab = b.centre - a.centre, ac = c.centre - a.centre;
    const Point normal = cross(ab, ac);
    const double area = dot(normal, normal);
    // A thinner triangle is its edges, up to rounding.
    if (!(area > 1e-24 * dot(ab, ab) * dot(ac, ac))) return;
    const Point across_b = cross(ac, normal), across_c = cross(normal, ab);
    to_b_ = (1 / area) * across_b;
    to_c_ = (1 / area) * across_c;
    const Point gradient = (b.radius - a.radius) * to_b_ + (c.radius - a.radius) * to_c_;
    const double squared = dot(gradient, gradient);
    if (!(squared < 1)) return;
    normal_ = (1 / std::sqrt(area)) * normal;
    const Point ahead = (1 / std::sqrt(1 - squared)) * gradient;
    ahead_b_ = dot(ahead, to_b_);
    ahead_c_ = dot(ahead, to_c_);
    has_face_ = true;
  }

  AxisPoint in_face(const Point& p) const {
    const auto& [a, b, c] = hull_.corners;
    const Point offset = p - a.centre;
    const double height = std::fabs(dot(offset, normal_));
    const double v = dot(offset, to_b_) + height * ahead_b_;
    const double w = dot(offset, to_c_) + height * ahead_c_;
    AxisPoint result;
    result.weight = {1 - v - w, v, w};
    const Point rest = offset - v * (b.centre - a.centre) - w * (c.centre - a.centre);
    result.distance = length(rest) - (a.radius + v * (b.radius - a.radius) + w * (c.radius - a.radius));
    return result;
  }

  const BallHull hull_;
  std::array<Edge, 3> edges_;
  bool has_face_ = false;
  Point normal_{};         // of unit length
  Point to_b_{}, to_c_{};  // products with them are the weights of a point in the plane, relative to the first centre
  double ahead_b_ = 0, ahead_c_ = 0;
};

}  // namespace medial_vk
