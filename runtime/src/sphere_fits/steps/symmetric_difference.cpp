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

}  // namespace

SymmetricDifference::SymmetricDifference(const Solid& solid) : lines_(solid, kLines, kLeastLines) {}

double SymmetricDifference::change(const Ball& ball, std::span<const Ball> others) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::array<double, 2>& spacing = lines_.along(axis).spacing;
    sum += spacing[0] * spacing[1] * change_along(ball, others, axis);
  }
  return sum / 3;
}

SymmetricDifference::Disc SymmetricDifference::slice(const Ball& ball, std::size_t axis, std::size_t across,
                                                     double off) {
  return {ball.centre[across], ball.centre[axis], ball.radius * ball.radius - off * off};
}

/// The sum of lengths over the lines that the ball meets, a row of them after the other.
double SymmetricDifference::change_along(const Ball& ball, std::span<const Ball> others, std::size_t axis) {
  const SolidLines::Bundle& bundle = lines_.along(axis);
  const auto [u, v] = bundle.across;
  double sum = 0;
  for (std::ptrdiff_t j = first_line(bundle, 1, ball.centre[v] - ball.radius);; ++j) {
    const double y = bundle.at(1, j);
    const Disc disc = slice(ball, axis, u, y - ball.centre[v]);
    if (y >= ball.centre[v] + ball.radius) break;
    if (disc.squared <= 0) continue;  // by rounding
    in_row_.clear();
    for (const Ball& other : others) {
      if (const Disc cut = slice(other, axis, u, y - other.centre[v]); cut.squared > 0) in_row_.push_back(cut);
    }
    const double half = std::sqrt(disc.squared);
    for (std::ptrdiff_t i = first_line(bundle, 0, disc.across - half);; ++i) {
      const double x = bundle.at(0, i);
      if (x >= disc.across + half) break;
      find_left(disc, x);
      for (const Stretch& part : left_) {
        sum += part.to - part.from;
        for (const Stretch& inside : bundle.stretches(i, j)) sum -= 2 * overlap(part, inside);
      }
    }
  }
  return sum;
}

std::ptrdiff_t SymmetricDifference::first_line(const SolidLines::Bundle& bundle, std::size_t k, double from) {
  return static_cast<std::ptrdiff_t>(std::ceil((from - bundle.first[k]) / bundle.spacing[k]));
}

/// The stretches of the line at x of the row in the ball and in no other.
void SymmetricDifference::find_left(const Disc& ball, double x) {
  const auto stretch = [x](const Disc& disc) {
    const double half = std::sqrt(std::max(0.0, disc.squared - (x - disc.across) * (x - disc.across)));
    return Stretch{disc.along - half, disc.along + half};
  };
  left_.assign(1, stretch(ball));
  for (const Disc& other : in_row_) {
    if ((x - other.across) * (x - other.across) >= other.squared) continue;
    take_away(stretch(other));
    if (left_.empty()) return;
  }
}

void SymmetricDifference::take_away(const Stretch& taken) {
  next_.clear();
  for (const Stretch& part : left_) {
    if (taken.from > part.from) next_.push_back({part.from, std::min(part.to, taken.from)});
    if (taken.to < part.to) next_.push_back({std::max(part.from, taken.to), part.to});
  }
  left_.swap(next_);
}

}  // namespace medial_vk
