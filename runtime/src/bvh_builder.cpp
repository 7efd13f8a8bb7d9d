#include "bvh_builder.h"

#include <algorithm>
#include <array>
#include <limits>
#include <thread>

#include "point_math.h"

namespace medial_vk {
namespace {

constexpr int kBins = 16;
constexpr std::uint32_t kParallelFrom = 4096;  // below this a thread costs more than it saves
constexpr double kInfinity = std::numeric_limits<double>::infinity();

constexpr BvhBox empty_box() { return {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}}; }

void grow(BvhBox& box, const BvhBox& other) {
  box.lower = least(box.lower, other.lower);
  box.upper = greatest(box.upper, other.upper);
}

double half_area(const BvhBox& box) {
  const Point d = box.upper - box.lower;
  return d[0] < 0 ? 0.0 : d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
}

struct Bin {
  BvhBox box = empty_box();
  std::uint32_t count = 0;
};

/// Maps a doubled centre to its bin along one axis; kBins slices of the range of the doubled centres.
struct Binning {
  double lower = 0;
  double scale = 0;  // 0: the centres do not differ along this axis

  Binning() = default;
  Binning(const BvhBox& centres, int axis) : lower(centres.lower[axis]) {
    const double extent = centres.upper[axis] - lower;
    // A subnormal extent would make the scale infinite; such an axis is of no use anyway.
    if (extent > std::numeric_limits<double>::min() * kBins) scale = kBins / extent;
  }
  int operator()(double twice_centre) const {
    return std::min(kBins - 1, static_cast<int>((twice_centre - lower) * scale));
  }
};

struct Split {
  double cost = kInfinity;
  int axis = -1;
  int last_left = 0;
};

/// Least SAH cost over the planes between the bins of one axis; the first plane wins a tie.
void consider_axis(const std::array<Bin, kBins>& bins, int axis, Split& best) {
  std::array<double, kBins> right_cost{};
  Bin sum;
  for (int i = kBins - 1; i > 0; --i) {
    grow(sum.box, bins[i].box);
    sum.count += bins[i].count;
    right_cost[i] = sum.count == 0 ? kInfinity : half_area(sum.box) * sum.count;
  }
  sum = Bin{};
  for (int i = 0; i + 1 < kBins; ++i) {
    grow(sum.box, bins[i].box);
    sum.count += bins[i].count;
    if (sum.count == 0) continue;
    const double cost = half_area(sum.box) * sum.count + right_cost[i + 1];
    if (cost < best.cost) best = {cost, axis, i};
  }
}

}  // namespace

BvhBuilder::BvhBuilder(std::vector<BvhPrimitive>& primitives, std::uint32_t leaf_size, unsigned threads)
    : primitives_(primitives), leaf_size_(leaf_size), threads_(threads) {}

std::vector<BvhNode> BvhBuilder::build() {
  const auto count = static_cast<std::uint32_t>(primitives_.size());
  sparse_.resize(2 * static_cast<std::size_t>(count));
  build_subtree(0, 1, {0, count}, 0, threads_);
  return compact();
}

// A subtree's place in sparse_ depends on triangle counts alone, so threads neither meet nor influence the result.
void BvhBuilder::build_subtree(std::uint32_t node, std::uint32_t room, Range range, std::uint32_t depth,
                               unsigned threads) {
  BvhBox box = empty_box();
  BvhBox centres = empty_box();
  for (std::uint32_t i = range.begin; i < range.end; ++i) {
    const BvhBox& b = primitives_[i].box;
    grow(box, b);
    const Point centre = b.lower + b.upper;
    grow(centres, {centre, centre});
  }
  sparse_[node].box = box;
  if (range.count() <= leaf_size_) {
    make_leaf(sparse_[node], range);
    return;
  }
  const std::uint32_t middle = split(range, centres, depth);
  sparse_[node].first = room;
  sparse_[node].count = 0;
  const Range left{range.begin, middle};
  const Range right{middle, range.end};
  const std::uint32_t left_room = room + 2;
  const std::uint32_t right_room = left_room + 2 * left.count() - 2;
  if (threads > 1 && range.count() >= kParallelFrom) {
    std::thread other([&] { build_subtree(room, left_room, left, depth + 1, threads / 2); });
    build_subtree(room + 1, right_room, right, depth + 1, threads - threads / 2);
    other.join();
  } else {
    build_subtree(room, left_room, left, depth + 1, 1);
    build_subtree(room + 1, right_room, right, depth + 1, 1);
  }
}

void BvhBuilder::make_leaf(BvhNode& node, Range range) {
  node.first = range.begin;
  node.count = range.count();
  std::sort(primitives_.begin() + range.begin, primitives_.begin() + range.end,
            [](const BvhPrimitive& a, const BvhPrimitive& b) { return a.triangle < b.triangle; });
}

/// Levels below a node of `count` triangles if every split halves it.
std::uint32_t BvhBuilder::levels_of_halving(std::uint32_t count) const {
  std::uint32_t levels = 0;
  for (std::uint64_t room = leaf_size_; room < count; room *= 2) ++levels;
  return levels;
}

std::uint32_t BvhBuilder::split(Range range, const BvhBox& centres, std::uint32_t depth) {
  // SAH may peel off a few triangles at a time; when the depth runs out only halving still fits.
  if (depth + 1 + levels_of_halving(range.count()) >= Bvh::kMaxDepth) return split_at_median(range, centres);
  const std::array<Binning, 3> binning = {Binning(centres, 0), Binning(centres, 1), Binning(centres, 2)};
  std::array<std::array<Bin, kBins>, 3> bins;
  for (std::uint32_t i = range.begin; i < range.end; ++i) {
    const BvhPrimitive& primitive = primitives_[i];
    for (int axis = 0; axis < 3; ++axis) {
      Bin& bin = bins[axis][binning[axis](primitive.twice_centre(axis))];
      grow(bin.box, primitive.box);
      ++bin.count;
    }
  }
  Split best;
  for (int axis = 0; axis < 3; ++axis) {
    if (binning[axis].scale > 0) consider_axis(bins[axis], axis, best);
  }
  if (best.axis < 0) return split_at_median(range, centres);
  const Binning chosen = binning[best.axis];
  const auto middle =
      std::partition(primitives_.begin() + range.begin, primitives_.begin() + range.end,
                     [&](const BvhPrimitive& p) { return chosen(p.twice_centre(best.axis)) <= best.last_left; });
  return static_cast<std::uint32_t>(middle - primitives_.begin());
}

std::uint32_t BvhBuilder::split_at_median(Range range, const BvhBox& centres) {
  const Point extent = centres.upper - centres.lower;
  const int axis = static_cast<int>(std::max_element(extent.begin(), extent.end()) - extent.begin());
  const std::uint32_t middle = range.begin + range.count() / 2;
  std::nth_element(primitives_.begin() + range.begin, primitives_.begin() + middle, primitives_.begin() + range.end,
                   [axis](const BvhPrimitive& a, const BvhPrimitive& b) {
                     const double ca = a.twice_centre(axis);
                     const double cb = b.twice_centre(axis);
                     return ca != cb ? ca < cb : a.triangle < b.triangle;
                   });
  return middle;
}

/// The nodes in use, in depth-first order of sibling pairs.
std::vector<BvhNode> BvhBuilder::compact() const {
  std::vector<BvhNode> nodes;
  nodes.reserve(sparse_.size() / std::max(1u, leaf_size_ / 2) + 1);
  nodes.push_back(sparse_[0]);
  std::vector<std::uint32_t> pending = {0};
  while (!pending.empty()) {
    const std::uint32_t parent = pending.back();
    pending.pop_back();
    if (nodes[parent].count != 0) continue;
    const std::uint32_t old_first = nodes[parent].first;
    const auto first = static_cast<std::uint32_t>(nodes.size());
    nodes[parent].first = first;
    nodes.push_back(sparse_[old_first]);
    nodes.push_back(sparse_[old_first + 1]);
    pending.push_back(first + 1);
    pending.push_back(first);
  }
  return nodes;
}

}  // namespace medial_vk
