#include "sphere_fits/steps/coverage.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

constexpr double kMostPoints = 1 << 25;
constexpr std::size_t kBits = 64;

/// A ball in a layer of the lattice, in units of its spacing.
struct Circle {
  float x, y, squared_radius;
  float last_x;  // of the layer's points
};

/// The points [begin, end) of rows next to each other: by columns, so that the compiler computes several at a time.
struct Rows {
  static constexpr std::int32_t kMost = 64;
  std::array<std::int32_t, kMost> begin, end;
};

void find_points(const Circle& circle, std::int32_t first_row, std::int32_t count, Rows& rows) {
  for (std::int32_t k = 0; k < count; ++k) {
    const float across = static_cast<float>(first_row + k) - circle.y;
    const float half = std::sqrt(std::max(circle.squared_radius - across * across, 0.0F));
    const float from = std::max(circle.x - half, 0.0F), to = std::min(circle.x + half, circle.last_x);
    // Conversions are much faster than ceil() and floor(), which the basic instruction set lacks.
    const auto below = static_cast<std::int32_t>(from), last = static_cast<std::int32_t>(to);
    const auto i = static_cast<std::size_t>(k);
    rows.begin[i] = below + (static_cast<float>(below) < from ? 1 : 0);
    rows.end[i] = to < 0 ? 0 : last + 1;
  }
}

/// The integers [begin, end) among 0 ... size - 1 that are at most `half` away from `middle`.
std::pair<std::int32_t, std::int32_t> integers_around(double middle, double half, std::size_t size) {
  const auto most = static_cast<double>(size);
  return {static_cast<std::int32_t>(std::ceil(std::clamp(middle - half, 0.0, most))),
          static_cast<std::int32_t>(std::floor(std::clamp(middle + half, -1.0, most - 1))) + 1};
}

/// The bits [begin, end) of a word, 0 <= begin < end <= 64.
std::uint64_t bits(std::size_t begin, std::size_t end) {
  return (~std::uint64_t{0} << begin) & (~std::uint64_t{0} >> (kBits - end));
}

}  // namespace

Coverage::Coverage(const Point& lower, const Point& upper) {
  const Point sides = upper - lower;
  std::stable_sort(axes_.begin(), axes_.end(), [&](std::size_t a, std::size_t b) { return sides[a] > sides[b]; });
  for (std::size_t k = 0; k < 3; ++k) {
    lower_[k] = lower[axes_[k]];
    sides_[k] = sides[axes_[k]];
  }
}

void Coverage::divide(double density, std::span<const Ball> balls) {
  spacing_ = std::max(0x1p-20 * sides_[0], 1 / std::cbrt(density));  // finite steps, whatever the density
  const auto points = [&] {
    double product = 1;
    for (const double side : sides_) product *= std::floor(side / spacing_) + 1;
    return product;
  };
  while (!(points() <= kMostPoints)) spacing_ *= 1.1;
  for (std::size_t k = 0; k < 3; ++k) size_[k] = static_cast<std::size_t>(sides_[k] / spacing_) + 1;
  words_ = (size_[0] + kBits - 1) / kBits;
  // In a thin part that is bent, few points of the box are in a ball.
  counts_.assign(size_[0] * size_[1] * size_[2]);
  held_.assign(words_ * size_[1] * size_[2]);
  for (const Ball& ball : balls) add(ball);
}

/// Calls visit(row, range) for the rows with points of the ball.
template <class Visit>
void Coverage::for_each_row(const Ball& ball, const Visit& visit) const {
  Point middle{};
  for (std::size_t k = 0; k < 3; ++k) middle[k] = (ball.centre[axes_[k]] - lower_[k]) / spacing_;
  const double radius = ball.radius / spacing_;
  const auto [bottom, top] = integers_around(middle[2], radius, size_[2]);
  Rows rows;
  for (std::int32_t z = bottom; z < top; ++z) {
    const double up = z - middle[2], squared = std::max(0.0, radius * radius - up * up);
    const Circle circle = {static_cast<float>(middle[0]), static_cast<float>(middle[1]), static_cast<float>(squared),
                           static_cast<float>(size_[0] - 1)};
    const auto [front, back] = integers_around(middle[1], std::sqrt(squared), size_[1]);
    for (std::int32_t y = front; y < back; y += Rows::kMost) {
      const std::int32_t count = std::min(back - y, Rows::kMost);
      find_points(circle, y, count, rows);
      const std::size_t first = static_cast<std::size_t>(z) * size_[1] + static_cast<std::size_t>(y);
      for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
        const Range points = {static_cast<std::size_t>(rows.begin[k]), static_cast<std::size_t>(rows.end[k])};
        if (points.begin < points.end) visit(first + k, points);
      }
    }
  }
}

/// Calls visit(word, bits) for the words of held_ with these points.
template <class Visit>
void Coverage::for_each_word(std::size_t row, const Range& points, const Visit& visit) const {
  const std::size_t first = points.begin / kBits, last = (points.end - 1) / kBits;
  for (std::size_t w = first; w <= last; ++w) {
    const std::size_t begin = w == first ? points.begin % kBits : 0;
    visit(row * words_ + w, bits(begin, w == last ? (points.end - 1) % kBits + 1 : kBits));
  }
}

/// One more ball holds these points.
void Coverage::hold(std::size_t row, const Range& points) {
  if (points.begin >= points.end) return;
  std::uint16_t* const counts = counts_.data() + row * size_[0];
  for (std::size_t i = points.begin; i < points.end; ++i) ++counts[i];
  for_each_word(row, points, [&](std::size_t word, std::uint64_t mask) { held_[word] |= mask; });
}

void Coverage::release(std::size_t row, const Range& points) {
  if (points.begin >= points.end) return;
  std::uint16_t* const counts = counts_.data() + row * size_[0];
  std::size_t freed = 0;
  for (std::size_t i = points.begin; i < points.end; ++i) freed += --counts[i] == 0 ? 1 : 0;
  if (freed == 0) return;
  for_each_word(row, points, [&](std::size_t word, std::uint64_t mask) {
    const std::size_t first = (word - row * words_) * kBits;
    std::uint64_t clear = 0;
    for (std::size_t bit = 0; bit < kBits; ++bit) {
      if ((mask >> bit & 1) != 0 && counts[first + bit] == 0) clear |= std::uint64_t{1} << bit;
    }
    held_[word] &= ~clear;
  });
}

void Coverage::add(const Ball& ball) {
  for_each_row(ball, [&](std::size_t row, const Range& points) { hold(row, points); });
}

void Coverage::remove(const Ball& ball) {
  for_each_row(ball, [&](std::size_t row, const Range& points) { release(row, points); });
}

std::vector<std::pair<std::size_t, Coverage::Range>> Coverage::rows_of(const Ball& ball) const {
  std::vector<std::pair<std::size_t, Range>> rows;
  for_each_row(ball, [&](std::size_t row, const Range& points) { rows.emplace_back(row, points); });
  return rows;
}

/// Rows come in ascending order. Of a row's two ranges, each loses what it has in common with the other.
void Coverage::replace(const Ball& from, const Ball& to) {
  const std::vector<std::pair<std::size_t, Range>> before = rows_of(from), after = rows_of(to);
  auto old = before.begin();
  const auto release_until = [&](std::size_t row) {
    for (; old != before.end() && old->first < row; ++old) release(old->first, old->second);
  };
  for (const auto& [row, now] : after) {
    release_until(row);
    if (old == before.end() || old->first != row) {
      hold(row, now);
      continue;
    }
    const Range was = old->second;
    ++old;
    release(row, {was.begin, std::min(was.end, now.begin)});
    release(row, {std::max(was.begin, now.end), was.end});
    hold(row, {now.begin, std::min(now.end, was.begin)});
    hold(row, {std::max(now.begin, was.end), now.end});
  }
  release_until(size_[1] * size_[2]);
}

double Coverage::uncovered(const Ball& ball) const {
  std::size_t found = 0;
  for_each_row(ball, [&](std::size_t row, const Range& points) {
    for_each_word(row, points, [&](std::size_t word, std::uint64_t mask) {
      const std::uint64_t here = mask & ~held_[word];
      if (here != 0) found += static_cast<std::size_t>(std::popcount(here));
    });
  });
  return static_cast<double>(found) * cell();
}

}  // namespace medial_vk
