#include "site_voronoi/equidistant_step.h"

#include <array>
#include <cmath>

namespace medial_vk {

/// Orthogonal rows by Gram and Schmidt: the step is the sum of its parts along them.
std::optional<Point> step_to_equal(const Point& p, std::span<const SiteDistance> distances) {
  constexpr double kDependent = 1e-9;  // Of a row's length: less of it is its own, and the step would be of rounding.
  std::array<Point, 3> rows = {};
  Point step = {0, 0, 0};
  const SiteDistance& first = distances[0];
  const Point gradient = (1 / first.distance) * (p - first.contact);
  for (std::size_t i = 1; i < distances.size() && i < 4; ++i) {
    const SiteDistance& other = distances[i];
    const Point row = (1 / other.distance) * (p - other.contact) - gradient;
    Point own = row;
    for (std::size_t k = 0; k + 1 < i; ++k) own = own - dot(own, rows[k]) * rows[k];
    const double size = length(own);
    if (!(size > kDependent * length(row))) return std::nullopt;
    rows[i - 1] = (1 / size) * own;
    // The parts along the rows before are fixed already; this one makes the difference vanish.
    const double rest = other.distance - first.distance + dot(row, step);
    step = step - (rest / size) * rows[i - 1];
  }
  return step;
}

}  // namespace medial_vk
