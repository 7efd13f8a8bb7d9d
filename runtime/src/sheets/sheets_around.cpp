#include "sheets/sheets_around.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "base/point_ops.h"

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

}  // namespace

SheetsAround::SheetsAround(std::span<const Ball> balls, std::span<const std::int32_t> sheet_of,
                           std::span<const double> weight_of, std::size_t sheets, std::vector<std::uint32_t> order)
    : balls_(balls), sheet_of_(sheet_of), weight_of_(weight_of), sheets_(sheets), order_(std::move(order)) {
  std::erase_if(order_, [&](std::uint32_t ball) { return !(weight_of_[ball] > 0); });
  if (!order_.empty()) build(0, static_cast<std::uint32_t>(order_.size()));
}

bool SheetsAround::others_near(const Point& at, double reach, std::int32_t sheet) const {
  return !nodes_.empty() && others_near(0, at, reach, sheet);
}

void SheetsAround::Given::add(const Given& other) {
  std::ranges::transform(sheets, other.sheets, sheets.begin(), std::plus<>());
  std::ranges::transform(nodes, other.nodes, nodes.begin(), std::plus<>());
}

bool SheetsAround::divide(double amount, const Point& at, double reach, Given& to) const {
  std::vector<Part> parts;
  if (!nodes_.empty()) find_parts(0, at, reach, parts);
  double sum = 0;
  for (const Part& part : parts) sum += part.weight * part.nearness;
  for (const Part& part : parts) {
    const double per_weight = amount * part.nearness / sum;
    if (part.sheet >= 0) to.sheets[static_cast<std::size_t>(part.sheet)] += part.weight * per_weight;
    if (part.sheet < 0) to.nodes[part.node] += per_weight;
  }
  return !parts.empty();
}

std::vector<double> SheetsAround::by_sheet(const Given& given) const {
  Given all = given;
  if (!nodes_.empty()) distribute(0, 0, all);
  return std::move(all.sheets);
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
  const Point origin = balls_[order_[node.first]].centre;
  node.least = node.greatest = origin;
  node.sheet = sheet_of_[order_[node.first]];
  for (std::uint32_t i = node.first; i < node.last; ++i) {
    const Point& centre = balls_[order_[i]].centre;
    const double weight = weight_of_[order_[i]];
    node.weight += weight;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      node.least[axis] = std::min(node.least[axis], centre[axis]);
      node.greatest[axis] = std::max(node.greatest[axis], centre[axis]);
      node.centroid[axis] += weight * (centre[axis] - origin[axis]);
    }
    if (sheet_of_[order_[i]] != node.sheet) node.sheet = -1;
  }
  node.centroid = origin + 1 / node.weight * node.centroid;
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

void SheetsAround::find_parts(std::uint32_t index, const Point& at, double reach, std::vector<Part>& parts) const {
  const Node& node = nodes_[index];
  if (!(distance_to_box(at, node.least, node.greatest) < reach)) return;
  const auto enter = [&](const Point& point, double weight, std::int32_t sheet) {
    const double nearness = 1 - length(point - at) / reach;
    if (nearness > 0) parts.push_back({weight, nearness, index, sheet});
  };
  if (length(node.greatest - node.least) <= reach / (node.sheet >= 0 ? 4 : 8)) {
    enter(node.centroid, node.weight, node.sheet);
  } else if (node.right != 0) {
    find_parts(index + 1, at, reach, parts);
    find_parts(node.right, at, reach, parts);
  } else {
    for (std::uint32_t i = node.first; i < node.last; ++i) {
      enter(balls_[order_[i]].centre, weight_of_[order_[i]], sheet_of_[order_[i]]);
    }
  }
}

/// Distributes the amounts of nodes and of their ancestors to the sheets of their points.
void SheetsAround::distribute(std::uint32_t index, double per_weight, Given& given) const {
  const Node& node = nodes_[index];
  per_weight += given.nodes[index];
  if (node.sheet >= 0) {
    given.sheets[static_cast<std::size_t>(node.sheet)] += node.weight * per_weight;
  } else if (node.right != 0) {
    distribute(index + 1, per_weight, given);
    distribute(node.right, per_weight, given);
  } else {
    for (std::uint32_t i = node.first; i < node.last; ++i) {
      given.sheets[static_cast<std::size_t>(sheet_of_[order_[i]])] += weight_of_[order_[i]] * per_weight;
    }
  }
}

}  // namespace medial_vk
