#include "spheres/measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <numbers>

#include "mesh/point_ops.h"
#include "spheres/surface_samples.h"

namespace medial_vk {
namespace {

/// Cells of a grid over the solid's box, at most so many along a side, in each of which two samples are taken.
constexpr std::size_t kStrata = 44;
/// On each sphere, as cuRobo takes them.
constexpr std::size_t kSpherePoints = 200;
constexpr std::size_t kBins = 48;

/// A number in [0, 1) that depends on nothing but its arguments (S. Vigna's splitmix64).
double random_number(std::uint64_t seed, std::uint64_t number) {
  std::uint64_t x = seed * 0x9e3779b97f4a7c15ull + number * 0xd1342543de82ef95ull + 0x632be59bd9b4e019ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  x ^= x >> 31;
  return static_cast<double>(x >> 11) * 0x1p-53;
}

struct Estimate {
  double value = 0, variance = 0;
};

/// The integrals over a box of as many functions as `sample(point)` has values: two points in each cell of a grid; the
/// squares of their differences add up to the variance.
template <std::size_t N, class Sample>
std::array<Estimate, N> integrate(const Point& lower, const Point& upper, std::uint64_t seed, unsigned threads,
                                  Sample sample) {
  const Point size = upper - lower;
  const double side = std::max({size[0], size[1], size[2]}) / static_cast<double>(kStrata);
  std::array<std::size_t, 3> count;
  Point cell;
  for (std::size_t k = 0; k < 3; ++k) {
    count[k] = static_cast<std::size_t>(std::clamp(std::ceil(size[k] / side), 1.0, static_cast<double>(kStrata)));
    cell[k] = size[k] / static_cast<double>(count[k]);
  }
  const std::size_t all = count[0] * count[1] * count[2];
  std::vector<std::array<std::array<double, N>, 2>> values(all);
  for_all(all, 64, threads, [&](std::size_t i) {
    const std::array<std::size_t, 3> at = {i % count[0], i / count[0] % count[1], i / count[0] / count[1]};
    for (std::size_t s = 0; s < 2; ++s) {
      Point p;
      for (std::size_t k = 0; k < 3; ++k) {
        p[k] = lower[k] + cell[k] * (static_cast<double>(at[k]) + random_number(seed, 6 * i + 3 * s + k));
      }
      values[i][s] = sample(p);
    }
  });
  const double volume = cell[0] * cell[1] * cell[2];
  std::array<Estimate, N> out;
  for (const auto& pair : values) {
    for (std::size_t n = 0; n < N; ++n) {
      const double difference = pair[0][n] - pair[1][n];
      out[n].value += volume * (pair[0][n] + pair[1][n]) / 2;
      out[n].variance += volume * volume * difference * difference / 4;
    }
  }
  return out;
}

VolumeError measure_volume(const Solid& solid, const Envelope& envelope, bool is_inside, bool is_cover,
                           const MeasureOptions& options) {
  const MeshReport& report = solid.mesh().report;
  VolumeError error;
  error.balls = envelope.measured().volume;
  const bool known = solid.has_volume();
  error.solid = known ? solid.volume() : 0;
  if (known && is_inside) {
    error.uncovered = std::max(0.0, error.solid - error.balls);
    return error;
  }
  if (known && is_cover) {
    error.outside = std::max(0.0, error.balls - error.solid);
    return error;
  }
  const NearestBallTree& tree = envelope.tree();
  const auto sampled = integrate<2>(report.lower, report.upper, options.seed, options.threads, [&](const Point& p) {
    const bool in_balls = tree.holds(p);
    // Where the solid's volume is known, only what is in no ball must be looked at.
    const bool in_solid = (!known || !in_balls) && solid.contains(p);
    return std::array<double, 2>{in_solid && !in_balls ? 1.0 : 0.0, in_solid ? 1.0 : 0.0};
  });
  error.uncovered = sampled[0].value;
  error.standard_error = std::sqrt(sampled[0].variance);
  if (!known) {
    error.solid = sampled[1].value;
    error.standard_error = std::sqrt(sampled[0].variance) + std::sqrt(sampled[1].variance);
  }
  if (is_inside) {
    error.uncovered = std::max(0.0, error.solid - error.balls);
    return error;
  }
  error.outside = std::max(0.0, error.balls - (error.solid - error.uncovered));
  return error;
}

double mean_of(const std::vector<double>& values) {
  CompensatedSum sum;
  for (const double value : values) sum.add(value);
  return values.empty() ? 0 : sum.value() / static_cast<double>(values.size());
}

/// The value that 95 % are no greater than, between the two nearest.
double p95_of(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const double place = 0.95 * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const double above = values[std::min(below + 1, values.size() - 1)];
  return values[below] + (place - static_cast<double>(below)) * (above - values[below]);
}

/// Distances to the boundary of those points of all spheres that are outside the solid.
std::vector<double> protruding(const Solid& solid, std::span<const Ball> balls, unsigned threads) {
  std::vector<std::vector<double>> by_ball(balls.size());
  for_all(balls.size(), 4, threads, [&](std::size_t i) {
    const Ball& ball = balls[i];
    if (ball.radius <= solid.distance(ball.centre) && solid.contains(ball.centre)) return;
    for (std::size_t k = 0; k < kSpherePoints; ++k) {
      const Point at = ball.centre + ball.radius * spiral_point(k, kSpherePoints);
      if (!solid.contains(at)) by_ball[i].push_back(solid.distance(at));
    }
  });
  std::vector<double> all;
  for (const auto& part : by_ball) all.insert(all.end(), part.begin(), part.end());
  return all;
}

SphereFitMetrics fit_metrics(const Solid& solid, const Envelope& envelope, const std::vector<Point>& surface,
                             const SphereMeasures& measures, const MeasureOptions& options) {
  const std::vector<Ball>& balls = envelope.tree().balls();
  SphereFitMetrics metrics;
  metrics.num_spheres = balls.size();
  const VolumeError& volume = measures.volume;
  metrics.coverage = volume.solid > 0 ? 1 - volume.uncovered / volume.solid : 0;
  const std::vector<double> out = protruding(solid, balls, options.threads);
  metrics.protrusion = static_cast<double>(out.size()) / static_cast<double>(kSpherePoints * balls.size());
  metrics.protrusion_dist_mean = mean_of(out);
  metrics.protrusion_dist_p95 = p95_of(out);
  std::vector<double> gaps(surface.size());
  for_all(surface.size(), 256, options.threads,
          [&](std::size_t i) { gaps[i] = std::max(0.0, envelope.tree().nearest(surface[i]).distance); });
  metrics.surface_gap_mean = mean_of(gaps);
  metrics.surface_gap_p95 = p95_of(std::move(gaps));
  metrics.max_uncovered_gap = measures.distances.boundary_to_balls.upper;
  CompensatedSum sum;
  for (const Ball& ball : balls) sum.add(4 * std::numbers::pi / 3 * ball.radius * ball.radius * ball.radius);
  metrics.volume_ratio = volume.solid > 0 ? sum.value() / volume.solid : 0;
  return metrics;
}

struct Weighted {
  double distance, area;
};

SignedDistances summary_of(const std::vector<Weighted>& samples) {
  SignedDistances out;
  if (samples.empty()) return out;
  out.least = out.greatest = samples.front().distance;
  double area = 0;
  for (const Weighted& sample : samples) {
    out.least = std::min(out.least, sample.distance);
    out.greatest = std::max(out.greatest, sample.distance);
    out.mean += sample.area * sample.distance;
    out.mean_absolute += sample.area * std::fabs(sample.distance);
    area += sample.area;
  }
  out.mean /= area;
  out.mean_absolute /= area;
  return out;
}

void fill_bins(const std::vector<Weighted>& samples, double lower, double upper, SignedDistances& out) {
  out.lower = lower;
  out.upper = upper;
  out.share.assign(kBins, 0);
  double area = 0;
  for (const Weighted& sample : samples) area += sample.area;
  for (const Weighted& sample : samples) {
    const double place = (sample.distance - lower) / (upper - lower) * static_cast<double>(kBins);
    out.share[std::min(kBins - 1, static_cast<std::size_t>(std::max(0.0, place)))] += sample.area / area;
  }
}

DistanceHistograms histograms_of(const Solid& solid, const Envelope& envelope, const std::vector<Point>& surface,
                                 const MeasureOptions& options) {
  std::vector<Weighted> from_boundary(surface.size());
  for_all(surface.size(), 64, options.threads, [&](std::size_t i) {
    from_boundary[i] = {-envelope.signed_distance(surface[i]), 1};
  });
  const std::vector<WeightedPoint> points = sample_envelope(envelope, options.samples, options.threads);
  std::vector<Weighted> from_envelope(points.size());
  for_all(points.size(), 64, options.threads, [&](std::size_t i) {
    const double distance = solid.distance(points[i].at);
    from_envelope[i] = {solid.contains(points[i].at) ? -distance : distance, points[i].area};
  });
  DistanceHistograms out = {summary_of(from_boundary), summary_of(from_envelope)};
  const double lower = std::min(out.boundary_to_envelope.least, out.envelope_to_boundary.least);
  const double upper =
      std::max({out.boundary_to_envelope.greatest, out.envelope_to_boundary.greatest, lower + 1e-9 * solid.diagonal()});
  fill_bins(from_boundary, lower, upper, out.boundary_to_envelope);
  fill_bins(from_envelope, lower, upper, out.envelope_to_boundary);
  return out;
}

}  // namespace

double VolumeError::normalized_lower_bound() const { return solid > 0 ? std::fabs(balls - solid) / solid : 0; }

Result<SphereMeasures> measure_spheres(const Solid& solid, std::span<const Ball> balls, const MeasureOptions& options) {
  if (balls.empty()) return Error{ErrorCode::kUsage, "no balls to measure"};
  try {
    Result<Envelope> envelope = Envelope::build(balls, options.threads);
    if (!envelope) return envelope.error();
    SphereMeasures measures;
    measures.diagonal = solid.diagonal();
    measures.inside = prove_inside(solid, balls, options.threads);
    Result<CoverProof> cover = prove_cover(solid, envelope.value(), options.threads);
    if (!cover) return cover.error();
    measures.cover = cover.value();
    const bool is_inside = measures.inside.proved(), is_cover = measures.cover.proved();
    measures.volume = measure_volume(solid, envelope.value(), is_inside, is_cover, options);
    DistanceOptions limits;
    limits.tolerance = options.tolerance;
    limits.threads = options.threads;
    limits.known_inside = is_inside;
    limits.known_cover = is_cover;
    Result<EnvelopeDistances> distances = measure_distances(solid, envelope.value(), limits);
    if (!distances) return distances.error();
    measures.distances = distances.value();
    const std::vector<Point> surface = sample_surface(solid.mesh().mesh, options.samples);
    measures.metrics = fit_metrics(solid, envelope.value(), surface, measures, options);
    measures.histograms = histograms_of(solid, envelope.value(), surface, options);
    return measures;
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory, "not enough memory to measure the balls"};
  }
}

bool measure_against(double shape_volume, SphereMeasures& measures) {
  const bool is_cover = measures.cover.proved();
  if (!is_cover && !measures.inside.proved()) return false;
  VolumeError& volume = measures.volume;
  measures.metrics.volume_ratio *= volume.solid / shape_volume;
  volume.solid = shape_volume;
  volume.uncovered = is_cover ? 0 : std::max(0.0, shape_volume - volume.balls);
  volume.outside = is_cover ? std::max(0.0, volume.balls - shape_volume) : 0;
  volume.standard_error = 0;
  measures.metrics.coverage = 1 - volume.uncovered / shape_volume;
  return true;
}

}  // namespace medial_vk
