#include "base/spiral.h"

#include <cmath>

namespace medial_vk {

std::vector<Point> spiral_points(std::uint32_t count) {
  std::vector<Point> points;
  points.reserve(count);
  double azimuth = 0;
  for (std::uint32_t k = 0; k < count; ++k) {
    const double h = count > 1 ? 2.0 * k / (count - 1) - 1 : -1.0;
    const double across = std::sqrt(std::max(0.0, 1 - h * h));
    const bool pole = k == 0 || k + 1 == count;
    azimuth = pole ? 0.0 : azimuth + 3.6 / (std::sqrt(double(count)) * across);
    points.push_back(pole ? Point{0, 0, h} : Point{across * std::cos(azimuth), across * std::sin(azimuth), h});
  }
  return points;
}

}  // namespace medial_vk
