// The volume of a union of balls by samples, against measure_ball_union(): their difference in standard errors.
//   bench_union_samples [--samples N] [--seed N] [--threads N] [--limit SIGMAS] SPHERES.csv ...
// Two samples in each of N / 2 equal boxes: the variance is lower than without boxes, and the differences of the two
// give the standard error. A grid shows for most boxes that they are in one ball or in none. Exit code 1: beyond the
// limit.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "ball_files.h"
#include "base/parallel.h"
#include "base/point_ops.h"
#include "medial_vk/ball_union.h"

namespace medial_vk::bench {
namespace {

constexpr int kBoxesPerCell = 4;  // along each axis

/// A grid of cells over the balls: the cells in one ball, and the balls that meet the others.
class CellGrid {
 public:
  CellGrid(const std::vector<Ball>& balls, std::size_t cells) : balls_(balls), cells_(cells) {
    lower_ = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
    Point upper = -1 * lower_;
    for (const auto& [c, r] : balls) {
      const Point reach = {r, r, r};
      lower_ = least(lower_, c - reach);
      upper = greatest(upper, c + reach);
    }
    step_ = (1.0 / static_cast<double>(cells)) * (upper - lower_);
    full_.resize(cells * cells * cells);
    meeting_.resize(full_.size());
    for_each_overlap([&](std::size_t cell, const Ball& ball, const Point& middle) {
      const double reach = ball.radius - 0.5 * length(step_);
      const Point d = middle - ball.centre;
      if (reach > 0 && dot(d, d) < reach * reach * (1 - 1e-12)) full_[cell] = 1;
    });
    for_each_overlap([&](std::size_t cell, const Ball& ball, const Point&) {
      if (full_[cell] == 0) meeting_[cell].push_back(ball);
    });
  }

  std::size_t cells() const { return cells_; }
  const Point& step() const { return step_; }
  Point corner(std::size_t x, std::size_t y, std::size_t z) const {
    return {lower_[0] + static_cast<double>(x) * step_[0], lower_[1] + static_cast<double>(y) * step_[1],
            lower_[2] + static_cast<double>(z) * step_[2]};
  }
  std::size_t cell(std::size_t x, std::size_t y, std::size_t z) const { return (z * cells_ + y) * cells_ + x; }
  bool is_full(std::size_t cell) const { return full_[cell] != 0; }
  bool is_empty(std::size_t cell) const { return full_[cell] == 0 && meeting_[cell].empty(); }
  bool holds(std::size_t cell, const Point& p) const {
    return std::any_of(meeting_[cell].begin(), meeting_[cell].end(), [&](const Ball& ball) {
      const Point d = p - ball.centre;
      return dot(d, d) <= ball.radius * ball.radius;
    });
  }

 private:
  /// Calls f for every ball and every cell whose own ball it meets.
  template <class Function>
  void for_each_overlap(const Function& f) const {
    for (const Ball& ball : balls_) {
      std::array<std::size_t, 3> from, to;
      for (std::size_t k = 0; k < 3; ++k) {
        const double low = (ball.centre[k] - ball.radius - lower_[k]) / step_[k];
        const double high = (ball.centre[k] + ball.radius - lower_[k]) / step_[k];
        from[k] = static_cast<std::size_t>(std::max(0.0, low - 1e-6));
        to[k] = std::min(cells_ - 1, static_cast<std::size_t>(high + 1e-6));
      }
      const double reach = ball.radius + 0.5 * length(step_) * (1 + 1e-6);
      for (std::size_t z = from[2]; z <= to[2]; ++z) {
        for (std::size_t y = from[1]; y <= to[1]; ++y) {
          for (std::size_t x = from[0]; x <= to[0]; ++x) {
            const Point middle = corner(x, y, z) + 0.5 * step_;
            const Point d = middle - ball.centre;
            if (dot(d, d) <= reach * reach) f(cell(x, y, z), ball, middle);
          }
        }
      }
    }
  }

  const std::vector<Ball>& balls_;
  std::size_t cells_;
  Point lower_, step_;
  std::vector<std::uint8_t> full_;
  std::vector<std::vector<Ball>> meeting_;
};

/// For boxes with two samples: the samples in the union, and the boxes whose samples disagree.
struct Counts {
  std::uint64_t hits = 0, disagree = 0;
};

Counts sample_cell(const CellGrid& grid, std::size_t cell, const Point& corner, std::mt19937_64& random) {
  const Point side = (1.0 / kBoxesPerCell) * grid.step();
  Counts counts;
  for (int box = 0; box < kBoxesPerCell * kBoxesPerCell * kBoxesPerCell; ++box) {
    const std::array<int, 3> at = {box % kBoxesPerCell, box / kBoxesPerCell % kBoxesPerCell,
                                   box / kBoxesPerCell / kBoxesPerCell};
    const auto hit = [&] {
      Point p = corner;
      for (std::size_t k = 0; k < 3; ++k) p[k] += (at[k] + static_cast<double>(random() >> 11) * 0x1p-53) * side[k];
      return grid.holds(cell, p);
    };
    const bool one = hit(), other = hit();
    counts.hits += std::uint64_t{one} + std::uint64_t{other};
    counts.disagree += one != other;
  }
  return counts;
}

struct Estimate {
  double volume, error;
  std::uint64_t samples;
};

Estimate estimate(const std::vector<Ball>& balls, std::uint64_t samples, std::uint64_t seed, unsigned threads) {
  const double wanted = std::cbrt(static_cast<double>(samples) / 2) / kBoxesPerCell;
  const CellGrid grid(balls, std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(wanted))));
  const std::size_t cells = grid.cells();
  constexpr std::uint64_t kPerCell = 2 * kBoxesPerCell * kBoxesPerCell * kBoxesPerCell;
  std::vector<Counts> layers(cells);
  parallel_blocks(cells, 1, threads, [&](std::size_t z, std::size_t) {
    std::mt19937_64 random(seed * 1000003 + z);
    for (std::size_t y = 0; y < cells; ++y) {
      for (std::size_t x = 0; x < cells; ++x) {
        const std::size_t cell = grid.cell(x, y, z);
        if (grid.is_full(cell)) layers[z].hits += kPerCell;
        if (grid.is_full(cell) || grid.is_empty(cell)) continue;
        const Counts counts = sample_cell(grid, cell, grid.corner(x, y, z), random);
        layers[z].hits += counts.hits;
        layers[z].disagree += counts.disagree;
      }
    }
  });
  Counts all;
  for (const Counts& layer : layers) all.hits += layer.hits, all.disagree += layer.disagree;
  // Of a box with share p, two samples disagree with chance 2 p (1 - p), and their mean has variance p (1 - p) / 2.
  const std::uint64_t total = kPerCell * cells * cells * cells;
  const Point& step = grid.step();
  const double box =
      step[0] * step[1] * step[2] * static_cast<double>(cells * cells * cells) / static_cast<double>(total / 2);
  return {box * static_cast<double>(all.hits) / 2, box * std::sqrt(static_cast<double>(all.disagree)) / 2, total};
}

}  // namespace
}  // namespace medial_vk::bench

int main(int argc, char** argv) {
  using namespace medial_vk;
  CLI::App app("The volume of unions of balls by samples");
  std::uint64_t samples = 100'000'000, seed = 1;
  unsigned threads = 2;
  double limit = 4;
  std::vector<std::string> files;
  app.add_option("--samples", samples);
  app.add_option("--seed", seed);
  app.add_option("--threads", threads);
  app.add_option("--limit", limit, "standard errors that are allowed");
  app.add_option("FILES", files)->required();
  CLI11_PARSE(app, argc, argv);
  fmt::print(
      "| balls of | balls | samples | volume | by samples | standard error, relative | apart, standard errors |\n"
      "|---|---|---|---|---|---|---|\n");
  bool good = true;
  for (const std::string& file : files) {
    const std::vector<Ball> balls = bench::read_balls(file);
    const auto measured = measure_ball_union(balls, {.threads = threads});
    if (!measured.ok()) return fmt::print(stderr, "{}: {}\n", file, measured.error().message), 2;
    const double volume = measured.value().volume;
    const auto [expected, error, count] = bench::estimate(balls, samples, seed, threads);
    const double apart = (volume - expected) / error;
    good = good && std::fabs(apart) <= limit;
    fmt::print("| {} | {} | {} | {:.9g} | {:.9g} | {:.2g} | {:+.2f} |\n", file, balls.size(), count, volume, expected,
               error / expected, apart);
  }
  return good ? 0 : 1;
}
