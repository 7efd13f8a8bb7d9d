#include "device_mesh/device_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include "base/parallel.h"
#include "base/point_ops.h"

namespace medial_vk {
namespace {

// Corners are rounded to float (2^-25 in the unit box), edges are differences of rounded corners (another 2^-25): the
// triangle that a kernel reads stays within 2^-23 of the exact one. Twice that allows for the transform.
constexpr double kBoxMargin = 0x1p-22;

// Consecutive nodes or triangles that a thread processes.
constexpr std::size_t kBlock = 4096;

// A point that no query is near to, whose squared distance is still finite in float.
constexpr float kFarAway = 1e18f;

float round_down(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) <= x ? f : std::nextafterf(f, -std::numeric_limits<float>::infinity());
}
float round_up(double x) { return -round_down(-x); }

std::array<float, 3> to_float(const Point& p) {
  return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
}

Texel texel(const Point& xyz, double w) {
  const auto [x, y, z] = to_float(xyz);
  return {x, y, z, static_cast<float>(w)};
}

Point difference(const std::array<float, 3>& a, const std::array<float, 3>& b) {
  return {double{a[0]} - b[0], double{a[1]} - b[1], double{a[2]} - b[2]};
}

/// 0 for an edge without length, so that its nearest point is its start.
double inverse_square(const Point& edge) {
  const double squared = dot(edge, edge);
  return squared > 1e-36 ? 1.0 / squared : 0.0;
}

/// Integrals over a set of triangles, about the origin of the unit box: those of 1, x, n, x n^T and |x|^2.
struct Moments {
  double area = 0;
  Point first = {0, 0, 0};
  Point normal = {0, 0, 0};
  std::array<Point, 3> mixed = {};  // [i][j]: x_i n_j
  double second = 0;
  Point centre = {0, 0, 0};
  double reach = 0;  // no point of the set is further from the centre

  void add(const Moments& other) {
    area += other.area;
    first = first + other.first;
    normal = normal + other.normal;
    for (int i = 0; i < 3; ++i) mixed[i] = mixed[i] + other.mixed[i];
    second += other.second;
  }
};

Moments moments_of(const std::array<Point, 3>& corners) {
  const auto& [a, b, c] = corners;
  const Point area_normal = 0.5 * cross(b - a, c - a);
  const Point sum = a + b + c;
  Moments m;
  m.area = length(area_normal);
  m.first = (m.area / 3) * sum;
  m.normal = area_normal;
  for (int i = 0; i < 3; ++i) m.mixed[i] = (sum[i] / 3) * area_normal;
  m.second = m.area / 12 * (dot(a, a) + dot(b, b) + dot(c, c) + dot(sum, sum));
  return m;
}

double farthest_corner(const Point& p, const BvhBox& box) { return length(greatest(p - box.lower, box.upper - p)); }

std::array<Point, 3> unit_corners(const std::array<Point, 3>& corners, const UnitTransform& to_unit) {
  return {to_unit(corners[0]), to_unit(corners[1]), to_unit(corners[2])};
}

Point centre_of(const Moments& m, const BvhNode& node, const UnitTransform& to_unit) {
  return m.area > 0 ? (1 / m.area) * m.first : 0.5 * (to_unit(node.box.lower) + to_unit(node.box.upper));
}

Moments leaf_moments(const Bvh& bvh, const BvhNode& node, const UnitTransform& to_unit) {
  Moments m;
  const auto for_each_triangle = [&](auto visit) {
    for (std::uint32_t t = node.first; t < node.first + node.count; ++t) visit(unit_corners(bvh.corners()[t], to_unit));
  };
  for_each_triangle([&](const std::array<Point, 3>& corners) { m.add(moments_of(corners)); });
  m.centre = centre_of(m, node, to_unit);
  for_each_triangle([&](const std::array<Point, 3>& corners) {
    for (const Point& corner : corners) m.reach = std::max(m.reach, length(corner - m.centre));
  });
  return m;
}

Moments joined_moments(const Moments& left, const Moments& right, const BvhNode& node, const UnitTransform& to_unit) {
  Moments m;
  m.add(left);
  m.add(right);
  m.centre = centre_of(m, node, to_unit);
  m.reach = std::max(length(left.centre - m.centre) + left.reach, length(right.centre - m.centre) + right.reach);
  m.reach = std::min(m.reach, farthest_corner(m.centre, {to_unit(node.box.lower), to_unit(node.box.upper)}));
  return m;
}

/// Moments of every node: the leaves, which are most of the work, on all threads. Children come after their parents in
/// a Bvh, so a pass in reverse order visits them first.
std::vector<Moments> all_moments(const Bvh& bvh, const UnitTransform& to_unit, unsigned threads) {
  const std::vector<BvhNode>& nodes = bvh.nodes();
  std::vector<Moments> all(nodes.size());
  parallel_blocks(nodes.size(), kBlock, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (nodes[i].count != 0) all[i] = leaf_moments(bvh, nodes[i], to_unit);
    }
  });
  for (std::size_t i = nodes.size(); i-- > 0;) {
    const BvhNode& node = nodes[i];
    if (node.count == 0) all[i] = joined_moments(all[node.first], all[node.first + 1], node, to_unit);
  }
  return all;
}

/// The four texels of a child's moments, as shaders/shared/tree/winding.glsl evaluates them.
std::array<Texel, 4> moment_texels(const Moments& m) {
  constexpr double kSphere = 4 * std::numbers::pi;
  std::array<Point, 3> about_centre = m.mixed;
  for (int i = 0; i < 3; ++i) about_centre[i] = about_centre[i] - m.centre[i] * m.normal;
  const double third = (about_centre[0][0] + about_centre[1][1] + about_centre[2][2]) / 3;
  const auto entry = [&](int i, int j) {
    const double symmetric = 0.5 * (about_centre[i][j] + about_centre[j][i]);
    return -3 / kSphere * (symmetric - (i == j ? third : 0.0));
  };
  // The subtraction leaves an absolute error of some units of rounding of the area; the bound must not be too small.
  const double spread = std::max(0.0, m.second - m.area * dot(m.centre, m.centre)) + 1e-14 * m.area;
  return {texel(m.centre, round_up(m.reach + 2 * kBoxMargin)),
          texel((1 / kSphere) * m.normal, round_up(3 / kSphere * spread)),
          texel({entry(0, 0), entry(1, 1), entry(2, 2)}, m.area / kSphere),
          texel({2 * entry(0, 1), 2 * entry(0, 2), 2 * entry(1, 2)}, 0)};
}

/// Two texels of a child: lower corner and first index, upper corner and number of triangles (0: an inner node).
std::pair<Texel, Texel> box_texels(const BvhNode& node, std::uint32_t first, const UnitTransform& to_unit) {
  const FloatBox box = float_box(node.box, to_unit);
  return {Texel{box.lower[0], box.lower[1], box.lower[2], static_cast<float>(first)},
          Texel{box.upper[0], box.upper[1], box.upper[2], static_cast<float>(node.count)}};
}

/// The greatest turn of a triangle by the rounding of its corners (docs/theory.md, "Rounding").
double tilt(const Point& ab, const Point& ac) {
  const double longest = std::max({length(ab), length(ac), length(ac - ab)});
  return 1.2e-7 * longest / std::max(length(cross(ab, ac)), 1e-30);
}

/// `spread`: the sine of the greatest turn of spokes from its normal; none if the normal is not trusted.
std::array<Texel, kTexelsPerTriangle> triangle_texels(const std::array<Point, 3>& exact, std::optional<double> spread) {
  // Every triangle rounds a shared corner identically, so the float mesh is as watertight as the exact one.
  const std::array<float, 3> a = to_float(exact[0]);
  const Point ab = difference(to_float(exact[1]), a);
  const Point ac = difference(to_float(exact[2]), a);
  const Point normal = cross(exact[1] - exact[0], exact[2] - exact[0]);
  const double size = length(normal);
  return {Texel{a[0], a[1], a[2], static_cast<float>(inverse_square(ab))}, texel(ab, inverse_square(ac)),
          texel(ac, inverse_square(ac - ab)),
          texel(size > 0 ? (1 / size) * normal : Point{0, 0, 0},
                spread && size > 0 ? round_up(1 + std::min(1.0, *spread + 2 * tilt(ab, ac))) : 0.0)};
}

}  // namespace

FloatBox float_box(const BvhBox& box, const UnitTransform& to_unit) {
  const Point lower = to_unit(box.lower);
  const Point upper = to_unit(box.upper);
  FloatBox out;
  for (int k = 0; k < 3; ++k) {
    out.lower[k] = round_down(lower[k] - kBoxMargin);
    out.upper[k] = round_up(upper[k] + kBoxMargin);
  }
  return out;
}

std::vector<Texel> make_triangle_texels(const Bvh& bvh, const UnitTransform& to_unit,
                                        std::span<const std::uint8_t> flags, std::span<const float> spreads,
                                        unsigned threads) {
  std::vector<Texel> texels(kTexelsPerTriangle * bvh.corners().size());
  parallel_blocks(bvh.corners().size(), kBlock, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const bool trusted = !flags.empty() && (flags[bvh.order()[i]] & kTrustedNormal) != 0;
      const std::optional<double> spread = trusted ? std::optional(spreads.empty() ? 1.0 : spreads[i]) : std::nullopt;
      const auto four = triangle_texels(unit_corners(bvh.corners()[i], to_unit), spread);
      std::copy(four.begin(), four.end(), texels.begin() + kTexelsPerTriangle * static_cast<std::ptrdiff_t>(i));
    }
  });
  return texels;
}

std::vector<Texel> make_tree_texels(const Bvh& bvh, const UnitTransform& to_unit, unsigned threads) {
  const std::vector<BvhNode>& nodes = bvh.nodes();
  std::vector<std::uint32_t> inner(nodes.size(), 0);  // number among the inner nodes
  std::uint32_t inner_count = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].count == 0) inner[i] = inner_count++;
  }
  const std::vector<Moments> moments = all_moments(bvh, to_unit, threads);
  const std::uint32_t count = std::max(1u, inner_count);
  std::vector<Texel> texels(std::size_t{kTexelsPerNode} * count);
  const auto put_child = [&](std::uint32_t parent, std::uint32_t side, std::size_t child) {
    Texel* boxes = &texels[4 * std::size_t{parent} + 2 * side];
    const std::uint32_t first = nodes[child].count == 0 ? inner[child] : nodes[child].first;
    std::tie(boxes[0], boxes[1]) = box_texels(nodes[child], first, to_unit);
    const std::array<Texel, 4> m = moment_texels(moments[child]);
    std::copy(m.begin(), m.end(), texels.begin() + 4 * std::ptrdiff_t{count} + 8 * std::ptrdiff_t{parent} + 4 * side);
  };
  parallel_blocks(nodes.size(), kBlock, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (nodes[i].count != 0) continue;
      put_child(inner[i], 0, nodes[i].first);
      put_child(inner[i], 1, nodes[i].first + 1);
    }
  });
  if (inner_count == 0) {  // a single leaf: its sibling is one triangle, far away and without area
    put_child(0, 0, 0);
    texels[2] = {kFarAway, kFarAway, kFarAway, 0};
    texels[3] = {kFarAway, kFarAway, kFarAway, 1};
    texels[8] = {1e6f, 1e6f, 1e6f, 0};
  }
  return texels;
}

}  // namespace medial_vk
