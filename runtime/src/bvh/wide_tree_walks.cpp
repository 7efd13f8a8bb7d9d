// Walks through the tree with eight children a node, and their error bounds.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

#include "base/eight_floats.h"
#include "base/point_ops.h"
#include "bvh/nearby_triangles.h"
#include "bvh/wide_tree.h"

namespace medial_vk {
namespace {

using EightPoints = std::array<EightFloats, 3>;

MEDIAL_VK_INLINE EightFloats product(const EightPoints& a, const EightPoints& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
MEDIAL_VK_INLINE EightPoints sum(const EightPoints& a, const EightPoints& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
MEDIAL_VK_INLINE EightPoints difference(const EightPoints& a, const EightPoints& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
/// a + t b
MEDIAL_VK_INLINE EightPoints along(const EightPoints& a, const EightFloats& t, const EightPoints& b) {
  return {a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]};
}

/// Makes the point a + t b the nearest one to the origin, where it is nearer.
MEDIAL_VK_INLINE void improve(EightPoints& nearest, EightFloats& squared, const EightPoints& point) {
  const EightFloats squared_distance = product(point, point);
  const EightInts is_nearer = squared_distance < squared;
  squared = select(is_nearer, squared_distance, squared);
  for (std::size_t axis = 0; axis < 3; ++axis) nearest[axis] = select(is_nearer, point[axis], nearest[axis]);
}

}  // namespace

/// Lengths are in the tree's units; u = 2^-24, and `far` bounds every length below. The query, a corner and their
/// difference are rounded, each by up to u far in each coordinate: a difference has an error of less than 6 u far.
///
/// A box: its distance is computed with that error and four roundings. A triangle: let s be any vector. The triangle is
/// no closer than the least product of s / |s| with a corner less 6 u far; the product has an error of 4 u far. With
/// the nearest point of the triangle for s, the least product is its distance, so that few triangles beyond the bound
/// are left.
///
/// A disk with the axis n. Let m be the middle of the box, in float, by the same operations as in fit_disk(), and let
/// P(v) = v - (n.v) n. P and the product with n are linear, and x - q = (x - m) + (m - q) for a point x of the surface
/// and the query q. So n.(x - q) is at least n.(m - q) + low and at most n.(m - q) + high, and |P(x - q)| is at least
/// |P(m - q)| less the radius. n.(m - q) + low and the like have an error of 10 u far (4 of m - q, 3 of the sum, 1 of
/// low or high, 2 as |n| = 1 up to 2 u), |P(m - q)| less the radius one of 16 u far (4, 6 by the product, 3 of the sum,
/// 3 of length and radius). (n.v)^2 + |P(v)|^2 is |v|^2 up to 4 u of it, so the distance has an error of less than
/// sqrt(10^2 + 16^2) + 3 < 22 u far.
///
/// All are passed over only if the computed distance is above the bound by 32 u far and a share of 2^-20, which also
/// holds the roundings of squares and of their quotient.
class WideTree::Walk {
 protected:
  Walk(const WideTree& tree, const Point& p, double far) : tree_(tree), slack_(static_cast<float>(0x1p-19 * far)) {
    const Point query = tree.scaled(p);
    for (std::size_t axis = 0; axis < 3; ++axis) query_[axis] = static_cast<float>(query[axis]);
  }

  void set_limit(double squared_distance) {
    const double bound = tree_.scale_ * std::sqrt(squared_distance);
    const float limit = static_cast<float>(std::min(bound, 0x1p50)) * (1 + 0x1p-20f) + slack_;
    squared_limit_ = limit * limit * (1 + 0x1p-20f);
  }

  /// Squared distances of the children, and a bit for each that is not known to be beyond the limit.
  MEDIAL_VK_INLINE std::uint32_t near_children(const Node& node, std::array<float, kWidth>& distances) const {
    EightFloats squared = squared_to_boxes(node);
    if (tree_.has_disks_) squared = greater(squared, squared_to_disks(node));
    distances = stored(squared);
    return bits_of(squared <= squared_limit_) & ((1u << node.count) - 1);
  }

  MEDIAL_VK_INLINE EightFloats squared_to_boxes(const Node& node) const {
    EightFloats squared = {};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const EightFloats outside = greater(load(node.lower[axis]) - query_[axis], query_[axis] - load(node.upper[axis]));
      const EightFloats beyond = greater(outside, EightFloats{});
      squared += beyond * beyond;
    }
    return squared;
  }

  MEDIAL_VK_INLINE EightFloats squared_to_disks(const Node& node) const {
    EightPoints axis, middle;
    for (std::size_t i = 0; i < 3; ++i) {
      axis[i] = load(node.axis[i]);
      middle[i] = middle_of(load(node.lower[i]), load(node.upper[i])) - query_[i];
    }
    const EightFloats zero = {}, height = product(middle, axis);
    const EightFloats above = greater(greater(height + load(node.low), -(height + load(node.high))), zero);
    const EightPoints across = along(middle, -height, axis);
    const EightFloats beside = greater(square_root(product(across, across)) - load(node.radius), zero);
    return above * above + beside * beside;
  }

  struct Corners {
    EightPoints a, b, c;  // from the query
  };

  /// A bit for each triangle that is not known to be beyond the limit, and what is known of its squared distance. The
  /// sum of the corners for s excludes most triangles, and the nearest point nearly all others.
  MEDIAL_VK_INLINE std::uint32_t near_triangles(const Block& block, std::array<float, kWidth>& bounds) const {
    Corners corners;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      corners.a[axis] = load(block.corners[0][axis]) - query_[axis];
      corners.b[axis] = load(block.corners[1][axis]) - query_[axis];
      corners.c[axis] = load(block.corners[2][axis]) - query_[axis];
    }
    const std::uint32_t used = (1u << block.count) - 1;
    const EightFloats first = squared_bound(corners, sum(sum(corners.a, corners.b), corners.c));
    if ((bits_of(first <= squared_limit_) & used) == 0) return 0;
    const EightFloats squared = greater(first, squared_bound(corners, nearest_point(corners)));
    bounds = stored(squared);
    return bits_of(squared <= squared_limit_) & used;
  }

  /// The points of the triangles nearest to the query, nearly: of the three edges, and on the plane.
  static MEDIAL_VK_INLINE EightPoints nearest_point(const Corners& corners) {
    const EightPoints ab = difference(corners.b, corners.a), ac = difference(corners.c, corners.a);
    const EightPoints bc = difference(corners.c, corners.b);
    const EightFloats ab_ab = product(ab, ab), ab_ac = product(ab, ac), ac_ac = product(ac, ac);
    const EightFloats to_ab = -product(corners.a, ab), to_ac = -product(corners.a, ac);
    EightPoints nearest = along(corners.a, share(to_ab, ab_ab), ab);
    EightFloats squared = product(nearest, nearest);
    improve(nearest, squared, along(corners.a, share(to_ac, ac_ac), ac));
    improve(nearest, squared, along(corners.b, share(-product(corners.b, bc), product(bc, bc)), bc));
    const EightFloats v = ac_ac * to_ab - ab_ac * to_ac, w = ab_ab * to_ac - ab_ac * to_ab;
    const EightFloats whole = ab_ab * ac_ac - ab_ac * ab_ac;
    const EightInts is_inside = (whole > 0.0f) & (v >= 0.0f) & (w >= 0.0f) & (v + w <= whole);
    const EightFloats inverse = select(is_inside, 1.0f / whole, EightFloats{});
    improve(nearest, squared, along(along(corners.a, v * inverse, ab), w * inverse, ac));
    return nearest;
  }

  /// part / whole from 0 to 1; 0 of a whole of 0.
  static MEDIAL_VK_INLINE EightFloats share(const EightFloats& part, const EightFloats& whole) {
    const EightFloats zero = {}, one = zero + 1.0f;
    const EightFloats inner = select((part > 0.0f) & (part < whole), part / whole, zero);
    return select((part >= whole) & (whole > 0.0f), one, inner);
  }

  /// Of the distance of each triangle, by the vector s; 0 where it says nothing.
  static MEDIAL_VK_INLINE EightFloats squared_bound(const Corners& corners, const EightPoints& s) {
    constexpr float kMeaningful = 1e-20f;  // squares of shorter vectors may underflow
    const EightFloats least = lesser(product(s, corners.a), lesser(product(s, corners.b), product(s, corners.c)));
    const EightFloats s_s = product(s, s);
    return select((least > 0.0f) & (s_s > kMeaningful), least / s_s * least, EightFloats{});
  }

  const WideTree& tree_;
  std::array<float, 3> query_;
  float slack_, squared_limit_ = 0;
};

/// Nearer boxes first; each nearer triangle shortens the limit.
class WideTree::NearestWalk : private Walk {
 public:
  NearestWalk(const WideTree& tree, const Bvh& bvh, const Point& p, BvhHit& best, double far)
      : Walk(tree, p, far), bvh_(bvh), p_(p), best_(best) {
    set_limit(best_.squared_distance);
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

  /// The nearest child is the last.
  MEDIAL_VK_INLINE void push_children(const Node& node, std::array<Pending, kMostPending>& pending,
                                      std::size_t& count) const {
    std::array<float, kWidth> distances;
    std::uint32_t near = near_children(node, distances);
    const std::size_t begin = count;
    for (; near != 0; near &= near - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(near));
      std::size_t at = count++;
      for (; at > begin && pending[at - 1].squared_distance < distances[k]; --at) pending[at] = pending[at - 1];
      pending[at] = {node.below[k], distances[k]};
      fetch(node.below[k]);
    }
  }

  /// Most of a walk through a large tree is spent waiting for memory.
  MEDIAL_VK_INLINE void fetch(std::uint32_t below) const {
    constexpr std::size_t kCacheLine = 64, kBytes = 448;  // what a walk reads of a node
    static_assert(kBytes <= sizeof(Node));
    const auto* at = (below & kBlock) != 0
                         ? reinterpret_cast<const std::byte*>(tree_.blocks_.data() + (below & ~kBlock))
                         : reinterpret_cast<const std::byte*>(tree_.nodes_.data() + below);
    const std::size_t bytes = (below & kBlock) != 0 ? sizeof(Block) : kBytes;
    for (std::size_t i = 0; i < bytes; i += kCacheLine) __builtin_prefetch(at + i);
  }

  MEDIAL_VK_INLINE void test_blocks(std::uint32_t index) {
    for (bool is_last = false; !is_last; ++index) {
      const Block& block = tree_.blocks_[index];
      is_last = block.is_last;
      std::array<float, kWidth> bounds;
      for (std::uint32_t near = near_triangles(block, bounds); near != 0; near &= near - 1) {
        const auto k = static_cast<std::uint32_t>(std::countr_zero(near));
        if (bounds[k] > squared_limit_) continue;
        const double before = best_.squared_distance;
        improve_hit(bvh_, p_, block.first + k, best_);
        if (best_.squared_distance < before) set_limit(best_.squared_distance);
      }
    }
  }

  const Bvh& bvh_;
  const Point& p_;
  BvhHit& best_;
};

/// All triangles that are not known to be beyond the limit, as long as there is room.
class WideTree::GatheringWalk : private Walk {
 public:
  GatheringWalk(const WideTree& tree, const Point& p, double radius, std::span<std::uint32_t> positions, double far)
      : Walk(tree, p, far), positions_(positions) {
    set_limit(radius * radius);
  }

  /// The number of triangles, or more than there is room for.
  MEDIAL_VK_INLINE std::size_t operator()() {
    std::array<std::uint32_t, kMostPending> pending;
    std::size_t count = 0, found = 0;
    pending[count++] = 0;
    while (count > 0 && found <= positions_.size()) {
      const std::uint32_t next = pending[--count];
      if ((next & kBlock) != 0) {
        take_blocks(next & ~kBlock, found);
        continue;
      }
      const Node& node = tree_.nodes_[next];
      std::array<float, kWidth> distances;
      for (std::uint32_t near = near_children(node, distances); near != 0; near &= near - 1) {
        pending[count++] = node.below[static_cast<std::size_t>(std::countr_zero(near))];
      }
    }
    return found;
  }

 private:
  MEDIAL_VK_INLINE void take_blocks(std::uint32_t index, std::size_t& found) const {
    for (bool is_last = false; !is_last; ++index) {
      const Block& block = tree_.blocks_[index];
      is_last = block.is_last;
      std::array<float, kWidth> bounds;
      for (std::uint32_t near = near_triangles(block, bounds); near != 0; near &= near - 1) {
        if (found < positions_.size())
          positions_[found] = block.first + static_cast<std::uint32_t>(std::countr_zero(near));
        ++found;
      }
    }
  }

  std::span<std::uint32_t> positions_;
};

BvhHit WideTree::closest(const Bvh& bvh, const Point& p, double bound) const {
  const double far = reach_ + length(scaled(p));
  if (!(far < 0x1p40)) return bvh.closest(p, bound);  // products of squares of such lengths overflow
  BvhHit best;
  best.squared_distance = bound > 0 ? bound * bound : 0.0;
  NearestWalk walk(*this, bvh, p, best, far);
  run_on_this_processor(walk);
  if (best.triangle == BvhHit().triangle) best.squared_distance = std::numeric_limits<double>::infinity();
  return best;
}

std::optional<std::size_t> WideTree::gather(const Point& p, double radius, std::span<std::uint32_t> positions) const {
  const double far = reach_ + length(scaled(p));
  if (!(far < 0x1p40)) return std::nullopt;
  GatheringWalk walk(*this, p, radius, positions, far);
  const std::size_t found = run_on_this_processor(walk);
  return found <= positions.size() ? std::optional(found) : std::nullopt;
}

}  // namespace medial_vk
