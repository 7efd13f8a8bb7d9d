#include "sphere_fits/quality/measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <numbers>

#include "base/host_memory.h"
#include "base/point_ops.h"
#include "sphere_fits/quality/surface_samples.h"

namespace medial_vk {
namespace {

/// The greatest and the least number of cells along a side of the grid over the solid's box; two samples are taken in
/// each cell.
constexpr std::size_t kStrata = 96, kLeastStrata = 24;
constexpr std::size_t kBlock = 4;  // cells along the side of a block
/// Number of samples on each sphere, as in cuRobo.
constexpr std::size_t kSpherePoints = 200;
constexpr std::size_t kBins = 48;

/// A number in [0, 1) that depends only on the arguments (S. Vigna's splitmix64).
double random_number(std::uint64_t seed, std::uint64_t number) {
  std::uint64_t x = seed * 0x9e3779b97f4a7c15ull + number * 0xd1342543de82ef95ull + 0x632be59bd9b4e019ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  x ^= x >> 31;
  return static_cast<double>(x >> 11) * 0x1p-53;
}

/// The side of the boundary on which a box lies.
SolidSide side_of(const Solid& solid, const Point& lower, const Point& size) {
  return solid.side_of_ball(lower + 0.5 * size, 0.5 * length(size));
}

/// Two volumes, by two points in each cell of a grid: the squares of their differences add up to the variance. Most
/// cells, and whole blocks of them, lie on one side of the boundary; only in the others are points tested against the
/// solid.
class VolumeSampler {
 public:
  struct Estimate {
    double value = 0, variance = 0;

    void add(const Estimate& other) {
      value += other.value;
      variance += other.variance;
    }
    void add(const std::array<bool, 2>& pair, double volume) {
      value += volume * ((pair[0] ? 0.5 : 0.0) + (pair[1] ? 0.5 : 0.0));
      if (pair[0] != pair[1]) variance += volume * volume / 4;
    }
  };
  struct Volumes {
    Estimate uncovered, solid;
  };

  VolumeSampler(const Solid& solid, const NearestBallTree& balls, std::uint64_t seed)
      : solid_(solid), balls_(balls), seed_(seed), lower_(solid.mesh().report.lower) {
    const Point size = solid.mesh().report.upper - lower_;
    const double side = std::max({size[0], size[1], size[2]}) / static_cast<double>(kStrata);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto least = static_cast<double>(kLeastStrata), most = static_cast<double>(kStrata);
      count_[k] = static_cast<std::size_t>(std::clamp(std::ceil(size[k] / side), least, most));
      cell_[k] = size[k] / static_cast<double>(count_[k]);
      blocks_[k] = (count_[k] + kBlock - 1) / kBlock;
    }
  }

  Volumes run(const Threads& threads) const {
    std::vector<Volumes> parts(blocks_[0] * blocks_[1] * blocks_[2]);
    for_all(parts.size(), 4, threads, [&](std::size_t i) {
      parts[i] = in_block({i % blocks_[0], i / blocks_[0] % blocks_[1], i / blocks_[0] / blocks_[1]}, threads);
    });
    Volumes all;
    for (const Volumes& part : parts) {
      all.uncovered.add(part.uncovered);
      all.solid.add(part.solid);
    }
    return all;
  }

 private:
  using Cell = std::array<std::size_t, 3>;
  static constexpr std::size_t kCellsOfBlock = kBlock * kBlock * kBlock;
  using BlockSides = std::array<SolidSide, kCellsOfBlock>;  // by index_in_block()

  Point corner(const Cell& cell) const {
    Point at = lower_;
    for (std::size_t k = 0; k < 3; ++k) at[k] += cell_[k] * static_cast<double>(cell[k]);
    return at;
  }

  Volumes in_block(const Cell& block, const Threads& threads) const {
    Cell from, to;
    for (std::size_t k = 0; k < 3; ++k) {
      from[k] = kBlock * block[k];
      to[k] = std::min(from[k] + kBlock, count_[k]);
    }
    const SolidSide side = side_of(solid_, corner(from), corner(to) - corner(from));
    Volumes sum;
    if (side == SolidSide::kOutside) return sum;
    threads.check();
    BlockSides sides;
    sides.fill(side);
    if (side == SolidSide::kUnknown) find_sides(from, to, sides);
    for_cells(from, to, [&](const Cell& cell) { add_cell(cell, sides[index_in_block(from, cell)], sum); });
    return sum;
  }

  /// Of cells that touch face to face and whose balls the boundary does not meet, one is tested for all: paths in these
  /// balls join them, within a radius that holds the block.
  void find_sides(const Cell& from, const Cell& to, BlockSides& sides) const {
    const double of_cell = 0.5 * length(cell_), of_block = length(corner(to) - corner(from)) + of_cell;
    std::array<bool, kCellsOfBlock> is_free{};
    for_cells(from, to,
              [&](const Cell& c) { is_free[index_in_block(from, c)] = !solid_.may_meet(middle(c), of_cell); });
    for_cells(from, to, [&](const Cell& first) {
      if (!is_free[index_in_block(from, first)] || sides[index_in_block(from, first)] != SolidSide::kUnknown) return;
      const SolidSide side = solid_.side_around(middle(first), of_block);
      if (side == SolidSide::kUnknown) {
        sides[index_in_block(from, first)] = solid_.side_around(middle(first), of_cell);
        return;
      }
      std::vector<Cell> waiting = {first};
      while (!waiting.empty()) {
        const Cell cell = waiting.back();
        waiting.pop_back();
        sides[index_in_block(from, cell)] = side;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          for (const bool up : {false, true}) {
            if (up ? cell[axis] + 1 == to[axis] : cell[axis] == from[axis]) continue;
            Cell next = cell;
            next[axis] = up ? cell[axis] + 1 : cell[axis] - 1;
            if (is_free[index_in_block(from, next)] && sides[index_in_block(from, next)] == SolidSide::kUnknown)
              waiting.push_back(next);
          }
        }
      }
    });
  }

  static std::size_t index_in_block(const Cell& from, const Cell& cell) {
    return cell[0] - from[0] + kBlock * (cell[1] - from[1] + kBlock * (cell[2] - from[2]));
  }

  template <class Visit>
  static void for_cells(const Cell& from, const Cell& to, Visit visit) {
    for (std::size_t z = from[2]; z < to[2]; ++z) {
      for (std::size_t y = from[1]; y < to[1]; ++y) {
        for (std::size_t x = from[0]; x < to[0]; ++x) visit(Cell{x, y, z});
      }
    }
  }

  Point middle(const Cell& cell) const { return corner(cell) + 0.5 * cell_; }

  void add_cell(const Cell& cell, SolidSide side, Volumes& sum) const {
    const Point lower = corner(cell);
    if (side == SolidSide::kOutside) return;
    const std::size_t number = cell[0] + count_[0] * (cell[1] + count_[1] * cell[2]);
    std::array<bool, 2> in_solid, uncovered;
    for (std::size_t n = 0; n < 2; ++n) {
      Point at = lower;
      for (std::size_t k = 0; k < 3; ++k) at[k] += cell_[k] * random_number(seed_, 6 * number + 3 * n + k);
      in_solid[n] = side == SolidSide::kInside || solid_.contains(at);
      uncovered[n] = in_solid[n] && !balls_.holds(at);
    }
    const double volume = cell_[0] * cell_[1] * cell_[2];
    sum.solid.add(in_solid, volume);
    sum.uncovered.add(uncovered, volume);
  }

  const Solid& solid_;
  const NearestBallTree& balls_;
  std::uint64_t seed_;
  Point lower_, cell_;
  Cell count_, blocks_;
};

VolumeError measure_volume(const Solid& solid, const Envelope& envelope, bool is_inside, bool is_cover,
                           const MeasureOptions& options) {
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
  const VolumeSampler::Volumes sampled = VolumeSampler(solid, envelope.tree(), options.seed).run(options.threads);
  error.uncovered = sampled.uncovered.value;
  error.standard_error = std::sqrt(sampled.uncovered.variance);
  if (!known) {
    error.solid = sampled.solid.value;
    error.standard_error += std::sqrt(sampled.solid.variance);
  }
  if (is_inside && solid.mesh().report.closed) {
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

/// The 95th percentile, interpolated between the two nearest values.
double p95_of(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const double position = 0.95 * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const double above = values[std::min(below + 1, values.size() - 1)];
  return values[below] + (position - static_cast<double>(below)) * (above - values[below]);
}

/// Distances to the boundary of those points of all spheres that are outside the solid.
std::vector<double> distances_outside(const Solid& solid, std::span<const Ball> balls, const Threads& threads) {
  std::vector<std::vector<double>> by_ball(balls.size());
  for_all(balls.size(), 4, threads, [&](std::size_t i) {
    const Ball& ball = balls[i];
    const bool closed = solid.mesh().report.closed;  // otherwise balls may reach through holes
    if (closed && ball.radius <= solid.distance(ball.centre) && solid.contains(ball.centre)) return;
    for (std::size_t k = 0; k < kSpherePoints; ++k) {
      if (k % 8 == 0) threads.check();
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
  const std::vector<double> out = distances_outside(solid, balls, options.threads);
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
    const double position = (sample.distance - lower) / (upper - lower) * static_cast<double>(kBins);
    out.share[std::min(kBins - 1, static_cast<std::size_t>(std::max(0.0, position)))] += sample.area / area;
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

Result<VolumeError> estimate_volume_error(const Solid& solid, std::span<const Ball> balls,
                                          const MeasureOptions& options) {
  const Result<Envelope> envelope = Envelope::build(balls, options.threads.count);
  if (!envelope) return envelope.error();
  return measure_volume(solid, envelope.value(), false, false, options);
}

double VolumeError::normalized_lower_bound() const { return solid > 0 ? std::fabs(balls - solid) / solid : 0; }

Result<SphereMeasures> measure_spheres(const Solid& solid, std::span<const Ball> balls, const MeasureOptions& options) {
  if (balls.empty()) return Error{ErrorCode::kUsage, "no balls to measure"};
  try {
    Result<Envelope> envelope = Envelope::build(balls, options.threads.count);
    if (!envelope) return envelope.error();
    SphereMeasures measures;
    measures.diagonal = solid.diagonal();
    measures.inside = prove_inside(solid, balls, options.threads);
    Result<CoverProof> cover = prove_cover(solid, envelope.value(), options.threads);
    if (!cover) return cover.error();
    measures.cover = cover.value();
    const bool is_inside = measures.inside.proved(), is_cover = measures.cover.proved();
    measures.volume = measure_volume(solid, envelope.value(), is_inside, is_cover, options);
    EnvelopeOptions limits;
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
  } catch (const Stopped&) {
    return Error{ErrorCode::kInterrupted, "interrupted"};
  } catch (const std::bad_alloc&) {
    return out_of_memory("measuring the balls");
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
