// Proofs that two triangles are disjoint: a plane that separates them, with a gap that rounding cannot produce. A
// separating axis may be any vector, so only the projections onto it have to be bounded, not its own errors; and where
// no axis is found, the answer is "not proven".
#include <algorithm>

#include "base/determinant_sign.h"
#include "base/point_ops.h"
#include "mesh/crossings/self_intersections.h"

namespace medial_vk {
namespace {

/// The sign of w.x, or 0 if rounding could have produced it: w is taken as exact, x is a difference of doubles, so the
/// error stays below 4u times the sum of the magnitudes.
int sign_along(const Point& w, const Point& x) {
  const double product = dot(w, x);
  const double bound = 6 * 0x1p-53 * (std::abs(w[0] * x[0]) + std::abs(w[1] * x[1]) + std::abs(w[2] * x[2]));
  return product > bound ? 1 : product < -bound ? -1 : 0;
}

Point unit(const Point& a) { return (1 / length(a)) * a; }

}  // namespace

bool certainly_disjoint(const std::array<Point, 3>& a, const std::array<Point, 3>& b) {
  // Relative to a corner: each coordinate then has a relative error of u, at any distance to the origin.
  std::array<Point, 6> p;
  double largest = 0;
  for (int i = 0; i < 3; ++i) {
    p[i] = a[i] - a[0];
    p[i + 3] = b[i] - a[0];
  }
  for (const Point& q : p) {
    for (const double x : q) largest = std::max(largest, std::abs(x));
  }
  // A projection w.p has an error of at most 4u |w|_1 max|p|; two of them and their difference stay below 10u.
  const auto separates = [&](const Point& w) {
    const double gap = 16 * 0x1p-53 * (std::abs(w[0]) + std::abs(w[1]) + std::abs(w[2])) * largest;
    const double a0 = dot(w, p[0]), a1 = dot(w, p[1]), a2 = dot(w, p[2]);
    const double b0 = dot(w, p[3]), b1 = dot(w, p[4]), b2 = dot(w, p[5]);
    return std::max({a0, a1, a2}) + gap < std::min({b0, b1, b2}) ||
           std::max({b0, b1, b2}) + gap < std::min({a0, a1, a2});
  };
  const std::array<Point, 3> a_sides = {p[1], p[2] - p[1], p[2]};
  const std::array<Point, 3> b_sides = {p[4] - p[3], p[5] - p[4], p[5] - p[3]};
  const Point a_normal = cross(a_sides[0], a_sides[2]);
  const Point b_normal = cross(b_sides[0], b_sides[2]);
  if (separates(a_normal) || separates(b_normal)) return true;
  for (const Point& s : a_sides) {
    for (const Point& t : b_sides) {
      if (separates(cross(s, t))) return true;
    }
  }
  const auto upright = [&](const Point& normal) {
    return [&](const Point& side) { return separates(cross(normal, side)); };
  };
  return std::ranges::any_of(a_sides, upright(a_normal)) || std::ranges::any_of(b_sides, upright(b_normal));
}

bool certainly_meet_at_apex(const Point& apex, const Point& a1, const Point& a2, const Point& b1, const Point& b2) {
  // Two cones with one apex meet only there exactly if some plane through the apex separates them strictly; turn it
  // until it touches a cone, and it holds one or two of the four directions. These are the candidates.
  const Point a[2] = {a1 - apex, a2 - apex};
  const Point b[2] = {b1 - apex, b2 - apex};
  // The first candidate succeeds for most neighbours on a smooth surface.
  const Point a_unit[2] = {unit(a[0]), unit(a[1])};
  const Point b_unit[2] = {unit(b[0]), unit(b[1])};
  const auto separates = [&](const Point& w) {
    const int sign = sign_along(w, a[0]);
    return sign != 0 && sign_along(w, a[1]) == sign && sign_along(w, b[0]) == -sign && sign_along(w, b[1]) == -sign;
  };
  if (separates((a_unit[0] + a_unit[1]) - (b_unit[0] + b_unit[1]))) return true;
  // The plane of one triangle: the other one strictly on one side.
  const int plane_a = sign_of_determinant(a[0], a[1], b[0]);
  if (plane_a != 0 && plane_a == sign_of_determinant(a[0], a[1], b[1])) return true;
  const int plane_b = sign_of_determinant(b[0], b[1], a[0]);
  if (plane_b != 0 && plane_b == sign_of_determinant(b[0], b[1], a[1])) return true;
  // A plane through a side of each: their other sides strictly on different sides.
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      const int other_a = sign_of_determinant(a[i], b[j], a[1 - i]);
      if (other_a != 0 && other_a == -sign_of_determinant(a[i], b[j], b[1 - j])) return true;
    }
  }
  // A plane through a side of one that stands upright on its triangle (both triangles may lie in one plane). Any vector
  // may serve as the normal, which is taken as exact.
  const Point normal_a = cross(a[0], a[1]);
  const Point normal_b = cross(b[0], b[1]);
  for (int i = 0; i < 2; ++i) {
    const int own_a = sign_of_determinant(normal_a, a[i], a[1 - i]);
    if (own_a != 0 && sign_of_determinant(normal_a, a[i], b[0]) == -own_a &&
        sign_of_determinant(normal_a, a[i], b[1]) == -own_a) {
      return true;
    }
    const int own_b = sign_of_determinant(normal_b, b[i], b[1 - i]);
    if (own_b != 0 && sign_of_determinant(normal_b, b[i], a[0]) == -own_b &&
        sign_of_determinant(normal_b, b[i], a[1]) == -own_b) {
      return true;
    }
  }
  // In one plane and with sides that continue each other's (a grid): between the sides.
  for (const Point& side_a : a_unit) {
    for (const Point& side_b : b_unit) {
      if (separates(cross(normal_a, side_a + side_b))) return true;
    }
  }
  return false;
}

bool certainly_meet_at_side(const Point& p, const Point& q, const Point& a, const Point& b) {
  const Point side = q - p, to_a = a - p, to_b = b - p;
  if (sign_of_determinant(side, to_a, to_b) != 0) return true;
  // Both in one plane, up to rounding: on different sides of the common side.
  const Point normal = cross(side, to_a);
  const int sign_a = sign_of_determinant(normal, side, to_a);
  return sign_a != 0 && sign_of_determinant(normal, side, to_b) == -sign_a;
}

}  // namespace medial_vk
