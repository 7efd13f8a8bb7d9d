// Iterated foam sampling (Section 3.5, problem 2): spheres that DECIDEMS leaves undetermined get the centres of their
// full foam as new samples, repeatedly. The output is the number still undetermined, the actual misses, and their
// bounds by the foam. docs/foam.md has the table.
//   bench_foam_iterations [SPHERES [POINTS [ITERATIONS [RESOLUTION]]]]
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "base/point_ops.h"
#include "helpers.h"
#include "medial_vk/bvh.h"
#include "medial_vk/foam.h"
#include "medial_vk/mesh.h"
#include "support/solids/solids.h"

namespace {

using namespace medial_vk;
using bench::median;

constexpr std::uint32_t kMostSpiralPoints = 200;  // each has its own site, and time grows with sites * samples
constexpr double kQueryError = 1e-14;             // of distances to meshes of size 1 by Bvh

struct Settings {
  std::size_t spheres = 8;   // per solid
  std::uint32_t points = 6;  // spiral points of the first sampling
  int iterations = 2;
  double resolution = 10;  // voxels along the longest side
};

struct Solid {
  std::string name;
  Mesh mesh;
};

std::vector<Solid> solids() {
  std::vector<Solid> out = {{"box", test::make_box({1, 0.7, 0.45})},
                            {"L shape", test::make_l_shape(1, 0.4, 0.5)},
                            {"ellipsoid", test::make_ellipsoid({0.5, 0.35, 0.25}, 24)},
                            {"torus", test::make_torus(0.35, 0.15, 24, 48)}};
  for (Solid& s : out) test::rotate(s.mesh, {0.3, 0.5, 0.8}, 0.7);
  return out;
}

/// A medial point by brute force: its width and its depth in the sphere.
struct Medial {
  double width, depth;
};

/// Grows balls from random points of the sphere's ball away from their contacts until they touch elsewhere.
std::vector<Medial> medial_points(const Bvh& bvh, const Ball& sphere, int tries) {
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> share(-1, 1);
  std::vector<Medial> out;
  while (tries > 0) {
    const Point offset = {share(engine), share(engine), share(engine)};
    if (length(offset) > 1) continue;
    --tries;
    const Point start = sphere.centre + sphere.radius * offset, contact = bvh.closest(start).point;
    const Point away = (1 / length(start - contact)) * (start - contact);
    double low = 0, high = 2 * sphere.radius;
    const auto changed = [&](double s) {
      const Point p = start + s * away;
      return length(p - contact) > std::sqrt(bvh.closest(p).squared_distance) + 1e-13;
    };
    if (!changed(high)) continue;
    for (int i = 0; i < 50; ++i) (changed((low + high) / 2) ? high : low) = (low + high) / 2;
    const Point m = start + high * away;
    const double depth = sphere.radius - length(m - sphere.centre);
    if (depth > 0) out.push_back({length(bvh.closest(m).point - contact), depth});
  }
  return out;
}

/// The results of one sphere in all iterations.
struct Run {
  SphereSamples samples;
  std::vector<Medial> medial;
};

/// The contents of one row of the table, for the spheres that are still undetermined.
struct Row {
  std::vector<double> samples, sites, widths, depths, uncovered;
  std::size_t undetermined = 0, with_medial_points = 0;
  double widest = 0, deepest = 0, seconds = 0;
};

double largest(const std::vector<double>& values) {
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

/// Spheres around voxels, inside the solid and clear of its boundary, that the first sampling leaves undetermined:
/// those that do hold medial points wider than 1 % of a side first, then the others.
std::vector<Run> undetermined_spheres(const Bvh& bvh, const Settings& settings, double side, std::uint32_t points,
                                      const NearestPointsFunction& nearest) {
  const BvhBox box = bvh.nodes().front().box;
  std::vector<Run> holding, others;
  for (double z = box.lower[2] + side / 2; z < box.upper[2]; z += side) {
    for (double y = box.lower[1] + side / 2; y < box.upper[1]; y += side) {
      for (double x = box.lower[0] + side / 2; x < box.upper[0]; x += side) {
        const Ball sphere = sphere_around_voxel({x, y, z}, side);
        if (bvh.any_within(sphere.centre, sphere.radius)) continue;
        auto samples = sample_sphere(sphere, {.count = points, .query_error = kQueryError}, nearest);
        if (!samples.ok() || samples.value().holds_medial_point) continue;
        Run run = {std::move(samples).value(), medial_points(bvh, sphere, 300)};
        const bool holds =
            std::any_of(run.medial.begin(), run.medial.end(), [&](const Medial& m) { return m.width > 0.01 * side; });
        (holds ? holding : others).push_back(std::move(run));
      }
    }
  }
  // Half of the requested spheres hold medial points, if there are enough; both kinds are spread evenly over the solid.
  std::vector<Run> out;
  const auto take = [&](std::vector<Run>& from, std::size_t wanted) {
    for (std::size_t k = 0; k < std::min(wanted, from.size()); ++k)
      out.push_back(std::move(from[k * from.size() / std::min(wanted, from.size())]));
  };
  fmt::print(stderr, "{} undetermined spheres hold medial points, {} do not\n", holding.size(), others.size());
  take(holding, settings.spheres / 2);
  take(others, settings.spheres - out.size());
  return out;
}

void measure(const Run& run, const Foam& foam, double side, Row& row) {
  const double radius = run.samples.sphere.radius;
  ++row.undetermined;
  row.samples.push_back(static_cast<double>(run.samples.samples.size()));
  row.sites.push_back(static_cast<double>(foam.sites().size()));
  row.widths.push_back(foam.width_bound(radius / 4) / side);
  row.depths.push_back(foam.depth_bound(2 * radius) / radius);
  row.uncovered.push_back(foam.uncovered_depth() / radius);
  bool holds = false;
  for (const Medial& m : run.medial) {
    holds = holds || m.width > 0.01 * side;
    row.widest = std::max(row.widest, m.depth >= radius / 4 ? m.width / side : 0);
    if (m.width > 2 * radius) row.deepest = std::max(row.deepest, m.depth / radius);
  }
  row.with_medial_points += holds;
}

void print(const std::string& name, const std::string& iteration, const Row& row) {
  fmt::print(
      "| {} | {} | {} | {} | {:.0f} | {:.0f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.1f} "
      "|\n",
      name, iteration, row.undetermined, row.with_medial_points, median(row.samples), median(row.sites), row.widest,
      median(row.widths), largest(row.widths), row.deepest, median(row.depths), largest(row.depths),
      median(row.uncovered), row.undetermined == 0 ? 0 : row.seconds / static_cast<double>(row.undetermined));
  std::fflush(stdout);
}

/// Measures the same spheres with one denser sampling instead.
bool measure_spiral(const std::vector<Run>& runs, std::uint32_t points, double side,
                    const NearestPointsFunction& nearest, Row& row) {
  for (const Run& run : runs) {
    const auto start = std::chrono::steady_clock::now();
    auto samples = sample_sphere(run.samples.sphere, {.count = points, .query_error = kQueryError}, nearest);
    if (!samples.ok()) return false;
    if (samples.value().holds_medial_point) continue;
    const auto foam = Foam::build(samples.value().samples, run.samples.sphere, kQueryError);
    if (!foam.ok()) return false;
    measure({std::move(samples).value(), run.medial}, foam.value(), side, row);
    row.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  return true;
}

bool iterate(const Solid& solid, const Settings& settings) {
  const MeshView view = {solid.mesh.vertices, solid.mesh.triangles, {}, true};
  const auto bvh = Bvh::build(view);
  if (!bvh.ok()) return false;
  const NearestPointsFunction nearest = [&](std::span<const Point> queries) -> Result<std::vector<Point>> {
    std::vector<Point> out;
    for (const Point& q : queries) out.push_back(bvh.value().closest(q).point);
    return out;
  };
  const BvhBox box = bvh.value().nodes().front().box;
  const Point extent = box.upper - box.lower;
  const double side = std::max({extent[0], extent[1], extent[2]}) / settings.resolution;
  std::vector<Run> runs = undetermined_spheres(bvh.value(), settings, side, settings.points, nearest);
  const std::vector<Run> first = runs;
  for (int iteration = 0; iteration <= settings.iterations; ++iteration) {
    Row row;
    for (Run& run : runs) {
      if (run.samples.holds_medial_point) continue;
      const auto start = std::chrono::steady_clock::now();
      const auto foam = Foam::build(run.samples.samples, run.samples.sphere, kQueryError);
      if (!foam.ok()) return false;
      measure(run, foam.value(), side, row);
      if (iteration < settings.iterations && !refine_samples(foam.value(), kQueryError, nearest, run.samples).ok())
        return false;
      row.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    print(solid.name, std::to_string(iteration), row);
    const auto spiral_points = static_cast<std::uint32_t>(median(row.samples) / 2);
    if (iteration == 0 || spiral_points == 0 || spiral_points > kMostSpiralPoints) continue;
    Row spiral;
    if (!measure_spiral(first, spiral_points, side, nearest, spiral)) return false;
    print(solid.name, fmt::format("spiral of {}", spiral_points), spiral);
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  if (argc > 1) settings.spheres = static_cast<std::size_t>(std::atoi(argv[1]));
  if (argc > 2) settings.points = static_cast<std::uint32_t>(std::atoi(argv[2]));
  if (argc > 3) settings.iterations = std::atoi(argv[3]);
  if (argc > 4) settings.resolution = std::atof(argv[4]);
  fmt::print(
      "| solid | iteration | undetermined | hold medial points | samples | sites | widest missed | width bound | "
      "largest | deepest missed | depth bound | largest | uncovered | s |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Solid& solid : solids()) {
    if (!iterate(solid, settings)) {
      fmt::print(stderr, "foam_iterations: {} failed\n", solid.name);
      return 1;
    }
  }
  return 0;
}
