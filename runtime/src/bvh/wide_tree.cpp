#include "bvh/wide_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

/// No more than x, by one or two steps of floats at most; without a branch, as a frame of a motion rounds many.
float rounded_down(double x) {
  constexpr float kStep = std::numeric_limits<float>::epsilon(), kLeast = std::numeric_limits<float>::min();
  const auto f = static_cast<float>(x);
  return f - (kStep * std::fabs(f) + kLeast);
}
float rounded_upwards(double x) { return -rounded_down(-x); }

double area_of(const BvhBox& box) {
  const Point s = box.upper - box.lower;
  return s[0] * s[1] + s[1] * s[2] + s[2] * s[0];
}

}  // namespace

/// The triangles below each node of the Bvh, by position.
struct WideTree::Ranges {
  explicit Ranges(const Bvh& bvh) : first(bvh.nodes().size()), count(bvh.nodes().size()) {
    for (std::size_t i = bvh.nodes().size(); i-- > 0;) {
      const BvhNode& node = bvh.nodes()[i];
      const bool is_leaf = node.count > 0;
      first[i] = is_leaf ? node.first : first[node.first];
      count[i] = is_leaf ? node.count : count[node.first] + count[node.first + 1];
    }
  }
  std::vector<std::uint32_t> first, count;
};

WideTree::WideTree(const Bvh& bvh, Bounds bounds) : has_disks_(bounds == Bounds::kBoxesAndDisks) {
  add_node(bvh, Ranges(bvh), 0);
  refit(bvh);
}

/// Divides the largest box first.
std::vector<std::uint32_t> WideTree::children_of(const Bvh& bvh, const Ranges& ranges, std::uint32_t origin) const {
  std::vector<std::uint32_t> children = {origin};
  const auto area = [&](std::uint32_t i) {
    const bool can_be_divided = bvh.nodes()[i].count == 0 && (i == origin || ranges.count[i] > kWidth);
    return can_be_divided ? area_of(bvh.nodes()[i].box) : -1.0;
  };
  while (children.size() < kWidth) {
    const auto largest = std::ranges::max_element(children, {}, area);
    if (area(*largest) < 0) break;
    const std::uint32_t first = bvh.nodes()[*largest].first;
    *largest = first;
    children.push_back(first + 1);
  }
  return children;
}

std::uint32_t WideTree::add_node(const Bvh& bvh, const Ranges& ranges, std::uint32_t origin) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  const std::vector<std::uint32_t> children = children_of(bvh, ranges, origin);
  nodes_[index].count = static_cast<std::uint32_t>(children.size());
  for (std::size_t k = 0; k < children.size(); ++k) {
    const std::uint32_t child = children[k];
    const bool is_block = ranges.count[child] <= kWidth || bvh.nodes()[child].count > 0;
    const std::uint32_t below =
        is_block ? add_blocks(ranges.first[child], ranges.count[child]) : add_node(bvh, ranges, child);
    nodes_[index].origin[k] = child;
    nodes_[index].first[k] = ranges.first[child];
    nodes_[index].triangles[k] = ranges.count[child];
    nodes_[index].below[k] = below;
  }
  return index;
}

std::uint32_t WideTree::add_blocks(std::uint32_t first, std::uint32_t count) {
  const auto index = static_cast<std::uint32_t>(blocks_.size());
  constexpr std::uint32_t kMost = kWidth;
  for (std::uint32_t done = 0; done < count; done += kMost) {
    blocks_.emplace_back();
    blocks_.back().first = first + done;
    blocks_.back().count = std::min(kMost, count - done);
    blocks_.back().is_last = count - done <= kMost;
  }
  return kBlock | index;
}

Point WideTree::scaled(const Point& p) const { return scale_ * (p - centre_); }

void WideTree::refit(const Bvh& bvh) {
  const BvhBox& whole = bvh.nodes().front().box;
  centre_ = 0.5 * (whole.lower + whole.upper);
  const double size = length(whole.upper - centre_);
  scale_ = size > 0 && std::isfinite(size) ? std::ldexp(1.0, -std::ilogb(size)) : 1;
  reach_ = scale_ * size;
  for (Node& node : nodes_) {
    for (std::size_t k = 0; k < kWidth; ++k) fit_box(bvh, node, k);
    for (std::size_t k = 0; has_disks_ && k < node.count; ++k) fit_disk(bvh, node, k);
  }
  for (Block& block : blocks_) {
    for (std::size_t k = 0; k < kWidth; ++k) {
      const auto& triangle = bvh.corners()[block.first + (k < block.count ? k : 0)];
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const Point p = scaled(triangle[corner]);
        for (std::size_t axis = 0; axis < 3; ++axis) block.corners[corner][axis][k] = static_cast<float>(p[axis]);
      }
    }
  }
}

void WideTree::fit_box(const Bvh& bvh, Node& node, std::size_t k) const {
  const BvhBox& box = bvh.nodes()[node.origin[k < node.count ? k : 0]].box;
  const Point lower = scaled(box.lower), upper = scaled(box.upper);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    node.lower[axis][k] = rounded_down(lower[axis]);
    node.upper[axis][k] = rounded_upwards(upper[axis]);
  }
}

/// The axis is the mean normal, and any direction would do.
void WideTree::fit_disk(const Bvh& bvh, Node& node, std::size_t k) const {
  constexpr double kMeaningful = 1e-100;  // the squares of shorter vectors may underflow
  const std::span triangles = std::span(bvh.corners()).subspan(node.first[k], node.triangles[k]);
  Point normal = {0, 0, 0}, middle, axis;
  for (const auto& [a, b, c] : triangles) normal = normal + cross(scale_ * (b - a), scale_ * (c - a));
  if (!(length(normal) > kMeaningful)) normal = {1, 0, 0};
  const double size = length(normal);
  for (std::size_t i = 0; i < 3; ++i) {
    node.axis[i][k] = static_cast<float>(normal[i] / size);
    axis[i] = node.axis[i][k];
    middle[i] = middle_of(node.lower[i][k], node.upper[i][k]);
  }
  double low = std::numeric_limits<double>::infinity(), high = -low, squared_radius = 0;
  for (const std::array<Point, 3>& triangle : triangles) {
    for (const Point& corner : triangle) {
      const Point offset = scaled(corner) - middle;
      const double height = dot(offset, axis);
      const Point across = offset - height * axis;
      low = std::min(low, height);
      high = std::max(high, height);
      squared_radius = std::max(squared_radius, dot(across, across));
    }
  }
  node.low[k] = rounded_down(low);
  node.high[k] = rounded_upwards(high);
  node.radius[k] = rounded_upwards(std::sqrt(squared_radius));
}

}  // namespace medial_vk
