// The arithmetic of binned SAH (Wald 2007): boxes, bins, and the best plane between them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace medial_vk {

/// Lower corner and negated upper corner, so that the growth of a box is six minima, which compilers vectorise.
using BuildBox = std::array<double, 6>;

constexpr int kBins = 16;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr BuildBox kEmptyBox = {kInfinity, kInfinity, kInfinity, kInfinity, kInfinity, kInfinity};

/// A triangle in the form that the builder uses.
struct BvhPrimitive {
  BuildBox box;
  std::uint32_t triangle = 0;

  double twice_centre(int axis) const { return box[axis] - box[axis + 3]; }
};

inline void grow(BuildBox& box, const BuildBox& other) {
  for (int k = 0; k < 6; ++k) box[k] = other[k] < box[k] ? other[k] : box[k];
}

inline void grow_by_centre(BuildBox& centres, const BvhPrimitive& primitive) {
  BuildBox centre;
  for (int k = 0; k < 3; ++k) {
    centre[k] = primitive.twice_centre(k);
    centre[k + 3] = -centre[k];
  }
  grow(centres, centre);
}

inline double extent(const BuildBox& box, int axis) { return -box[axis + 3] - box[axis]; }

inline double half_area(const BuildBox& box) {
  const double x = extent(box, 0), y = extent(box, 1), z = extent(box, 2);
  return x < 0 ? 0.0 : x * y + y * z + z * x;
}

struct Bin {
  BuildBox box = kEmptyBox;
  std::uint32_t count = 0;

  void add(const Bin& other) {
    grow(box, other.box);
    count += other.count;
  }
};

/// Maps a doubled centre to its bin along one axis; kBins slices of the range of the doubled centres.
struct Binning {
  double lower = 0;
  double scale = 0;  // 0: the centres do not differ along this axis

  Binning() = default;
  Binning(const BuildBox& centres, int axis) : lower(centres[axis]) {
    // A subnormal extent would make the scale infinite; such an axis is useless for a split.
    const double range = extent(centres, axis);
    if (range > std::numeric_limits<double>::min() * kBins) scale = kBins / range;
  }
  int operator()(double twice_centre) const {
    return std::min(kBins - 1, static_cast<int>((twice_centre - lower) * scale));
  }
};

struct BuildBins {
  std::array<std::array<Bin, kBins>, 3> axes;

  void add(const BuildBins& other) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = 0; i < kBins; ++i) axes[axis][i].add(other.axes[axis][i]);
    }
  }
};

/// The plane between bins of least SAH cost, if there is one.
class BuildPlane {
 public:
  BuildPlane(const BuildBox& centres, const BuildBins& bins) {
    for (int axis = 0; axis < 3; ++axis) {
      if (Binning(centres, axis).scale > 0) consider_axis(bins.axes[axis], axis);
    }
    if (exists()) binning_ = Binning(centres, axis_);
  }
  bool exists() const { return axis_ >= 0; }
  bool goes_left(const BvhPrimitive& p) const { return binning_(p.twice_centre(axis_)) <= last_left_; }
  std::uint32_t count_left(const BuildBins& bins) const {
    std::uint32_t count = 0;
    for (int i = 0; i <= last_left_; ++i) count += bins.axes[axis_][i].count;
    return count;
  }

 private:
  /// The first plane wins a tie.
  void consider_axis(const std::array<Bin, kBins>& bins, int axis) {
    std::array<double, kBins> right_cost{};
    Bin sum;
    for (int i = kBins - 1; i > 0; --i) {
      sum.add(bins[i]);
      right_cost[i] = sum.count == 0 ? kInfinity : half_area(sum.box) * sum.count;
    }
    sum = Bin{};
    for (int i = 0; i + 1 < kBins; ++i) {
      sum.add(bins[i]);
      if (sum.count == 0) continue;
      const double cost = half_area(sum.box) * sum.count + right_cost[i + 1];
      if (cost >= cost_) continue;
      cost_ = cost;
      axis_ = axis;
      last_left_ = i;
    }
  }

  double cost_ = kInfinity;
  int axis_ = -1;
  int last_left_ = 0;
  Binning binning_;
};

}  // namespace medial_vk
