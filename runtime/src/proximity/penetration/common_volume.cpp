#include "proximity/penetration/common_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "medial_vk/ball_union.h"
#include "proximity/penetration/column.h"

namespace medial_vk {
namespace {

struct MissesLess {
  bool operator()(const Column& s, const Column& t) const { return s.missing < t.missing; }
};

Rectangle box_of(std::span<const Ball> balls) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Rectangle box{{kInfinity, kInfinity}, {-kInfinity, -kInfinity}};
  for (const Ball& ball : balls) {
    for (std::size_t k = 0; k < 2; ++k) {
      box.from[k] = std::min(box.from[k], ball.centre[k] - ball.radius);
      box.to[k] = std::max(box.to[k], ball.centre[k] + ball.radius);
    }
  }
  return box;
}

std::vector<Ball> those_in(std::span<const Ball> balls, const Rectangle& rectangle) {
  std::vector<Ball> found;
  std::ranges::copy_if(balls, std::back_inserter(found), [&](const Ball& ball) { return meets(ball, rectangle); });
  return found;
}

class Columns {
 public:
  Columns(double enough, std::uint64_t most) : enough_(enough), most_(most) {}

  double run(std::span<const Ball> a, std::span<const Ball> b, const Rectangle& all) {
    constexpr int kFirstLevels = 4;  // so that the estimates of what is missing see every larger part
    divide({all, {a.begin(), a.end()}, {b.begin(), b.end()}}, kFirstLevels);
    while (!columns_.empty() && count_ < most_ && sum_ < enough_) {
      std::ranges::pop_heap(columns_, MissesLess());
      const Column column = std::move(columns_.back());
      columns_.pop_back();
      sum_ -= column.lower;
      divide(column, 1);
    }
    for (const Column& column : columns_) done_.push_back(column.lower);
    // Ascending, without loss: a column has some 32 roundings, and the sum one for each.
    std::ranges::sort(done_);
    double sum = 0;
    for (const double volume : done_) sum += volume;
    return sum * (1 - 0x1p-53 * (64 + static_cast<double>(done_.size())));
  }

 private:
  void add(Column column) {
    ++count_;
    if (column.a.empty() || column.b.empty() || !(column.rectangle.area() > 0)) return;
    meter_.measure(column);
    sum_ += column.lower;
    if (column.missing > 0) {
      columns_.push_back(std::move(column));
      std::ranges::push_heap(columns_, MissesLess());
    } else {
      done_.push_back(column.lower);
    }
  }

  /// Into quarters, so many times.
  void divide(const Column& column, int levels) {
    const auto& [from, to] = column.rectangle;
    const std::array<double, 2> middle = {0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])};
    for (unsigned quarter = 0; quarter < 4; ++quarter) {
      Column part;
      for (std::size_t k = 0; k < 2; ++k) {
        const bool second = (quarter >> k & 1u) != 0;
        part.rectangle.from[k] = second ? middle[k] : from[k];
        part.rectangle.to[k] = second ? to[k] : middle[k];
      }
      part.a = those_in(column.a, part.rectangle);
      part.b = those_in(column.b, part.rectangle);
      levels > 1 ? divide(part, levels - 1) : add(std::move(part));
    }
  }

  ColumnMeter meter_;
  double enough_;
  std::uint64_t most_, count_ = 0;
  double sum_ = 0;
  std::vector<double> done_;
  std::vector<Column> columns_;  // a heap
};

Result<double> volume_of(std::span<const Ball> balls) {
  BallUnionOptions options;
  options.threads = 1;  // few balls
  Result<BallUnion> measured = measure_ball_union(balls, options);
  if (!measured) return measured.error();
  return measured.value().volume;
}

}  // namespace

Result<double> common_volume_of(std::span<const Ball> a, std::span<const Ball> b) {
  std::vector<Ball> both(a.begin(), a.end());
  both.insert(both.end(), b.begin(), b.end());
  const Result<double> of_a = volume_of(a), of_b = volume_of(b), of_both = volume_of(both);
  for (const Result<double>* volume : {&of_a, &of_b, &of_both}) {
    if (!*volume) return volume->error();
  }
  return std::max(0.0, of_a.value() + of_b.value() - of_both.value());
}

double common_volume_at_least(std::span<const Ball> a, std::span<const Ball> b, double estimate, double tolerance,
                              std::uint64_t most_columns) {
  const Rectangle box_a = box_of(a), box_b = box_of(b);
  Rectangle both;
  for (std::size_t k = 0; k < 2; ++k) {
    both.from[k] = std::max(box_a.from[k], box_b.from[k]);
    both.to[k] = std::min(box_a.to[k], box_b.to[k]);
    if (!(both.from[k] < both.to[k])) return 0;
  }
  return Columns((1 - tolerance) * estimate, most_columns).run(a, b, both);
}

}  // namespace medial_vk
