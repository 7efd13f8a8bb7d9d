#include "proximity/neighbours/relative_pose.h"

#include <cmath>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

using Matrix = std::array<Point, 3>;

/// Of the transpose of m.
Point transposed_times(const Matrix& m, const Point& p) { return p[0] * m[0] + (p[1] * m[1] + p[2] * m[2]); }

Point column(const Matrix& m, std::size_t j) { return {m[0][j], m[1][j], m[2][j]}; }

Point unit(const Point& p) { return (1 / length(p)) * p; }

/// The matrix with perpendicular unit rows close to those of m.
Matrix made_orthogonal(const Matrix& m) {
  const Point x = unit(m[0]), y = unit(m[1] - dot(m[1], x) * x);
  return {x, y, cross(x, y)};
}

/// The square root of the sum of the squares of all entries.
double norm(const Matrix& m) { return std::sqrt(dot(m[0], m[0]) + dot(m[1], m[1]) + dot(m[2], m[2])); }

}  // namespace

/// Let x be the difference of two points in the computed frame. In the world it is Q x + (Q R - W) p + (Q s - (w - q)),
/// where Q and W are the given rotations, q and w the given shifts, R and s those computed, and p the point of the
/// second body. The matrices and vectors in brackets are computed; their own roundings are less than 32 u times the
/// sizes of their terms. |Q x| differs from |x| by at most |Q'Q - 1| |x|.
RelativePose relative_pose(const Pose& first, const Pose& second, double reach) {
  if (first == Pose{}) return {second, 0, 0};
  constexpr double kRounding = 32 * 0x1p-53;
  const Matrix &q = first.rotation, &w = second.rotation;
  RelativePose relative;
  Matrix product;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) product[i][j] = dot(column(q, i), column(w, j));
  }
  relative.pose.rotation = made_orthogonal(product);
  const Point between = second.shift - first.shift;
  relative.pose.shift = transposed_times(q, between);
  const Matrix& r = relative.pose.rotation;
  Matrix of_rotation, of_unit;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      of_rotation[i][j] = dot(q[i], column(r, j)) - w[i][j];
      of_unit[i][j] = dot(column(q, i), column(q, j)) - (i == j ? 1 : 0);
    }
  }
  const Point of_shift = Pose{q, {0, 0, 0}} * relative.pose.shift - between;
  relative.share = norm(of_unit) + kRounding;
  relative.length = (norm(of_rotation) + kRounding) * reach + length(of_shift) +
                    kRounding * (length(first.shift) + length(second.shift));
  relative.length *= 1 + kRounding;
  return relative;
}

}  // namespace medial_vk
