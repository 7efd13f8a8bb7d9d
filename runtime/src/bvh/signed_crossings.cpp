#include "bvh/signed_crossings.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "base/determinant_sign.h"
#include "base/point_ops.h"

namespace medial_vk {
namespace {

/// False only if the ray does not meet the box. The products have relative errors of a few 2^-53, and the sign of a
/// difference is exact.
bool may_meet(const BvhBox& box, const Point& p, const Point& inverse) {
  double enters = 0, leaves = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const double lower = (box.lower[k] - p[k]) * inverse[k], upper = (box.upper[k] - p[k]) * inverse[k];
    enters = std::max(enters, std::min(lower, upper));
    leaves = std::min(leaves, std::max(lower, upper));
  }
  return leaves * (1 + 0x1p-49) >= enters;
}

/// With a, b, c the corners as seen from p, the direction is a sum of them with the weights (d, b, c), (d, c, a) and
/// (d, a, b) over (a, b, c), all of them determinants. The ray crosses the triangle if all weights are positive, that
/// is, if the four signs agree; p is behind it if they are positive. No value: that is open.
std::optional<int> crossing(const std::array<Point, 3>& corners, const Point& p, const Point& direction) {
  const Point a = corners[0] - p, b = corners[1] - p, c = corners[2] - p;
  const int of_a = sign_of_determinant(direction, b, c), of_b = sign_of_determinant(direction, c, a);
  if (of_a * of_b < 0) return 0;
  const int of_c = sign_of_determinant(direction, a, b);
  const auto [least, most] = std::minmax({of_a, of_b, of_c});
  if (least * most < 0) return 0;
  const int whole = sign_of_determinant(a, b, c);
  if (whole * least < 0 || whole * most < 0) return 0;
  if (least * most == 0 || whole == 0) return std::nullopt;
  return whole;
}

}  // namespace

std::optional<std::int64_t> signed_crossings(const Bvh& bvh, const Point& p, const Point& direction) {
  const Point inverse = {1 / direction[0], 1 / direction[1], 1 / direction[2]};
  std::array<std::uint32_t, Bvh::kMaxDepth + 1> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  std::int64_t sum = 0;
  while (size > 0) {
    const BvhNode& node = bvh.nodes()[stack[--size]];
    if (!may_meet(node.box, p, inverse)) continue;
    if (node.count == 0) {
      stack[size++] = node.first;
      stack[size++] = node.first + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const std::optional<int> sign = crossing(bvh.corners()[i], p, direction);
      if (!sign) return std::nullopt;
      sum += *sign;
    }
  }
  return sum;
}

}  // namespace medial_vk
