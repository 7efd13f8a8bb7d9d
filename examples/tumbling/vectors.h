// Vectors and rotations of the example.
#pragma once

#include <medial_vk/pose.h>

#include <array>
#include <cmath>

namespace tumbling {

using Vector = medial_vk::Point;

inline Vector operator+(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vector operator*(double s, const Vector& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline double length(const Vector& a) { return std::sqrt(dot(a, a)); }
inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// By rows.
using Matrix = std::array<Vector, 3>;

inline Vector operator*(const Matrix& m, const Vector& p) { return {dot(m[0], p), dot(m[1], p), dot(m[2], p)}; }
inline Matrix transposed(const Matrix& m) {
  return {{{m[0][0], m[1][0], m[2][0]}, {m[0][1], m[1][1], m[2][1]}, {m[0][2], m[1][2], m[2][2]}}};
}
inline Matrix inverse_of(const Matrix& m) {
  const Vector x = cross(m[1], m[2]), y = cross(m[2], m[0]), z = cross(m[0], m[1]);
  const double s = 1 / dot(m[0], x);
  return transposed({s * x, s * y, s * z});
}

/// A unit quaternion: w, x, y, z.
using Quaternion = std::array<double, 4>;

inline Matrix rotation_of(const Quaternion& q) {
  const auto& [w, x, y, z] = q;
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
           {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
           {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
}

/// Turned on with an angular velocity for a short time.
inline Quaternion turned(const Quaternion& q, const Vector& spin, double time) {
  const Vector v = {q[1], q[2], q[3]}, turn = 0.5 * time * spin;
  const Vector u = v + q[0] * turn + cross(turn, v);
  Quaternion out = {q[0] - dot(turn, v), u[0], u[1], u[2]};
  const double norm = std::sqrt(out[0] * out[0] + dot(u, u));
  for (double& x : out) x /= norm;
  return out;
}

}  // namespace tumbling
