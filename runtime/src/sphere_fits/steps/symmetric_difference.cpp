#include "sphere_fits/steps/symmetric_difference.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace medial_vk {
namespace {

/// Along the longest side of the solid, and along others at least.
constexpr std::size_t kLines = 160, kLeastLines = 32;

double overlap(const SolidLines::Stretch& a, const SolidLines::Stretch& b) {
  return std::max(0.0, std::min(a.to, b.to) - std::max(a.from, b.from));
}

/// Numbers of lines or rows.
struct Numbers {
  std::ptrdiff_t begin = 0, end = 0;
  bool has(std::ptrdiff_t number) const { return number >= begin && number < end; }
};

/// Those less than `half` away from `middle`.
Numbers numbers_around(const SolidLines::Bundle& bundle, std::size_t k, double middle, double half) {
  if (!(half > 0)) return {};
  const auto number = [&](double at) {
    return static_cast<std::ptrdiff_t>(std::ceil((at - bundle.first[k]) / bundle.spacing[k]));
  };
  return {number(middle - half), number(middle + half)};
}

/// The smallest range that holds both, of which either may be empty.
Numbers hull(const Numbers& a, const Numbers& b) {
  if (a.begin >= a.end) return b;
  if (b.begin >= b.end) return a;
  return {std::min(a.begin, b.begin), std::max(a.end, b.end)};
}

}  // namespace

/// A ball on the lines of a row.
class SymmetricDifference::InRow {
 public:
  InRow(const SolidLines::Bundle& bundle, const Ball& ball, std::size_t axis, std::ptrdiff_t row)
      : bundle_(bundle), across_(ball.centre[bundle.across[0]]), along_(ball.centre[axis]) {
    const double off = bundle.at(1, row) - ball.centre[bundle.across[1]];
    squared_ = ball.radius * ball.radius - off * off;
    if (squared_ > 0) columns_ = numbers_around(bundle, 0, across_, std::sqrt(squared_));
  }

  const Numbers& columns() const { return columns_; }
  Stretch stretch(std::ptrdiff_t column) const {
    const double off = bundle_.at(0, column) - across_, half = std::sqrt(std::max(0.0, squared_ - off * off));
    return {along_ - half, along_ + half};
  }

 private:
  const SolidLines::Bundle& bundle_;
  double across_, along_;  // centre
  double squared_;         // radius of the disc
  Numbers columns_;
};

SymmetricDifference::SymmetricDifference(const Solid& solid) : lines_(solid, kLines, kLeastLines) {}

double SymmetricDifference::change(const Ball& from, const Ball& to, std::span<const Ball> others) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::array<double, 2>& spacing = lines_.along(axis).spacing;
    sum += spacing[0] * spacing[1] * change_along(from, to, others, axis);
  }
  return sum / 3;
}

/// The sum over the lines that meet either ball, a row of them after the other. The integral over a stretch [c, d] less
/// that over [a, b] is that from b to d less that from a to c.
double SymmetricDifference::change_along(const Ball& from, const Ball& to, std::span<const Ball> others,
                                         std::size_t axis) {
  const SolidLines::Bundle& bundle = lines_.along(axis);
  const std::size_t v = bundle.across[1];
  const Numbers rows = hull(numbers_around(bundle, 1, from.centre[v], from.radius),
                            numbers_around(bundle, 1, to.centre[v], to.radius));
  double sum = 0;
  for (std::ptrdiff_t j = rows.begin; j < rows.end; ++j) {
    const InRow before(bundle, from, axis, j), after(bundle, to, axis, j);
    const Numbers columns = hull(before.columns(), after.columns());
    if (columns.begin >= columns.end) continue;
    slice_others(others, axis, bundle.at(1, j));
    std::array<std::size_t, 2> hiders = {};
    for (std::ptrdiff_t i = columns.begin; i < columns.end; ++i) {
      const Line line = {bundle.at(0, i), bundle.stretches(i, j)};
      const bool was = before.columns().has(i), is = after.columns().has(i);
      if (was && is) {
        const Stretch a = before.stretch(i), b = after.stretch(i);
        sum += left_between(a.to, b.to, line, hiders[1]) - left_between(a.from, b.from, line, hiders[0]);
      } else if (was || is) {
        const Stretch only = was ? before.stretch(i) : after.stretch(i);
        sum += (is ? 1 : -1) * left_between(only.from, only.to, line, hiders[0]);
      }
    }
  }
  return sum;
}

void SymmetricDifference::slice_others(std::span<const Ball> others, std::size_t axis, double y) {
  const auto [u, v] = lines_.along(axis).across;
  in_row_.clear();
  for (const Ball& other : others) {
    const double off = y - other.centre[v], squared = other.radius * other.radius - off * off;
    if (squared > 0) in_row_.push_back({other.centre[u], other.centre[axis], squared});
  }
}

/// The integral from one coordinate to another, over what no other ball holds: of 1 outside the solid, of -1 inside.
/// Mostly one ball holds all of it, and the next line's, too: that of number `hider` is the first to be asked.
double SymmetricDifference::left_between(double from, double to, const Line& line, std::size_t& hider) {
  if (from > to) return -left_between(to, from, line, hider);
  taken_.clear();
  const auto take = [&](const Disc& other) {
    const double off = line.across - other.across, squared = other.squared - off * off;
    if (!(squared > 0)) return;
    const double low = from - other.along, high = to - other.along;
    if (low * low <= squared && high * high <= squared) {
      from = to;
      return;
    }
    if (low * high > 0 && low * low >= squared && high * high >= squared) return;
    const double half = std::sqrt(squared);
    const Stretch part = {other.along - half, other.along + half};
    if (part.from <= from) {
      from = std::max(from, part.to);
    } else if (part.to >= to) {
      to = std::min(to, part.from);
    } else {
      taken_.push_back(part);
    }
  };
  if (hider < in_row_.size()) take(in_row_[hider]);
  for (std::size_t k = 0; k < in_row_.size() && from < to; ++k) {
    take(in_row_[k]);
    if (!(from < to)) hider = k;
  }
  if (!(from < to)) return 0;
  const auto weight = [&](const Stretch& part) {
    double sum = part.to - part.from;
    for (const Stretch& inside : line.inside) sum -= 2 * overlap(part, inside);
    return sum;
  };
  if (taken_.empty()) return weight({from, to});
  std::sort(taken_.begin(), taken_.end(), [](const Stretch& a, const Stretch& b) { return a.from < b.from; });
  double sum = 0;
  for (const Stretch& part : taken_) {
    if (part.from > from && from < to) sum += weight({from, std::min(part.from, to)});
    from = std::max(from, part.to);
  }
  if (from < to) sum += weight({from, to});
  return sum;
}

}  // namespace medial_vk
