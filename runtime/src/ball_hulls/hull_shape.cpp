#include "ball_hulls/hull_shape.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ball_hulls/axis_point.h"
#include "base/point_ops.h"

namespace medial_vk {
namespace {

/// Over the circle of directions in which the hull of balls i and j is a cone: the mean of what the support of ball k
/// exceeds theirs by. It has the sign of all values if there is no direction in which all three are equal.
double mean_excess(const std::array<Ball, 3>& balls, std::size_t i, std::size_t j, std::size_t k) {
  const Point along = balls[j].centre - balls[i].centre;
  const double cosine = (balls[i].radius - balls[j].radius) / dot(along, along);
  return cosine * dot(along, balls[k].centre - balls[i].centre) + balls[k].radius - balls[i].radius;
}

void leave_out(std::size_t index, HullShape& shape) {
  std::move(shape.balls.begin() + static_cast<std::ptrdiff_t>(index) + 1, shape.balls.end(),
            shape.balls.begin() + static_cast<std::ptrdiff_t>(index));
  --shape.count;
}

/// Leaves out balls in other balls.
void leave_out_nested(HullShape& shape) {
  for (std::size_t i = 0; i < shape.count;) {
    bool nested = false;
    for (std::size_t k = 0; k < shape.count; ++k) {
      if (k == i) continue;
      const double growth = shape.balls[k].radius - shape.balls[i].radius;
      nested = nested || length(shape.balls[k].centre - shape.balls[i].centre) <= growth;
    }
    if (nested) {
      leave_out(i, shape);  // of two equal balls the first goes, and the second has none to be in
    } else {
      ++i;
    }
  }
}

}  // namespace

HullShape shape_of(const BallHull& hull) {
  HullShape shape;
  shape.count = hull.count;
  shape.balls = hull.corners;
  leave_out_nested(shape);
  shape.form = shape.count == 1 ? HullForm::kBall : HullForm::kCone;
  if (shape.count < 3) return shape;
  shape.face = AxisFace(shape.hull());
  if (shape.face.exists) {
    shape.form = HullForm::kSlab;
    return shape;
  }
  double size = shape.face.extent;
  for (const Ball& ball : shape.balls) size = std::max(size, ball.radius);
  for (std::size_t k = 0; k < 3; ++k) {
    const BallHull others = hull_of(shape.balls[(k + 1) % 3], shape.balls[(k + 2) % 3]);
    if (signed_distance(others, shape.balls[k].centre) + shape.balls[k].radius > 0x1p-46 * size) continue;
    leave_out(k, shape);
    return shape;
  }
  // Each ball has a part of the surface, and no direction is common to three of them: there are two cones. The pair
  // without one is that over whose circle the third ball reaches farthest.
  shape.form = HullForm::kChain;
  std::size_t middle = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (mean_excess(shape.balls, (k + 1) % 3, (k + 2) % 3, k) >
        mean_excess(shape.balls, (middle + 1) % 3, (middle + 2) % 3, middle)) {
      middle = k;
    }
  }
  std::swap(shape.balls[middle], shape.balls[1]);
  return shape;
}

}  // namespace medial_vk
