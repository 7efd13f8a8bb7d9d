// bench_hulls: the time of distances between hulls of balls, for each pair of kinds, and that of bounds of the volume
// of unions of hulls (docs/benchmarks.md, "Hulls of balls").
#include <fmt/core.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "medial_vk/ball_hull.h"
#include "medial_vk/hull_union.h"

namespace {

using namespace medial_vk;
using std::numbers::pi;

constexpr std::size_t kPairs = 2000;

/// Of the processor, of all threads of this process: other work on the machine changes it little.
double processor_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

/// Centres in the cube [-1, 1]^3 moved by `apart` along x, radii up to 0.3.
std::vector<BallHull> random_hulls(std::uint32_t count, double apart, std::mt19937_64& random) {
  std::uniform_real_distribution<double> coordinate(-1, 1), radius(0, 0.3);
  std::vector<BallHull> hulls(kPairs);
  for (BallHull& hull : hulls) {
    hull.count = count;
    for (Ball& ball : hull.corners) {
      for (double& x : ball.centre) x = coordinate(random);
      ball.centre[0] += apart;
      ball.radius = radius(random);
    }
  }
  return hulls;
}

/// Nanoseconds for each pair: the least of the runs. `sum` keeps the results in use.
double time_of_pairs(const std::vector<BallHull>& first, const std::vector<BallHull>& second, int runs, double& sum) {
  constexpr int kRounds = 20;
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run) {
    const double start = processor_seconds();
    for (int round = 0; round < kRounds; ++round) {
      for (std::size_t i = 0; i < kPairs; ++i) sum += distance_between(first[i], second[i]);
    }
    least = std::min(least, processor_seconds() - start);
  }
  return 1e9 * least / (kRounds * static_cast<double>(kPairs));
}

void print_distances(int runs) {
  const char* const names[] = {"ball", "cone", "slab"};
  fmt::print("| pair | ns, near each other | ns, apart |\n|---|--:|--:|\n");
  double sum = 0;
  for (std::uint32_t a = 1; a <= 3; ++a) {
    for (std::uint32_t b = a; b <= 3; ++b) {
      fmt::print("| {}-{} |", names[a - 1], names[b - 1]);
      for (const double apart : {0.0, 3.0}) {
        std::mt19937_64 random(10 * a + b);
        const std::vector<BallHull> first = random_hulls(a, 0, random);
        const std::vector<BallHull> second = random_hulls(b, apart, random);
        fmt::print(" {:.0f} |", time_of_pairs(first, second, runs, sum));
      }
      fmt::print("\n");
    }
  }
  fmt::print("(sum of distances {:.6g})\n\n", sum);
}

/// 64 cones along a closed curve, of a radius that varies.
std::vector<BallHull> ring_of_cones() {
  const auto ball = [](int i) {
    const double angle = 2 * pi * i / 64;
    return Ball{{0.35 * std::cos(angle), 0.35 * std::sin(angle), 0.1 * std::sin(3 * angle)},
                0.1 + 0.03 * std::sin(5 * angle)};
  };
  std::vector<BallHull> hulls;
  hulls.reserve(64);
  for (int i = 0; i < 64; ++i) hulls.push_back(hull_of(ball(i), ball((i + 1) % 64)));
  return hulls;
}

/// 64 slabs of a bent plate whose thickness varies.
std::vector<BallHull> plate_of_slabs() {
  const auto ball = [](int i, int j) {
    const double x = i / 8.0, y = j / 4.0;
    return Ball{{x, 0.7 * y, 0.15 * std::sin(3 * x + y)}, 0.04 + 0.02 * std::cos(4 * x) * std::cos(2 * y)};
  };
  std::vector<BallHull> hulls;
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 4; ++j) {
      hulls.push_back(hull_of(ball(i, j), ball(i + 1, j), ball(i + 1, j + 1)));
      hulls.push_back(hull_of(ball(i, j), ball(i, j + 1), ball(i + 1, j + 1)));
    }
  }
  return hulls;
}

/// 64 slabs at random, each in a cube of side 0.6.
std::vector<BallHull> scattered_slabs() {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> coordinate(-1, 1), radius(0.02, 0.15);
  std::vector<BallHull> hulls(64);
  for (BallHull& hull : hulls) {
    hull.count = 3;
    Point middle{};
    for (double& x : middle) x = coordinate(random);
    for (Ball& ball : hull.corners) {
      for (std::size_t k = 0; k < 3; ++k) ball.centre[k] = middle[k] + 0.3 * coordinate(random);
      ball.radius = radius(random);
    }
  }
  return hulls;
}

bool print_union(const char* name, const std::vector<BallHull>& hulls, int runs) {
  const Result<Bounds> first = measure_hull_union(hulls, {0.05, 0});
  if (!first.ok()) {
    fmt::print(stderr, "{}\n", first.error().message);
    return false;
  }
  const double volume = 0.5 * (first.value().lower + first.value().upper);
  for (const double share : {1e-2, 2e-3, 5e-4}) {
    double least = std::numeric_limits<double>::infinity();
    Bounds bounds;
    for (int run = 0; run < runs; ++run) {
      const double start = processor_seconds();
      const Result<Bounds> measured = measure_hull_union(hulls, {share * volume, 0});
      if (!measured.ok()) {
        fmt::print(stderr, "{}\n", measured.error().message);
        return false;
      }
      least = std::min(least, processor_seconds() - start);
      bounds = measured.value();
    }
    fmt::print("| {} | {:g} | {:.7g} | {:.7g} | {:.3f} |\n", name, share, bounds.lower, bounds.upper, least);
  }
  return true;
}

bool print_unions(int runs) {
  fmt::print("| 64 hulls | width, share of the volume | at least | at most | CPU s |\n|---|--:|--:|--:|--:|\n");
  return print_union("ring of cones", ring_of_cones(), runs) &&
         print_union("bent plate of slabs", plate_of_slabs(), runs) &&
         print_union("scattered slabs", scattered_slabs(), runs);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Times of distances and of unions of hulls of balls");
  int runs = 15, union_runs = 3;
  app.add_option("--runs", runs, "Runs of each pair of kinds; the least time counts")->check(CLI::PositiveNumber);
  app.add_option("--union-runs", union_runs, "Runs of each union")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  print_distances(runs);
  return print_unions(union_runs) ? 0 : 1;
}
