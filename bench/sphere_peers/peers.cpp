#include "peers.h"

#include <array>

#include "../helpers.h"
#include "samples.h"
#include "sphere_fits/quality/measures.h"
#include "voxel_balls.h"

namespace medial_vk::bench {
namespace {

std::vector<Point> means(const Solid& solid, const PeerOptions& options) {
  KMeansOptions clusters = options.k_means;
  clusters.count = options.count;
  clusters.seed = options.seed;
  clusters.threads = options.threads;
  return k_means(solid, clusters);
}

std::vector<Ball> k_means_inside(const Solid& solid, const PeerOptions& options) {
  return largest_inside(solid, means(solid, options), options.threads);
}

std::vector<Ball> k_means_cover(const Solid& solid, const PeerOptions& options) {
  return smallest_around_cells(solid, means(solid, options), options.threads);
}

std::vector<Ball> set_cover(const Solid& solid, const PeerOptions& options) {
  SetCoverOptions all = options.set_cover;
  all.count = options.count;
  all.threads = options.threads;
  return greedy_set_cover(solid, all);
}

std::vector<Ball> set_cover_fitted(const Solid& solid, const PeerOptions& options) {
  PeerOptions all = options;
  all.set_cover.fits_offset = true;
  return set_cover(solid, all);
}

std::vector<Ball> descend(const Solid& solid, const PeerOptions& options, const LossWeights& weights) {
  GradientFitOptions all = options.descent;
  all.count = options.count;
  all.weights = weights;
  all.seed = options.seed;
  all.threads = options.threads;
  return gradient_fit(solid, all);
}

std::vector<Ball> gradient_published(const Solid& solid, const PeerOptions& options) {
  return descend(solid, options, kPublishedWeights);
}

std::vector<Ball> gradient_tuned(const Solid& solid, const PeerOptions& options) {
  return descend(solid, options, kTunedWeights);
}

std::vector<Ball> voxel_inside(const Solid& solid, const PeerOptions& options) {
  return voxel_balls_inside(solid, options.count, options.threads);
}

std::vector<Ball> voxel_circumscribed(const Solid& solid, const PeerOptions& options) {
  return voxel_cover(solid, options.count, options.threads);
}

constexpr std::array<PeerMethod, 8> kPeerMethods = {{{"set-cover", PeerPromise::kInside, set_cover},
                                                     {"set-cover-fitted", PeerPromise::kInside, set_cover_fitted},
                                                     {"k-means-inside", PeerPromise::kInside, k_means_inside},
                                                     {"voxel-inside", PeerPromise::kInside, voxel_inside},
                                                     {"k-means-cover", PeerPromise::kCover, k_means_cover},
                                                     {"voxel-cover", PeerPromise::kCover, voxel_circumscribed},
                                                     {"gradient-published", PeerPromise::kNone, gradient_published},
                                                     {"gradient-tuned", PeerPromise::kNone, gradient_tuned}}};

}  // namespace

std::span<const PeerMethod> peer_methods() { return kPeerMethods; }

PeerMeasures measure_peer(const Solid& solid, std::span<const Ball> balls, unsigned threads) {
  MeasureOptions options;
  options.threads = threads;
  const SphereMeasures found = or_exit(measure_spheres(solid, balls, options));
  const double percent = 100 / found.volume.solid, of_diagonal = 100 / found.diagonal;
  PeerMeasures measures;
  measures.spheres = balls.size();
  measures.is_inside = found.inside.proved();
  measures.is_cover = found.cover.proved();
  measures.uncovered = percent * found.volume.uncovered;
  measures.added = percent * found.volume.outside;
  measures.standard_error = 100 * found.volume.normalized_standard_error();
  measures.protrusion = of_diagonal * found.distances.balls_to_solid.upper;
  measures.hausdorff = of_diagonal * found.distances.between_surfaces().upper;
  return measures;
}

}  // namespace medial_vk::bench
