#include "sphere_fits/steps/symmetric_difference.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

/// Along the longest side of the solid, and along others at least.
constexpr std::size_t kLines = 160, kLeastLines = 32;

using Stretch = SolidLines::Stretch;

double overlap(const Stretch& a, const Stretch& b) {
  return std::max(0.0, std::min(a.to, b.to) - std::max(a.from, b.from));
}

/// The number, or 0 where it is negative, without a jump that the processor cannot foresee.
template <class Float>
Float positive(Float number) {
  return Float{0.5} * (number + std::fabs(number));
}

/// Numbers of lines or rows.
struct Numbers {
  std::ptrdiff_t begin = 0, end = 0;
  std::ptrdiff_t count() const { return end - begin; }
};

/// Of the lines less than `radius` away from `middle` in one direction.
Numbers numbers_around(const SolidLines::Bundle& bundle, std::size_t k, double middle, double radius) {
  if (!(radius > 0)) return {};
  const auto number = [&](double at) {
    return static_cast<std::ptrdiff_t>(std::ceil((at - bundle.first[k]) / bundle.spacing[k]));
  };
  return {number(middle - radius), number(middle + radius)};
}

/// The smallest range that holds both, of which either may be empty.
Numbers hull(const Numbers& a, const Numbers& b) {
  if (a.count() <= 0) return b;
  if (b.count() <= 0) return a;
  return {std::min(a.begin, b.begin), std::max(a.end, b.end)};
}

/// Lines next to each other, and where they meet both spheres: at their upper ends in both balls, at their lower ends,
/// or at any.
enum class Ends { kAll, kLower, kUpper };
struct Block {
  Numbers columns, rows;
  Ends ends;
};

/// The numbers that are no farther than `half` from `middle`, for any rounding of either.
struct Side {
  double middle, half;
  double nearest(double from) const { return positive(std::fabs(from - middle) - half); }
  double farthest(double from) const { return std::fabs(from - middle) + half; }
};
Side side_of(double least, double greatest) {
  constexpr double kRounding = 0x1p-50;
  return {0.5 * (least + greatest), 0.5 * (greatest - least) + kRounding * (std::fabs(least) + std::fabs(greatest))};
}

}  // namespace

/// Along one axis. Balls have their coordinates in the order of the bundle: those across it, then that along it.
class SymmetricDifference::Walk {
 public:
  Walk(const SolidLines::Bundle& bundle, std::size_t axis, const Ball& from, const Ball& to,
       std::span<const Ball> others, Scratch& scratch)
      : bundle_(bundle), axes_{bundle.across[0], bundle.across[1], axis}, scratch_(scratch) {
    from_ = turned(from);
    to_ = turned(to);
    const double reach = length(to.centre - from.centre) + from.radius + to.radius;
    scratch_.others.clear();
    for (const Ball& other : others) scratch_.others.push_back(turned(other));
    round_others(reach);
  }

  /// The sum of lengths over all lines.
  double sum() {
    const auto numbers = [&](std::size_t k) {
      return hull(numbers_around(bundle_, k, from_.centre[k], from_.radius),
                  numbers_around(bundle_, k, to_.centre[k], to_.radius));
    };
    const Numbers columns = numbers(0), rows = numbers(1);
    double sum = 0;
    for (std::ptrdiff_t j = rows.begin; j < rows.end; j += kSide) {
      for (std::ptrdiff_t i = columns.begin; i < columns.end; i += kSide) {
        sum += sum_of({{i, std::min(i + kSide, columns.end)}, {j, std::min(j + kSide, rows.end)}, Ends::kAll});
      }
    }
    return sum;
  }

 private:
  static constexpr std::ptrdiff_t kSide = 4;

  Ball turned(const Ball& ball) const {
    return {{ball.centre[axes_[0]], ball.centre[axes_[1]], ball.centre[axes_[2]]}, ball.radius};
  }

  /// To float, relative to the centre of from_. Blocks lie within `reach` of it. Centres and blocks, and their
  /// differences and sums, are rounded by 4 · 2^-24 of M, the distance of the centre plus the reach, in each
  /// coordinate: squares of distances are rounded by less than 2^-18 M^2.
  void round_others(double reach) {
    const std::size_t count = scratch_.others.size();
    for (std::vector<float>* each :
         {&scratch_.x, &scratch_.y, &scratch_.z, &scratch_.least, &scratch_.greatest, &scratch_.near, &scratch_.far}) {
      each->resize(count);
    }
    for (std::size_t k = 0; k < count; ++k) {
      const Ball& other = scratch_.others[k];
      const Point apart = other.centre - from_.centre;
      const double most = length(apart) + reach, error = 0x1p-18 * most * most, squared = other.radius * other.radius;
      scratch_.x[k] = static_cast<float>(apart[0]);
      scratch_.y[k] = static_cast<float>(apart[1]);
      scratch_.z[k] = static_cast<float>(apart[2]);
      scratch_.least[k] = static_cast<float>(squared - error);
      scratch_.greatest[k] = static_cast<float>(squared + error);
    }
  }

  /// Half the length of the part of the line in the ball, squared; not positive: they do not meet. The rounded result
  /// never increases with either distance of the line from the centre.
  static double half_squared(const Ball& ball, double x_off, double y_off) {
    return (ball.radius * ball.radius - y_off * y_off) - x_off * x_off;
  }
  static double half_squared_at(const Ball& ball, double x, double y) {
    return half_squared(ball, x - ball.centre[0], y - ball.centre[1]);
  }

  /// Half-lengths of the lines of a block in a ball: of those that meet it, and the least is 0 if some do not. Both are
  /// 0 if none does.
  struct Halves {
    double least, greatest;
  };
  static Halves halves(const Ball& ball, const Side& x, const Side& y) {
    const double cx = ball.centre[0], cy = ball.centre[1];
    return {std::sqrt(positive(half_squared(ball, x.farthest(cx), y.farthest(cy)))),
            std::sqrt(positive(half_squared(ball, x.nearest(cx), y.nearest(cy))))};
  }

  using Box = std::array<Side, 3>;

  /// The change on the lines of the block. Its two sides are examined apart where all of them meet both balls.
  double sum_of(Block block) {
    Box box;
    box[0] = side_of(bundle_.at(0, block.columns.begin), bundle_.at(0, block.columns.end - 1));
    box[1] = side_of(bundle_.at(1, block.rows.begin), bundle_.at(1, block.rows.end - 1));
    const Halves before = halves(from_, box[0], box[1]), after = halves(to_, box[0], box[1]);
    if (!(before.greatest > 0 || after.greatest > 0)) return 0;
    const double a = from_.centre[2], b = to_.centre[2];
    if (before.least > 0 && after.least > 0) {
      double sum = 0;
      box[2] = side_of(std::min(a - before.greatest, b - after.greatest), std::max(a - before.least, b - after.least));
      block.ends = Ends::kLower;
      if (find_met(box, hiders_[0])) sum += sum_of_lines(block);
      box[2] = side_of(std::min(a + before.least, b + after.least), std::max(a + before.greatest, b + after.greatest));
      block.ends = Ends::kUpper;
      if (find_met(box, hiders_[1])) sum += sum_of_lines(block);
      return sum;
    }
    box[2] =
        side_of(std::min(a - before.greatest, b - after.greatest), std::max(a + before.greatest, b + after.greatest));
    return find_met(box, hiders_[0]) ? sum_of_lines(block) : 0;
  }

  /// Finds the others that meet the box. False if one of them holds all of it, mostly that of number `hider`, which
  /// held the last one.
  bool find_met(const Box& box, std::size_t& hider) {
    scratch_.met.clear();
    const std::size_t count = scratch_.others.size();
    if (hider < count && holds(scratch_.others[hider], box)) return false;
    find_distances(box);
    for (std::size_t k = 0; k < count; ++k) {
      if (scratch_.far[k] <= scratch_.least[k]) {
        hider = k;
        return false;
      }
      if (scratch_.near[k] < scratch_.greatest[k]) scratch_.met.push_back(static_cast<std::uint32_t>(k));
    }
    return true;
  }

  /// By columns, so that the compiler computes several at a time.
  void find_distances(const Box& box) {
    std::array<float, 3> middle, half;
    for (std::size_t k = 0; k < 3; ++k) {
      middle[k] = static_cast<float>(box[k].middle - from_.centre[k]);
      half[k] = static_cast<float>(box[k].half);
    }
    const float mx = middle[0], my = middle[1], mz = middle[2], hx = half[0], hy = half[1], hz = half[2];
    const float *const cx = scratch_.x.data(), *const cy = scratch_.y.data(), *const cz = scratch_.z.data();
    float *const near = scratch_.near.data(), *const far = scratch_.far.data();
    const std::size_t count = scratch_.others.size();
    for (std::size_t k = 0; k < count; ++k) {
      const float x = std::fabs(cx[k] - mx), y = std::fabs(cy[k] - my), z = std::fabs(cz[k] - mz);
      const float nx = positive(x - hx), ny = positive(y - hy), nz = positive(z - hz);
      near[k] = nx * nx + ny * ny + nz * nz;
      far[k] = (x + hx) * (x + hx) + (y + hy) * (y + hy) + (z + hz) * (z + hz);
    }
  }

  static bool holds(const Ball& ball, const Box& box) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double far = box[k].farthest(ball.centre[k]);
      sum += far * far;
    }
    return sum <= ball.radius * ball.radius;
  }

  /// The integral over a stretch [c, d] less that over [a, b] is that from b to d less that from a to c.
  double sum_of_lines(const Block& block) {
    double sum = 0;
    for (std::ptrdiff_t j = block.rows.begin; j < block.rows.end; ++j) {
      for (std::ptrdiff_t i = block.columns.begin; i < block.columns.end; ++i) {
        const Line line = {bundle_.at(0, i), bundle_.at(1, j), bundle_.stretches(i, j)};
        const double before = half_squared_at(from_, line.x, line.y), after = half_squared_at(to_, line.x, line.y);
        if (before <= 0 && after <= 0) continue;
        const double a = std::sqrt(positive(before)), b = std::sqrt(positive(after));
        if (before <= 0) {
          sum += left_between(to_.centre[2] - b, to_.centre[2] + b, line);
        } else if (after <= 0) {
          sum -= left_between(from_.centre[2] - a, from_.centre[2] + a, line);
        } else {
          if (block.ends != Ends::kLower) sum += left_between(from_.centre[2] + a, to_.centre[2] + b, line);
          if (block.ends != Ends::kUpper) sum -= left_between(from_.centre[2] - a, to_.centre[2] - b, line);
        }
      }
    }
    return sum;
  }

  struct Line {
    double x, y;
    std::span<const Stretch> inside;
  };

  /// The integral from one coordinate to another, over what no other ball holds: of 1 outside the solid, of -1 inside.
  double left_between(double from, double to, const Line& line) {
    if (from > to) return -left_between(to, from, line);
    std::vector<Stretch>& taken = scratch_.taken;
    taken.clear();
    for (const std::uint32_t k : scratch_.met) {
      const Ball& other = scratch_.others[k];
      const double squared = half_squared_at(other, line.x, line.y);
      if (!(squared > 0)) continue;
      const double low = from - other.centre[2], high = to - other.centre[2];
      if (low * low <= squared && high * high <= squared) return 0;
      if (low * high > 0 && low * low >= squared && high * high >= squared) continue;
      const double half = std::sqrt(squared);
      const Stretch part = {other.centre[2] - half, other.centre[2] + half};
      if (part.from <= from) {
        from = std::max(from, part.to);
      } else if (part.to >= to) {
        to = std::min(to, part.from);
      } else {
        taken.push_back(part);
      }
      if (!(from < to)) return 0;
    }
    if (taken.empty()) return weight({from, to}, line);
    std::sort(taken.begin(), taken.end(), [](const Stretch& a, const Stretch& b) { return a.from < b.from; });
    double sum = 0;
    for (const Stretch& part : taken) {
      if (part.from > from && from < to) sum += weight({from, std::min(part.from, to)}, line);
      from = std::max(from, part.to);
    }
    if (from < to) sum += weight({from, to}, line);
    return sum;
  }

  static double weight(const Stretch& part, const Line& line) {
    double sum = part.to - part.from;
    for (const Stretch& inside : line.inside) sum -= 2 * overlap(part, inside);
    return sum;
  }

  const SolidLines::Bundle& bundle_;
  std::array<std::size_t, 3> axes_;
  Ball from_, to_;
  Scratch& scratch_;
  std::array<std::size_t, 2> hiders_ = {};  // for lower ends, and upper ones
};

SymmetricDifference::SymmetricDifference(const Solid& solid) : lines_(solid, kLines, kLeastLines) {}

double SymmetricDifference::change(const Ball& from, const Ball& to, std::span<const Ball> others) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const SolidLines::Bundle& bundle = lines_.along(axis);
    sum += bundle.spacing[0] * bundle.spacing[1] * Walk(bundle, axis, from, to, others, scratch_).sum();
  }
  return sum / 3;
}

}  // namespace medial_vk
