#include "ball_unions/cells/ball_tree.h"

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "base/point_ops.h"

namespace medial_vk {
namespace {

using Matrix = std::array<Point, 3>;

/// Principal axes of a symmetric matrix by Jacobi's rotations. Four sweeps; their accuracy affects the tightness of
/// boxes, not their correctness.
Matrix principal_axes(Matrix m) {
  Matrix axes = {Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}};
  for (int step = 0; step < 12; ++step) {
    const std::size_t p = step % 3 == 2 ? 1 : 0, q = step % 3 == 0 ? 1 : 2;
    if (m[p][q] == 0) continue;
    const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
    const double tangent = std::copysign(1.0, theta) / (std::fabs(theta) + std::sqrt(theta * theta + 1));
    const double cosine = 1 / std::sqrt(tangent * tangent + 1), sine = tangent * cosine;
    const auto rotate = [&](double& a, double& b) {
      const double was = a;
      a = cosine * was - sine * b;
      b = sine * was + cosine * b;
    };
    for (std::size_t k = 0; k < 3; ++k) rotate(m[k][p], m[k][q]);
    for (std::size_t k = 0; k < 3; ++k) rotate(m[p][k], m[q][k]);
    for (std::size_t k = 0; k < 3; ++k) rotate(axes[p][k], axes[q][k]);
  }
  return axes;
}

Point along(const Matrix& axes, const Point& x) { return {dot(axes[0], x), dot(axes[1], x), dot(axes[2], x)}; }

/// Fits the axes and the box.
void fit_box(BallTree::Node& node, std::span<const Ball> balls, std::span<const std::uint32_t> names) {
  Point mean{};
  for (const std::uint32_t j : names) mean = mean + balls[j].centre;
  mean = (1.0 / static_cast<double>(names.size())) * mean;
  Matrix spread{};
  for (const std::uint32_t j : names) {
    const Point d = balls[j].centre - mean;
    for (std::size_t k = 0; k < 3; ++k) spread[k] = spread[k] + d[k] * d;
  }
  node.axes = principal_axes(spread);
  Point lower = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, upper = -1 * lower;
  for (const std::uint32_t j : names) {
    const Point x = along(node.axes, balls[j].centre - mean);
    lower = least(lower, x);
    upper = greatest(upper, x);
  }
  node.middle = mean;
  for (std::size_t k = 0; k < 3; ++k) node.middle = node.middle + (0.5 * (lower[k] + upper[k])) * node.axes[k];
  // The sizes are measured again, around the rounded middle.
  for (const std::uint32_t j : names) {
    const Point x = along(node.axes, balls[j].centre - node.middle);
    for (std::size_t k = 0; k < 3; ++k) node.half[k] = std::max(node.half[k], std::fabs(x[k]));
  }
}

/// Fits the slope by least squares along each axis, then lowers the bound to the lowest ball.
void fit_powers(BallTree::Node& node, std::span<const Ball> balls, std::span<const std::uint32_t> names) {
  const auto lifted = [&](std::uint32_t j) {
    const Point d = balls[j].centre - node.middle;
    return dot(d, d) - balls[j].radius * balls[j].radius;
  };
  const auto position = [&](std::uint32_t j) { return along(node.axes, balls[j].centre - node.middle); };
  double mean = 0;
  Point centre{};
  for (const std::uint32_t j : names) {
    mean += lifted(j);
    centre = centre + position(j);
  }
  const double share = 1.0 / static_cast<double>(names.size());
  mean *= share;
  centre = share * centre;
  Point both{}, own{};
  for (const std::uint32_t j : names) {
    const Point d = position(j) - centre;
    const double rise = lifted(j) - mean;
    for (std::size_t k = 0; k < 3; ++k) {
      both[k] += d[k] * rise;
      own[k] += d[k] * d[k];
    }
  }
  for (std::size_t k = 0; k < 3; ++k) node.slope[k] = own[k] > DBL_MIN ? both[k] / own[k] : 0;
  node.least = HUGE_VAL;
  for (const std::uint32_t j : names) node.least = std::min(node.least, lifted(j) - dot(node.slope, position(j)));
}

}  // namespace

BallTree::BallTree(std::span<const Ball> balls, unsigned threads) : balls_(balls), order_(balls.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  const std::size_t blocks = (balls.size() + kLeaf - 1) / kLeaf;
  leaves_ = static_cast<std::uint32_t>(std::bit_ceil(std::max<std::size_t>(blocks, 1)));
  nodes_.resize(2 * static_cast<std::size_t>(leaves_) - 1);
  // Level by level; the nodes of a level are independent.
  for (std::uint32_t level = 1; level <= leaves_; level *= 2) {
    const std::size_t span = std::size_t{leaves_ / level} * kLeaf;
    parallel_blocks(level, 16, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n) build(static_cast<std::uint32_t>(level - 1 + n), n * span, span);
    });
  }
}

std::size_t BallTree::end_of(std::size_t begin, std::size_t span) const {
  return std::min(begin + span, order_.size());
}

void BallTree::build(std::uint32_t k, std::size_t begin, std::size_t span) {
  Node& node = nodes_[k];
  node.radius = -1;
  if (begin >= order_.size()) return;
  const std::span<std::uint32_t> names(order_.data() + begin, end_of(begin, span) - begin);
  fit_box(node, balls_, names);
  fit_powers(node, balls_, names);
  for (const std::uint32_t j : names) {
    node.radius = std::max(node.radius, balls_[j].radius);
    node.size = std::max(node.size, length(balls_[j].centre - node.middle) + balls_[j].radius);
  }
  if (is_leaf(k) || names.size() <= span / 2) return;
  const auto longest =
      static_cast<std::size_t>(std::max_element(node.half.begin(), node.half.end()) - node.half.begin());
  const Point& axis = node.axes[longest];
  std::nth_element(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(span / 2), names.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double x = dot(axis, balls_[a].centre), y = dot(axis, balls_[b].centre);
                     return x < y || (x == y && a < b);
                   });
}

std::span<const std::uint32_t> BallTree::balls_of_leaf(std::uint32_t k) const {
  const std::size_t begin = std::size_t{k - (leaves_ - 1)} * kLeaf;
  if (begin >= order_.size()) return {};
  return {order_.data() + begin, end_of(begin, kLeaf) - begin};
}

BallMask::BallMask(const BallTree& tree)
    : is_in_(tree.order().size(), 1), leaf_of_(tree.order().size()), count_(tree.node_count(), 0) {
  for (std::uint32_t n = 0; n < tree.order().size(); ++n) {
    const std::uint32_t leaf = tree.first_leaf() + n / BallTree::kLeaf;
    leaf_of_[tree.order()[n]] = leaf;
    ++count_[leaf];
  }
  for (std::uint32_t k = tree.first_leaf(); k-- > 0;) count_[k] = count_[2 * k + 1] + count_[2 * k + 2];
}

void BallMask::set(std::uint32_t ball, bool in) {
  if (holds(ball) == in) return;
  is_in_[ball] = in;
  for (std::uint32_t k = leaf_of_[ball];; k = (k - 1) / 2) {
    count_[k] += in ? 1u : ~0u;  // one more, or one less
    if (k == 0) break;
  }
}

}  // namespace medial_vk
