// Which part of the surface between sites has points: random samples of it against the voxels of points, for ten
// arrangements, with times.
//   bench_sites_recall [--samples N] [--resolution N] [--detail N] [--first N]
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <chrono>
#include <ctime>

#include "support/site_voronoi/arrangements.h"
#include "support/site_voronoi/site_sampler.h"

namespace {

using namespace medial_vk;

constexpr double kLeastAngleOfSamples = 0x1p-12;  // twice that of points of the surface

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void measure(const test::SiteArrangement& arrangement, std::uint32_t resolution, std::uint32_t wanted) {
  SiteVoronoiOptions options;
  options.resolution = resolution;
  const double begin = processor_seconds();
  const Result<SiteVoronoi> found = find_site_voronoi(arrangement.sites, options);
  const double seconds = processor_seconds() - begin;
  if (!found) {
    fmt::print("{}: {}\n", arrangement.name, found.error().message);
    return;
  }
  const SiteVoronoi& voronoi = found.value();
  test::SiteSampler sampler(arrangement.sites, voronoi.grid, 33);
  const test::SampledVoxels voxels(voronoi);
  std::array<std::uint64_t, 4> counts = {};  // by SampleState
  for (std::uint32_t samples = 0; samples < wanted;) {
    const std::optional<test::SiteSample> sample = sampler.next();
    if (!sample || sample->object_angle < kLeastAngleOfSamples) continue;
    ++counts[static_cast<std::size_t>(voxels.state_of(*sample))];
    ++samples;
  }
  const auto of = [&](test::SampleState state) { return counts[static_cast<std::size_t>(state)]; };
  fmt::print("| {} | {} | {} | {} | {} | {} | {} | {:.2f} | {:.1f} |\n", arrangement.name, voronoi.points.size(),
             voronoi.undecided.size(), of(test::SampleState::kFound), of(test::SampleState::kUndecided),
             of(test::SampleState::kLeftOut), of(test::SampleState::kLost), seconds,
             1e6 * seconds / static_cast<double>(voronoi.points.size()));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Recall of the surface between sites");
  std::uint32_t samples = 100000, resolution = 160, detail = 64, first = 0;
  app.add_option("--samples", samples, "of each arrangement");
  app.add_option("--resolution", resolution, "voxels along the longest side");
  app.add_option("--detail", detail, "edges around round meshes");
  app.add_option("--first", first, "arrangement, from 0, to begin with");
  CLI11_PARSE(app, argc, argv);
  fmt::print(
      "| arrangement | points | undecided voxels | samples found | undecided | left out | lost | CPU seconds | "
      "microseconds a point |\n|---|---|---|---|---|---|---|---|---|\n");
  const std::vector<test::SiteArrangement> all = test::site_arrangements(detail);
  for (std::size_t i = first; i < all.size(); ++i) measure(all[i], resolution, samples);
  return 0;
}
