#include "sheets/voxel_section.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

/// A convex polygon: each of six half-spaces adds at most one corner to the first four.
struct Polygon {
  std::array<Point, 12> corners;
  std::size_t size = 0;

  void add(const Point& p) {
    if (size < corners.size()) corners[size++] = p;
  }
};

/// The part with sign * (x - bound) <= 0 along the axis.
Polygon clip(const Polygon& polygon, std::size_t axis, double sign, double bound) {
  Polygon out;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const Point &a = polygon.corners[i], &b = polygon.corners[(i + 1) % polygon.size];
    const double above_a = sign * (a[axis] - bound), above_b = sign * (b[axis] - bound);
    if (above_a <= 0) out.add(a);
    if ((above_a < 0 && above_b > 0) || (above_a > 0 && above_b < 0)) {
      out.add(a + above_a / (above_a - above_b) * (b - a));
    }
  }
  return out;
}

}  // namespace

double section_area(const std::array<double, 3>& point, const std::array<double, 3>& normal) {
  const double norm = length(normal);
  if (!(norm > 0)) return 0;
  const Point n = 1 / norm * normal;
  // Perpendicular to the axis that is nearest to the normal.
  std::size_t least = 0;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (std::abs(n[axis]) < std::abs(n[least])) least = axis;
  }
  Point along = {0, 0, 0};
  along[least] = 1;
  along = along - n[least] * n;
  along = 1 / length(along) * along;
  const Point across = cross(n, along);

  Polygon polygon;
  // Twice the diagonal of the cube, so that the polygon contains the plane's whole section of the cube.
  const std::array<std::pair<double, double>, 4> square = {{{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}};
  for (const auto& [u, v] : square) polygon.add(point + u * along + v * across);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    polygon = clip(polygon, axis, 1, 1);
    polygon = clip(polygon, axis, -1, 0);
  }
  Point sum = {0, 0, 0};
  for (std::size_t i = 1; i + 1 < polygon.size; ++i) {
    sum = sum + cross(polygon.corners[i] - polygon.corners[0], polygon.corners[i + 1] - polygon.corners[0]);
  }
  return 0.5 * length(sum);
}

}  // namespace medial_vk
