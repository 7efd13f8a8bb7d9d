#include "mesh/winding/winding_step.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/determinant_sign.h"
#include "base/point_ops.h"

namespace medial_vk {
namespace {

constexpr double kRounding = 0x1p-53;
constexpr std::uint32_t kNoPosition = 0xffffffffu;

/// The side of the plane of t on which a point lies: 1 in front, -1 behind, 0 undecided. The point may have an error of
/// `shift`, which changes the determinant by at most the length of the normal times that.
int side_of_plane(const std::array<Point, 3>& t, const Point& p, double shift) {
  const double slack = shift * length(cross(t[1] - t[0], t[2] - t[0]));
  return -sign_of_determinant(t[0] - p, t[1] - p, t[2] - p, 2 * slack);
}

/// A straight leg of a path, and the triangles on which it begins or ends.
struct Leg {
  Point p, q;
  std::uint32_t first = kNoPosition, last = kNoPosition;
};

/// True if the leg may meet the box. The quotients have relative errors of 2u, and their comparison one of 4u.
bool may_meet(const Leg& leg, const TreeBox& box) {
  double enter = 0, leave = 1;
  for (int k = 0; k < 3; ++k) {
    const double d = leg.q[k] - leg.p[k];
    const double to_lower = box.lower[k] - leg.p[k], to_upper = box.upper[k] - leg.p[k];
    if (d == 0) {
      if (to_lower > 0 || to_upper < 0) return false;
      continue;
    }
    enter = std::max(enter, (d > 0 ? to_lower : to_upper) / d);
    leave = std::min(leave, (d > 0 ? to_upper : to_lower) / d);
  }
  return enter <= leave * (1 + 8 * kRounding);
}

/// 1 if the leg goes through the triangle from its front, -1 from behind, 0 if it does not. No value: undecided.
std::optional<int> crossing(const Leg& leg, const std::array<Point, 3>& t, double shift) {
  const int begins = side_of_plane(t, leg.p, shift), ends = side_of_plane(t, leg.q, shift);
  if (begins == ends && begins != 0) return 0;
  const Point d = leg.q - leg.p;
  bool left = false, right = false, doubt = begins == 0 || ends == 0;
  for (int k = 0; k < 3; ++k) {
    const int turn = sign_of_determinant(t[k] - leg.p, t[(k + 1) % 3] - leg.p, d);
    left = left || turn > 0;
    right = right || turn < 0;
    doubt = doubt || turn == 0;
  }
  if (left && right) return 0;  // The line passes beside it.
  if (doubt) return std::nullopt;
  return begins;
}

/// The sum over all triangles except those on which the leg begins or ends.
std::optional<int> count_crossings(const TriangleTree& tree, const Leg& leg, double shift, std::uint64_t& cost) {
  int sum = 0;
  constexpr std::size_t kDepth = 128;  // 95 levels at most, see TriangleTree
  std::array<std::uint32_t, kDepth> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const TriangleTree::Node& node = tree.nodes[stack[--size]];
    ++cost;
    if (!may_meet(leg, node.box)) continue;
    if (node.left != 0) {
      stack[size++] = node.right;
      stack[size++] = node.left;
      continue;
    }
    for (std::uint32_t position = node.first; position < node.first + node.count; ++position) {
      ++cost;
      if (position == leg.first || position == leg.last || !may_meet(leg, tree.boxes[position])) continue;
      const std::optional<int> found = crossing(leg, tree.corners[position], shift);
      if (!found) return std::nullopt;
      sum += *found;
    }
  }
  return sum;
}

/// A path: its points on the two triangles, given along two sides, and the point between them where it bends, as a
/// share of its length. The numbers are arbitrary, so that the path is unlikely to meet a corner or side. It must bend
/// where both triangles lie in one plane.
struct Way {
  double along_first, along_second;
  Point bend;
};
constexpr std::array<Way, 5> kWays = {{{0.3137, 0.3491, {0, 0, 0}},
                                       {0.2719, 0.4142, {0.2213, 0.1371, 0.1733}},
                                       {0.4253, 0.2237, {-0.1151, 0.2477, 0.1237}},
                                       {0.2011, 0.3679, {0.1429, -0.1087, -0.2311}},
                                       {0.3571, 0.2903, {-0.1873, -0.1319, 0.1613}}}};

Point point_of(const std::array<Point, 3>& t, const Way& way) {
  return t[0] + (way.along_first * (t[1] - t[0]) + way.along_second * (t[2] - t[0]));
}

std::optional<int> step_along(const TriangleTree& tree, std::uint32_t from, std::uint32_t to, const Way& way,
                              double shift, std::uint64_t& cost) {
  const Point p = point_of(tree.corners[from], way), q = point_of(tree.corners[to], way);
  const bool bends = dot(way.bend, way.bend) > 0;
  const Point middle = p + (0.5 * (q - p) + length(q - p) * way.bend);
  // In front of its first triangle the winding number is 1/2 less than beside it, behind it 1/2 more; so at the last.
  const int leaves = side_of_plane(tree.corners[from], bends ? middle : q, shift);
  const int comes = side_of_plane(tree.corners[to], bends ? middle : p, shift);
  if (leaves == 0 || comes == 0) return std::nullopt;
  const int at_ends = (comes - leaves) / 2;
  if (!bends) {
    const std::optional<int> between = count_crossings(tree, {p, q, from, to}, shift, cost);
    return between ? std::optional(*between + at_ends) : std::nullopt;
  }
  const std::optional<int> there = count_crossings(tree, {p, middle, from, kNoPosition}, shift, cost);
  if (!there) return std::nullopt;
  const std::optional<int> on = count_crossings(tree, {middle, q, kNoPosition, to}, shift, cost);
  return on ? std::optional(*there + *on + at_ends) : std::nullopt;
}

/// The distance by which rounding may move point_of() off the plane: in each coordinate by 3u of each of the two
/// products, which are shorter than twice the largest coordinate, and by u of the sum; that is less than 14u of it in
/// all directions.
double shift_of(const TreeBox& box) {
  double largest = 0;
  for (int k = 0; k < 3; ++k) largest = std::max({largest, std::abs(box.lower[k]), std::abs(box.upper[k])});
  return 32 * kRounding * largest;
}

}  // namespace

std::optional<int> winding_step(const TriangleTree& tree, std::uint32_t from, std::uint32_t to, std::uint64_t& cost) {
  const double shift = shift_of(tree.nodes[0].box);
  for (const Way& way : kWays) {
    if (const std::optional<int> step = step_along(tree, from, to, way, shift, cost)) return step;
  }
  return std::nullopt;
}

}  // namespace medial_vk
