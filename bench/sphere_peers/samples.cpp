#include "samples.h"

#include <algorithm>
#include <cmath>

#include "../helpers.h"
#include "base/parallel.h"
#include "base/point_ops.h"
#include "base/split_mix.h"
#include "medial_vk/sphere_proofs.h"
#include "sphere_fits/quality/surface_samples.h"

namespace medial_vk::bench {

std::vector<Point> points_inside(const Solid& solid, std::size_t count, std::uint64_t seed, unsigned threads) {
  constexpr std::size_t kBatch = 4096;
  const Point lower = solid.mesh().report.lower, size = solid.mesh().report.upper - lower;
  SplitMix random(seed);
  std::vector<Point> found, batch(kBatch);
  std::vector<std::uint8_t> is_inside(kBatch);
  while (found.size() < count) {
    for (Point& p : batch) {
      for (std::size_t k = 0; k < 3; ++k) p[k] = lower[k] + size[k] * 0.5 * (random.symmetric() + 1);
    }
    parallel_for(kBatch, 64, threads, [&](std::size_t i) { is_inside[i] = solid.contains(batch[i]) ? 1 : 0; });
    for (std::size_t i = 0; i < kBatch && found.size() < count; ++i) {
      if (is_inside[i] != 0) found.push_back(batch[i]);
    }
  }
  return found;
}

std::vector<SurfacePoint> points_of_boundary(const Solid& solid, std::size_t count) {
  const Mesh& mesh = solid.mesh().mesh;
  std::vector<SurfacePoint> found;
  found.reserve(count);
  for (const Point& at : sample_surface(mesh, count)) {
    const Triangle& t = mesh.triangles[solid.closest(at).triangle];
    const Point normal = cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    found.push_back({at, (1 / length(normal)) * normal});
  }
  return found;
}

Depth depth_of(const Solid& solid, const Point& p) {
  const BvhHit hit = solid.closest(p);
  const double distance = std::sqrt(hit.squared_distance);
  const double depth = solid.contains(p) ? distance : -distance;
  if (distance == 0) return {0, {0, 0, 0}};
  return {depth, (1 / depth) * (p - hit.point)};
}

std::vector<Ball> largest_inside(const Solid& solid, std::span<const Point> centres, unsigned threads) {
  std::vector<double> depths(centres.size());
  ProofOptions options;
  options.threads = threads;
  exit_unless(measure_depths(solid.indexed(), centres, depths, options));
  std::vector<Ball> balls;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    if (depths[i] > 0) balls.push_back({centres[i], depths[i]});
  }
  return balls;
}

}  // namespace medial_vk::bench
