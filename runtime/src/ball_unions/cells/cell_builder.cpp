#include "ball_unions/cells/cell_builder.h"

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <utility>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

constexpr std::size_t kLanes = 4;

}  // namespace

/// Ball j takes the points x from ball i where |x - c_j|^2 - r_j^2 < |x - c_i|^2 - r_i^2, a half-space; it cuts a
/// polyhedron only if it takes a corner. With x and c_j relative to the node's middle, the power of j is |x|^2 - 2 x .
/// c_j + (|c_j|^2 - r_j^2) >= |x|^2 + least + (slope - 2 x) . c_j, and the product is least in a corner of the box.
/// `offset`: from the node's middle to the cell's ball.
bool CellBuilder::may_cut(const BallTree::Node& node, const Point& offset) const {
  const double radius = balls_[cell_.ball()].radius;
  const double distance = length(offset);
  if (distance > (node.size + radius) * (1 + 16 * DBL_EPSILON)) return false;
  // Every term is at most scale^2, and there are fewer than 64 roundings.
  const double scale = distance + 2 * radius + node.size;
  const double margin = 64 * DBL_EPSILON * scale * scale;
  const double enough = margin - node.least;
  for (std::size_t c = 0; c < x_.size(); c += kLanes) {
    if (least_power(node, offset, c) <= enough) return true;
  }
  return false;
}

/// The least value over some corners, without node.least. Every step is lane by lane, which compilers vectorise.
double CellBuilder::least_power(const BallTree::Node& node, const Point& offset, std::size_t first) const {
  using Lanes = std::array<double, kLanes>;
  Lanes x, y, z, power;
  for (std::size_t n = 0; n < kLanes; ++n) x[n] = x_[first + n] + offset[0];
  for (std::size_t n = 0; n < kLanes; ++n) y[n] = y_[first + n] + offset[1];
  for (std::size_t n = 0; n < kLanes; ++n) z[n] = z_[first + n] + offset[2];
  for (std::size_t n = 0; n < kLanes; ++n) power[n] = x[n] * x[n] + y[n] * y[n] + z[n] * z[n] - power_[first + n];
  for (std::size_t k = 0; k < 3; ++k) {
    const Point axis = 2 * node.axes[k];
    const double slope = node.slope[k], half = node.half[k];
    for (std::size_t n = 0; n < kLanes; ++n) {
      power[n] -= std::fabs(slope - (axis[0] * x[n] + axis[1] * y[n] + axis[2] * z[n])) * half;
    }
  }
  return std::min(std::min(power[0], power[1]), std::min(power[2], power[3]));
}

void CellBuilder::read_corners() {
  const Ball& ball = balls_[cell_.ball()];
  const std::size_t count = cell_.corners().size();
  const std::size_t padded = (count + kLanes - 1) / kLanes * kLanes;
  for (auto* array : {&x_, &y_, &z_, &power_}) array->resize(padded);
  // Powers of two balls differ by 2 |c_j - c_i| per unit of length, and only balls that overlap count.
  const double steepest = 2 * (ball.radius + tree_.node(0).radius);
  for (std::size_t c = 0; c < padded; ++c) {
    const PowerCell::Corner& corner = cell_.corners()[std::min(c, count - 1)];
    x_[c] = corner.at[0];
    y_[c] = corner.at[1];
    z_[c] = corner.at[2];
    power_[c] = dot(corner.at, corner.at) - ball.radius * ball.radius + steepest * corner.slack;
  }
}

void CellBuilder::cut_by(std::uint32_t j) {
  const std::uint32_t i = cell_.ball();
  if (j == i || (mask_ != nullptr && !mask_->holds(j))) return;
  if (are_apart(balls_[i], balls_[j])) return;
  // For a plane that bounds the cell already, the side of all corners on it would be undecided.
  if (!cell_.was_cut_by(j)) cell_.clip(j);
}

void CellBuilder::walk_tree() {
  const Point& centre = balls_[cell_.ball()].centre;
  struct Visit {
    std::uint32_t node;
    Point offset;
  };
  const auto visit = [&](std::uint32_t k) { return Visit{k, centre - tree_.node(k).middle}; };
  std::array<Visit, 64> stack;  // one per level of the tree
  std::size_t depth = 0;
  stack[depth++] = visit(0);
  while (depth > 0 && !cell_.empty()) {
    const auto [k, offset] = stack[--depth];
    if (mask_ != nullptr && !mask_->any_in(k)) continue;
    if (!may_cut(tree_.node(k), offset)) continue;
    if (tree_.is_leaf(k)) {
      const std::size_t planes = cell_.planes().size();
      for (const std::uint32_t j : tree_.balls_of_leaf(k)) cut_by(j);
      if (cell_.planes().size() != planes && !cell_.empty()) read_corners();
      continue;
    }
    Visit near = visit(2 * k + 1), far = visit(2 * k + 2);
    const bool has_far = tree_.node(far.node).radius >= 0;
    if (has_far && dot(far.offset, far.offset) < dot(near.offset, near.offset)) std::swap(near, far);
    if (has_far) stack[depth++] = far;
    stack[depth++] = near;
  }
}

void CellBuilder::remember_neighbours() {
  hints_.assign(1, cell_.ball());
  is_used_.assign(cell_.planes().size(), 0);
  for (const PowerCell::Corner& corner : cell_.corners()) {
    for (const std::uint32_t p : corner.planes) {
      if (is_used_[p] != 0 || cell_.planes()[p].ball < 0) continue;
      is_used_[p] = 1;
      hints_.push_back(static_cast<std::uint32_t>(cell_.planes()[p].ball));
    }
  }
}

const PowerCell& CellBuilder::build(std::uint32_t i) {
  cell_.start(i);
  for (const std::uint32_t j : hints_) {
    cut_by(j);
    if (cell_.empty()) break;
  }
  if (cell_.empty()) return cell_;
  read_corners();
  walk_tree();
  cell_.sharpen();
  if (!cell_.empty()) remember_neighbours();
  return cell_;
}

}  // namespace medial_vk
