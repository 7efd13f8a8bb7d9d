#include "proximity/boxes/boxes.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace medial_vk {
namespace {

struct Extent {
  double least = std::numeric_limits<double>::infinity(), greatest = -std::numeric_limits<double>::infinity();

  double middle() const { return 0.5 * (least + greatest); }
  double half() const { return 0.5 * (greatest - least); }
};

Extent extent_along(std::span<const Point> points, const Point& axis) {
  Extent extent;
  for (const Point& p : points) {
    const double s = dot(p, axis);
    extent.least = std::min(extent.least, s);
    extent.greatest = std::max(extent.greatest, s);
  }
  return extent;
}

using Axes = std::array<Point, 3>;

/// Of the perpendicular axes across the normal, in steps of a right angle's sixteenth, those of the smallest box.
Axes axes_across(std::span<const Point> points, const Point& normal) {
  constexpr std::size_t kSteps = 16;
  const double size = length(normal);
  constexpr double kMeaningful = 1e-150;  // squares of shorter vectors lose digits
  const Point n = size > kMeaningful ? (1 / size) * normal : Point{0, 0, 1};
  const Point x = perpendicular_to(n), y = cross(n, x);
  Axes best = {n, x, y};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < kSteps; ++i) {
    const double angle = 0.5 * std::numbers::pi * static_cast<double>(i) / kSteps;
    const Point e = std::cos(angle) * x + std::sin(angle) * y, f = cross(n, e);
    const double half_edges = extent_along(points, e).half() + extent_along(points, f).half();
    if (half_edges >= least) continue;
    least = half_edges;
    best = {n, e, f};
  }
  return best;
}

}  // namespace

void EightBoxes::set(std::size_t k, const FloatBox& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    centre[axis][k] = box.centre[axis];
    for (std::size_t edge = 0; edge < 3; ++edge) half_edges[edge][axis][k] = box.half_edges[edge][axis];
  }
}

/// Let a point be c + b_1 f_1 + b_2 f_2 + b_3 f_3 with the float centre c and perpendicular unit vectors f_i, |b_i| <=
/// h_i, and let the half edge e_i be (h_i + 8 u h) f_i in float, with u = 2^-24 and h = h_1 + h_2 + h_3. Along any unit
/// vector d the point is at most at c.d + sum h_i |f_i.d|. Rounding moves e_i by less than u (h_i + 8 u h) for each of
/// its coordinates in turn, and so |e_i.d| by no more than that. All three do by less than 2 u h, but the sum of the
/// longer edges is greater than that of the h_i |f_i.d| by 8 u h sum |f_i.d| >= 8 u h. So the box reaches farther along
/// every d, which is to say that it holds the point. What remains of the 6 u h, and the last term of `slack`, are for
/// the rounding in double: of the point, of f_i and of b_i.
FloatBox box_around(std::span<const Point> points, const Point& normal) {
  const Axes axes = axes_across(points, normal);
  Point middle = {0, 0, 0};
  for (const Point& axis : axes) middle = middle + extent_along(points, axis).middle() * axis;
  FloatBox box;
  for (std::size_t k = 0; k < 3; ++k) box.centre[k] = static_cast<float>(middle[k]);
  const Point centre = {box.centre[0], box.centre[1], box.centre[2]};
  double size = length(centre);
  std::array<double, 3> half = {0, 0, 0};
  for (const Point& p : points) {
    size = std::max(size, length(p));
    for (std::size_t i = 0; i < 3; ++i) half[i] = std::max(half[i], std::fabs(dot(p - centre, axes[i])));
  }
  const double slack = 8 * 0x1p-24 * (half[0] + half[1] + half[2]) + 0x1p-47 * size;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) box.half_edges[i][k] = static_cast<float>((half[i] + slack) * axes[i][k]);
  }
  return box;
}

}  // namespace medial_vk
