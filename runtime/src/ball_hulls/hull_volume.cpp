// The volume of a hull: each of its points lies between a ball's centre, or an edge or the face of the axis, and the
// part of the surface in front of it (docs/theory.md, "Hulls of balls", "Volume of one hull").
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "ball_hulls/hull_shape.h"
#include "base/point_ops.h"
#include "medial_vk/ball_hull.h"

namespace medial_vk {
namespace {

using std::numbers::pi;

double volume_of_ball(const Ball& ball) { return 4 * pi / 3 * ball.radius * ball.radius * ball.radius; }

/// Between an edge of length `extent` and its cone, in a wedge of one radian around the edge, for the radii at its
/// ends.
double wedge(double extent, double a, double b) {
  const double slope = (a - b) / extent;
  return extent * (1 - slope) * (1 + slope) * (a * a + a * b + b * b) / 6;
}

double volume_of_cone(const Ball& a, const Ball& b) {
  const double extent = length(b.centre - a.centre);
  const double slope = (a.radius - b.radius) / extent;
  const double caps = (1 + slope) * a.radius * a.radius * a.radius + (1 - slope) * b.radius * b.radius * b.radius;
  return 2 * pi / 3 * caps + 2 * pi * wedge(extent, a.radius, b.radius);
}

double volume_of_slab(const HullShape& shape) {
  const AxisFace& face = shape.face;
  const std::array<std::size_t, 3> order = {face.from, face.to, face.third};  // counter-clockwise in the frame
  std::array<std::array<double, 2>, 3> corner{};
  corner[1] = {face.extent, 0};
  corner[2] = {face.third_along, face.third_across};
  std::array<double, 3> radius{}, solid_angle{};
  for (std::size_t i = 0; i < 3; ++i) radius[i] = shape.balls[order[i]].radius;
  const double double_area = face.extent * face.third_across;
  double volume = face.cosine * double_area * (radius[0] + radius[1] + radius[2]) / 3;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const std::array<double, 2> side = {corner[j][0] - corner[i][0], corner[j][1] - corner[i][1]};
    const std::array<double, 2> back = {corner[k][0] - corner[i][0], corner[k][1] - corner[i][1]};
    const double extent = std::hypot(side[0], side[1]);
    // The arc of directions of the edge's cone: the normals of the flat triangles, which end it, are z = `cosine` above
    // the plane and y outside of the edge in it.
    const double outside = (-face.slope_along * side[1] + face.slope_across * side[0]) / extent;
    const double arc = 2 * std::atan2(face.cosine, outside);
    const double slope = (radius[i] - radius[j]) / extent;
    volume += arc * wedge(extent, radius[i], radius[j]);
    solid_angle[i] += arc * slope;
    solid_angle[j] -= arc * slope;
    // Of the flat triangle: its side vectors are those of the axis with the difference of the radii along the normal.
    const double product = side[0] * back[0] + side[1] * back[1] - (radius[j] - radius[i]) * (radius[k] - radius[i]);
    solid_angle[i] += 2 * pi - 2 * std::atan2(face.cosine * double_area, product);
  }
  for (std::size_t i = 0; i < 3; ++i) volume += solid_angle[i] * radius[i] * radius[i] * radius[i] / 3;
  return volume;
}

}  // namespace

double volume_of(const BallHull& hull) {
  const HullShape shape = shape_of(hull);
  const auto& [a, b, c] = shape.balls;
  switch (shape.form) {
    case HullForm::kBall:
      return volume_of_ball(a);
    case HullForm::kCone:
      return volume_of_cone(a, b);
    case HullForm::kChain:
      return volume_of_cone(a, b) + volume_of_cone(b, c) - volume_of_ball(b);
    case HullForm::kSlab:
      break;
  }
  return volume_of_slab(shape);
}

}  // namespace medial_vk
