#include "polygon.h"

#include "base/point_ops.h"

namespace medial_vk::bench {

void cut_off(Polygon& polygon, const Point& normal, double height) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double of_a = dot(normal, a) - height, of_b = dot(normal, b) - height;
    if (of_a <= 0) kept.push_back(a);
    if ((of_a < 0 && of_b > 0) || (of_a > 0 && of_b < 0)) kept.push_back(a + (of_a / (of_a - of_b)) * (b - a));
  }
  polygon = std::move(kept);
}

bool meets_box(const std::array<Point, 3>& triangle, const Point& lower, const Point& upper) {
  Polygon polygon(triangle.begin(), triangle.end());
  for (std::size_t axis = 0; axis < 3 && !polygon.empty(); ++axis) {
    Point normal{};
    normal[axis] = 1;
    cut_off(polygon, normal, upper[axis]);
    cut_off(polygon, -1.0 * normal, -lower[axis]);
  }
  return !polygon.empty();
}

}  // namespace medial_vk::bench
