#pragma once

#include <cmath>

#include "medial_vk/mesh_view.h"

namespace medial_vk {

/// The sign of det(a, b, c), or 0 if rounding, or a change of the determinant by up to `slack`, could have produced it.
/// The arguments are differences of doubles and carry u = 2^-53 each; with the products and sums of three terms the
/// error stays below 9u times the sum of the magnitudes.
inline int sign_of_determinant(const Point& a, const Point& b, const Point& c, double slack = 0) {
  double determinant = 0, magnitude = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double left = b[(k + 1) % 3] * c[(k + 2) % 3], right = b[(k + 2) % 3] * c[(k + 1) % 3];
    determinant += a[k] * (left - right);
    magnitude += std::fabs(a[k]) * (std::fabs(left) + std::fabs(right));
  }
  const double bound = 12 * 0x1p-53 * magnitude + slack;
  return determinant > bound ? 1 : determinant < -bound ? -1 : 0;
}

}  // namespace medial_vk
