// Volumes of unions of balls, and areas of their envelopes: the host in double precision against a device in float.
//   bench_unions_on_device [--balls N,N,...] [--repeats N] [--threads N] [--device INDEX|NAME] [--no-device]
// The balls lie along a bent sheet, as medial balls do: their number grows as with the resolution of one solid, so each
// overlaps 4.5 % of all.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "../helpers.h"
#include "medial_vk/ball_union.h"
#include "medial_vk/context.h"

namespace {

using namespace medial_vk;
using bench::or_exit;
using Clock = std::chrono::steady_clock;

std::vector<Ball> balls_along_a_sheet(std::size_t count) {
  const auto side = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(count))));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> beside(-0.3, 0.3);
  std::vector<Ball> balls;
  for (std::size_t k = 0; k < side * side; ++k) {
    const double x = (static_cast<double>(k % side) + beside(random)) / static_cast<double>(side);
    const double y = (static_cast<double>(k / side) + beside(random)) / static_cast<double>(side);
    balls.push_back({{x, y, 0.1 * std::sin(3 * x) * std::cos(2 * y)}, 0.12 + 0.05 * std::sin(4 * x + y)});
  }
  return balls;
}

/// The least time of some runs, in seconds, after one that compiles.
template <class Run>
double time_of(int repeats, const Run& run) {
  double least = HUGE_VAL;
  for (int k = 0; k <= repeats; ++k) {
    const Clock::time_point begin = Clock::now();
    run();
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    if (k > 0) least = std::min(least, seconds);
  }
  return least;
}

double largest_ratio(const std::vector<double>& a, const std::vector<double>& b, const std::vector<double>& bounds) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (bounds[i] > 0) largest = std::max(largest, std::fabs(a[i] - b[i]) / bounds[i]);
  }
  return largest;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::size_t> counts = {20'000, 100'000, 500'000};
  int repeats = 3;
  unsigned threads = 0;
  std::string device;
  bool no_device = false;
  CLI::App app("Unions of balls, host against device");
  app.add_option("--balls", counts, "how many")->delimiter(',');
  app.add_option("--repeats", repeats, "runs of which the fastest counts");
  app.add_option("--threads", threads, "of the host; 0: one per core");
  app.add_option("--device", device, "index or name");
  app.add_flag("--no-device", no_device, "the host alone");
  CLI11_PARSE(app, argc, argv);

  std::vector<Context> context;
  ContextOptions where;
  where.device = device;
  if (!no_device) context.push_back(or_exit(Context::create(where)));
  if (!no_device) fmt::print("Device: {}\n\n", context[0].device().name);
  fmt::print(
      "| balls | host s | balls/s | device s | balls/s | redone | volume error | bound | worst error / bound |\n");
  fmt::print("|---|---|---|---|---|---|---|---|---|\n");
  for (const std::size_t count : counts) {
    const std::vector<Ball> balls = balls_along_a_sheet(count);
    const auto size = static_cast<double>(balls.size());
    BallUnion exact;
    const double host = time_of(repeats, [&] { exact = or_exit(measure_ball_union(balls, {.threads = threads})); });
    fmt::print("| {} | {:.3f} | {:.0f} ", balls.size(), host, size / host);
    if (!no_device) {
      DeviceBallUnion found;
      const double there =
          time_of(repeats, [&] { found = or_exit(measure_ball_union(balls, {.threads = threads}, context[0])); });
      fmt::print("| {:.3f} | {:.0f} | {} | {:.1e} | {:.1e} | {:.3f} ", there, size / there, found.redone.size(),
                 std::fabs(found.volume - exact.volume) / exact.volume, found.volume_bound / exact.volume,
                 largest_ratio(found.volumes, exact.volumes, found.volume_bounds));
    }
    fmt::print("|\n");
    std::fflush(stdout);
  }
}
