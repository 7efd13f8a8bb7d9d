// Unions of balls: seconds of measure_ball_union() with and without the dual complex, and of CGAL's regular
// triangulation of the same balls alone, where it is built in. The median of the repeats by wall clock, and the median
// of the CPU seconds of the process.
//   bench_unions [--repeats N] [--threads N] [--made] [--largest N] [SPHERES.csv ...]
// --made: also generated balls, random ones up to --largest, a lattice, centres in a plane.
#include <fmt/core.h>
#include <time.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "../helpers.h"
#include "ball_files.h"
#include "medial_vk/ball_union.h"
#include "support/solids/ball_families.h"
#ifdef MEDIAL_VK_HAVE_CGAL
#include "cgal/regular_triangulation.h"
#endif

namespace medial_vk::bench {
namespace {

struct Times {
  double wall = 0, cpu = 0;
};

double cpu_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

Times time_of(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  const double cpu = cpu_seconds();
  work();
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), cpu_seconds() - cpu};
}

Times median_of(const std::vector<Times>& runs) {
  std::vector<double> wall, cpu;
  for (const Times& run : runs) wall.push_back(run.wall), cpu.push_back(run.cpu);
  return {median(wall), median(cpu)};
}

void measure(const std::vector<Ball>& balls, const BallUnionOptions& options) {
  const auto result = measure_ball_union(balls, options);
  if (result.ok() && std::isfinite(result.value().volume)) return;
  fmt::print(stderr, "no volume: {}\n", result.ok() ? "not finite" : result.error().message);
  std::exit(1);
}

class Table {
 public:
  Table(unsigned threads, int repeats) : threads_(threads), repeats_(repeats) {
    fmt::print(
        "| balls | number | wall s | CPU s | with complex: wall s | CPU s | CGAL, CPU s |\n"
        "|---|---|---|---|---|---|---|\n");
  }

  /// CPU seconds without the complex. The three kinds of runs alternate, so that other load affects all of them
  /// equally.
  double add(const std::string& name, const std::vector<Ball>& balls) {
    std::vector<Times> plain, with_complex, peer;
    for (int k = 0; k < repeats_; ++k) {
      plain.push_back(time_of([&] { measure(balls, {.threads = threads_}); }));
      with_complex.push_back(time_of([&] { measure(balls, {.threads = threads_, .complex = true}); }));
#ifdef MEDIAL_VK_HAVE_CGAL
      peer.push_back(time_of([&] { (void)test::triangulate_by_cgal(balls); }));
#endif
    }
    const Times a = median_of(plain), b = median_of(with_complex);
    const std::string other = peer.empty() ? "" : fmt::format("{:.3f}", median_of(peer).cpu);
    fmt::print("| {} | {} | {:.3f} | {:.3f} | {:.3f} | {:.3f} | {} |\n", name, balls.size(), a.wall, a.cpu, b.wall,
               b.cpu, other);
    std::fflush(stdout);
    return a.cpu;
  }

 private:
  unsigned threads_;
  int repeats_;
};

using Line = std::vector<std::pair<double, double>>;  // balls, CPU seconds

/// The exponent that fits all points of a line best.
void print_growth(const std::string& name, const Line& line) {
  if (line.size() < 2) return;
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const auto& [n, seconds] : line) {
    x += std::log(n);
    y += std::log(seconds);
    xx += std::log(n) * std::log(n);
    xy += std::log(n) * std::log(seconds);
  }
  const auto count = static_cast<double>(line.size());
  fmt::print("Growth of {}: exponent {:.2f}.\n", name, (count * xy - x * y) / (count * xx - x * x));
}

/// Random balls with a constant number of overlaps per ball at every size, a lattice, and a plane.
Line add_made(Table& table, std::size_t largest) {
  Line line;
  for (std::size_t n = 20000; n <= largest; n *= 5) {
    const double radius = std::cbrt(1.0 / static_cast<double>(n));
    line.emplace_back(n, table.add("random", test::random_balls(n, 1, 0.3 * radius, 1.2 * radius)));
  }
  table.add("lattice", test::lattice(27, 0.9));
  table.add("centres in a plane", test::flat_lattice(141, 2.25));
  return line;
}

}  // namespace
}  // namespace medial_vk::bench

int main(int argc, char** argv) {
  using namespace medial_vk::bench;
  CLI::App app("Unions of balls");
  unsigned threads = 2;
  int repeats = 5;
  bool made = false;
  std::size_t largest = 500000;
  std::vector<std::string> files;
  app.add_option("--repeats", repeats)->check(CLI::PositiveNumber);
  app.add_option("--threads", threads);
  app.add_flag("--made", made);
  app.add_option("--largest", largest);
  app.add_option("FILES", files);
  CLI11_PARSE(app, argc, argv);
  Table table(threads, repeats);
  Line of_files, of_made;
  for (const std::string& file : files) {
    const auto balls = read_balls(file);
    of_files.emplace_back(balls.size(), table.add(file, balls));
  }
  if (made) of_made = add_made(table, largest);
  fmt::print("\n");
  print_growth("the files", of_files);
  print_growth("random balls", of_made);
}
