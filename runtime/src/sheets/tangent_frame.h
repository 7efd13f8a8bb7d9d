// Directions in the tangent plane of a medial sheet.
#pragma once

#include <cmath>

#include "base/point_ops.h"
#include "medial_vk/medial_spheres.h"

namespace medial_vk {

/// Equation 2.11, not of unit length; its sign is arbitrary.
inline Point sheet_normal(const MedialSphere& sphere) {
  Point n;
  for (std::size_t i = 0; i < 3; ++i) n[i] = double{sphere.spoke_a[i]} - double{sphere.spoke_b[i]};
  return n;
}

/// Two axes perpendicular to a normal of any length; those perpendicular to z if the normal is zero.
class TangentFrame {
 public:
  explicit TangentFrame(const Point& normal) {
    const double norm = length(normal);
    const Point n = norm > 0 ? 1 / norm * normal : Point{0, 0, 1};
    const Point aside = std::abs(n[0]) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0};
    u_ = cross(n, aside);
    u_ = 1 / length(u_) * u_;
    v_ = cross(n, u_);
  }

  /// The angle of a direction, seen along the normal, from -pi to pi.
  double angle(const Point& direction) const { return std::atan2(dot(direction, v_), dot(direction, u_)); }

 private:
  Point u_, v_;
};

}  // namespace medial_vk
