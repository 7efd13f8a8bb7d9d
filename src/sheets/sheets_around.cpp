#include "sheets/sheets_around.h"

#include <algorithm>
#include <cmath>

#include "mesh/point_ops.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kLeafPoints = 8;

double distance_to_box(const Point& at, const Point& least, const Point& greatest) {
  Point gap;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    gap[axis] = std::max({least[axis] - at[axis], at[axis] - greatest[axis], 0.0});
  }
  return length(gap);
}

void add_weight(std::int32_t sheet, double weight, SheetsAround::Weights& out) {
  if (!(weight > 0)) return;
  const auto found = std::ranges::find(out, sheet, [](const auto& entry) { return entry.first; });
  if (found == out.end()) {
    out.emplace_back(sheet, weight);
  } else {
    found->second += weight;
  }
}

}  // namespace

SheetsAround::SheetsAround(std::span<const Ball> balls, std::span<const std::int32_t> sheet_of,
                           std::vector<std::uint32_t> order)
    : balls_(balls), sheet_of_(sheet_of), order_(std::move(order)) {
  if (!order_.empty()) build(0, static_cast<std::uint32_t>(order_.size()));
}

bool SheetsAround::others_near(const Point& at, double reach, std::int32_t sheet) const {
  return !nodes_.empty() && others_near(0, at, reach, sheet);
}

SheetsAround::Weights SheetsAround::weights(const Point& at, double reach) const {
  Weights out;
  if (!nodes_.empty()) add(0, at, reach, out);
  return out;
}

std::uint32_t SheetsAround::build(std::uint32_t first, std::uint32_t last) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  Node node = {};
  node.first = first;
  node.last = last;
  describe(node);
  nodes_.push_back(node);
  if (last - first <= kLeafPoints) return index;
  const Point size = node.greatest - node.least;
  const auto axis = static_cast<std::size_t>(std::ranges::max_element(size) - size.begin());
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](std::uint32_t a, std::uint32_t b) { return balls_[a].centre[axis] < balls_[b].centre[axis]; });
  build(first, middle);
  const std::uint32_t right = build(middle, last);
  nodes_[index].right = right;
  return index;
}

void SheetsAround::describe(Node& node) const {
  node.least = node.greatest = balls_[order_[node.first]].centre;
  node.sheet = sheet_of_[order_[node.first]];
  for (std::uint32_t i = node.first; i < node.last; ++i) {
    const Point& centre = balls_[order_[i]].centre;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      node.least[axis] = std::min(node.least[axis], centre[axis]);
      node.greatest[axis] = std::max(node.greatest[axis], centre[axis]);
      node.centroid[axis] += centre[axis];
    }
    if (sheet_of_[order_[i]] != node.sheet) node.sheet = -1;
  }
  for (double& coordinate : node.centroid) coordinate /= node.last - node.first;
}

bool SheetsAround::others_near(std::uint32_t index, const Point& at, double reach, std::int32_t sheet) const {
  const Node& node = nodes_[index];
  if (node.sheet == sheet || !(distance_to_box(at, node.least, node.greatest) < reach)) return false;
  if (node.right != 0) {
    return others_near(index + 1, at, reach, sheet) || others_near(node.right, at, reach, sheet);
  }
  return std::any_of(order_.begin() + node.first, order_.begin() + node.last, [&](std::uint32_t ball) {
    return sheet_of_[ball] != sheet && length(balls_[ball].centre - at) < reach;
  });
}

void SheetsAround::add(std::uint32_t index, const Point& at, double reach, Weights& out) const {
  const Node& node = nodes_[index];
  if (!(distance_to_box(at, node.least, node.greatest) < reach)) return;
  if (node.sheet >= 0 && length(node.greatest - node.least) <= reach / 4) {
    add_weight(node.sheet, (node.last - node.first) * (1 - length(node.centroid - at) / reach), out);
  } else if (node.right != 0) {
    add(index + 1, at, reach, out);
    add(node.right, at, reach, out);
  } else {
    for (std::uint32_t i = node.first; i < node.last; ++i) {
      const std::uint32_t ball = order_[i];
      add_weight(sheet_of_[ball], 1 - length(balls_[ball].centre - at) / reach, out);
    }
  }
}

}  // namespace medial_vk
