// Arithmetic on Point, in double.
#pragma once

#include <algorithm>
#include <cmath>

#include "medial_vk/mesh_view.h"

namespace medial_vk {

inline Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Point operator+(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Point operator*(double s, const Point& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Point& a) { return std::sqrt(dot(a, a)); }

inline Point least(const Point& a, const Point& b) {
  return {std::min(a[0], b[0]), std::min(a[1], b[1]), std::min(a[2], b[2])};
}
inline Point greatest(const Point& a, const Point& b) {
  return {std::max(a[0], b[0]), std::max(a[1], b[1]), std::max(a[2], b[2])};
}

/// A unit vector perpendicular to `axis`, in the plane of `axis` and the coordinate axis closest to perpendicular to
/// it.
inline Point perpendicular_to(const Point& axis) {
  std::size_t along = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (std::fabs(axis[k]) < std::fabs(axis[along])) along = k;
  }
  Point across{};
  across[along] = 1;
  across = across - axis[along] * axis;
  return (1 / length(across)) * across;
}

/// Twice the area, along the normal, from the corner where rounding costs least: the one opposite the longest side.
/// `shorter` gets the product of the lengths of the two sides used. The differences of two doubles carry a relative
/// error u = 2^-53 each; a component of the product then has an error of at most 4u (|e_y f_z| + |e_z f_y|)
/// <= 4u |e| |f|, and the vector one of at most 4 sqrt(3) u |e| |f| < 8u |e| |f|.
inline Point double_area(const Point& a, const Point& b, const Point& c, double& shorter) {
  const Point ab = b - a, bc = c - b, ca = a - c;
  const double ab2 = dot(ab, ab), bc2 = dot(bc, bc), ca2 = dot(ca, ca);
  if (ab2 >= bc2 && ab2 >= ca2) {
    shorter = std::sqrt(bc2) * std::sqrt(ca2);
    return cross(bc, ca);
  }
  if (bc2 >= ca2) {
    shorter = std::sqrt(ab2) * std::sqrt(ca2);
    return cross(ca, ab);
  }
  shorter = std::sqrt(ab2) * std::sqrt(bc2);
  return cross(ab, bc);
}

/// The bound derived above, relative to `shorter`: a double_area() that is not longer has no meaningful direction.
constexpr double kAreaRounding = 8 * 0x1p-53;

/// A sum that does not lose the small terms (Neumaier 1974).
class CompensatedSum {
 public:
  void add(double x) {
    const double t = sum_ + x;
    carry_ += std::abs(sum_) >= std::abs(x) ? (sum_ - t) + x : (x - t) + sum_;
    sum_ = t;
  }
  double value() const { return sum_ + carry_; }

 private:
  double sum_ = 0, carry_ = 0;
};

}  // namespace medial_vk
