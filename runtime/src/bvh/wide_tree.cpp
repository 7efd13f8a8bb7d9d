#include "bvh/wide_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/eight_floats.h"
#include "base/point_ops.h"
#include "bvh/nearby_triangles.h"

namespace medial_vk {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

float rounded_down(double x) {
  const auto f = static_cast<float>(x);
  return f > x ? std::nextafter(f, -kInfinity) : f;
}
float rounded_upwards(double x) { return -rounded_down(-x); }

double area_of(const BvhBox& box) {
  const Point s = box.upper - box.lower;
  return s[0] * s[1] + s[1] * s[2] + s[2] * s[0];
}

using EightPoints = std::array<EightFloats, 3>;

MEDIAL_VK_INLINE EightFloats product(const EightPoints& a, const EightPoints& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
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

WideTree::WideTree(const Bvh& bvh) {
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
    for (std::size_t k = 0; k < kWidth; ++k) {
      const BvhBox& box = bvh.nodes()[node.origin[k < node.count ? k : 0]].box;
      const Point lower = scaled(box.lower), upper = scaled(box.upper);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        node.lower[axis][k] = rounded_down(lower[axis]);
        node.upper[axis][k] = rounded_upwards(upper[axis]);
      }
    }
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

/// Lengths are in the tree's units; u = 2^-24, and `far` bounds every length below. The query, a corner and their
/// difference are rounded, each by up to u far in each coordinate: a difference has an error of less than 6 u far.
///
/// A box: its distance is computed with that error and four roundings. A triangle: let s be any vector. The triangle is
/// no closer than the least product of s / |s| with a corner less 6 u far; the product has an error of 4 u far. Both
/// are passed over only if the computed distance is above the bound by 16 u far and a share of 2^-20, which also holds
/// the roundings of the squares that are compared.
class WideTree::Walk {
 public:
  Walk(const WideTree& tree, const Bvh& bvh, const Point& p, BvhHit& best, double far)
      : tree_(tree), bvh_(bvh), p_(p), best_(best), slack_(static_cast<float>(0x1p-20 * far)) {
    const Point query = tree.scaled(p);
    for (std::size_t axis = 0; axis < 3; ++axis) query_[axis] = static_cast<float>(query[axis]);
    shorten();
  }

  MEDIAL_VK_INLINE void operator()() {
    std::array<Pending, kMostPending> pending;
    std::size_t count = 0;
    pending[count++] = {0, 0};
    while (count > 0) {
      const Pending next = pending[--count];
      if (next.squared_distance > squared_limit_) continue;
      if ((next.below & kBlock) != 0) {
        test_blocks(next.below & ~kBlock);
      } else {
        push_children(tree_.nodes_[next.below], pending, count);
      }
    }
  }

 private:
  struct Pending {
    std::uint32_t below;
    float squared_distance;
  };

  void shorten() {
    const double bound = tree_.scale_ * std::sqrt(best_.squared_distance);
    const float limit = static_cast<float>(std::min(bound, 0x1p50)) * (1 + 0x1p-20f) + slack_;
    squared_limit_ = limit * limit * (1 + 0x1p-20f);
  }

  /// The nearest child is the last.
  MEDIAL_VK_INLINE void push_children(const Node& node, std::array<Pending, kMostPending>& pending,
                                      std::size_t& count) const {
    EightFloats squared = {};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const EightFloats outside = greater(load(node.lower[axis]) - query_[axis], query_[axis] - load(node.upper[axis]));
      const EightFloats beyond = greater(outside, EightFloats{});
      squared += beyond * beyond;
    }
    const std::array<float, kWidth> distances = stored(squared);
    const std::size_t begin = count;
    std::uint32_t near = bits_of(squared <= squared_limit_) & ((1u << node.count) - 1);
    for (; near != 0; near &= near - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(near));
      std::size_t at = count++;
      for (; at > begin && pending[at - 1].squared_distance < distances[k]; --at) pending[at] = pending[at - 1];
      pending[at] = {node.below[k], distances[k]};
    }
  }

  MEDIAL_VK_INLINE void test_blocks(std::uint32_t index) {
    for (bool is_last = false; !is_last; ++index) {
      const Block& block = tree_.blocks_[index];
      is_last = block.is_last;
      const double before = best_.squared_distance;
      for (std::uint32_t near = near_triangles(block); near != 0; near &= near - 1) {
        improve_hit(bvh_, p_, block.first + static_cast<std::uint32_t>(std::countr_zero(near)), best_);
      }
      if (best_.squared_distance < before) shorten();
    }
  }

  /// A bit for each triangle that is not known to be beyond the limit. For s it takes the sum of the corners.
  MEDIAL_VK_INLINE std::uint32_t near_triangles(const Block& block) const {
    constexpr float kMeaningful = 1e-20f;  // squares of shorter vectors may underflow
    std::array<EightPoints, 3> corners;
    EightPoints s = {};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        corners[corner][axis] = load(block.corners[corner][axis]) - query_[axis];
        s[axis] += corners[corner][axis];
      }
    }
    const EightFloats least = lesser(product(s, corners[0]), lesser(product(s, corners[1]), product(s, corners[2])));
    const EightFloats s_s = product(s, s);
    const EightInts is_beyond = (least > 0.0f) & (s_s > kMeaningful) & (least * least > squared_limit_ * s_s);
    return ~bits_of(is_beyond) & ((1u << block.count) - 1);
  }

  const WideTree& tree_;
  const Bvh& bvh_;
  const Point& p_;
  BvhHit& best_;
  std::array<float, 3> query_;
  float slack_, squared_limit_ = 0;
};

BvhHit WideTree::closest(const Bvh& bvh, const Point& p, double bound) const {
  const double far = reach_ + length(scaled(p));
  if (!(far < 0x1p40)) return bvh.closest(p, bound);  // products of squares of such lengths overflow
  BvhHit best;
  best.squared_distance = bound > 0 ? bound * bound : 0.0;
  Walk walk(*this, bvh, p, best, far);
  run_on_this_processor(walk);
  if (best.triangle == BvhHit().triangle) best.squared_distance = std::numeric_limits<double>::infinity();
  return best;
}

}  // namespace medial_vk
