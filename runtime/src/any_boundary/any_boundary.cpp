#include "medial_vk/any_boundary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "any_boundary/certified_search.h"
#include "any_boundary/sphere_samples.h"
#include "any_boundary/thesis_search.h"
#include "base/host_memory.h"
#include "base/loop_watch.h"
#include "base/parallel.h"
#include "base/point_ops.h"
#include "base/spiral.h"
#include "base/voxel_order.h"
#include "extraction/common/check_options.h"

namespace medial_vk {
namespace {

using namespace any_boundary;

// Of the side of a voxel: a fraction of the greatest_error() for the least epsilon and an object angle of 0.15.
constexpr double kMostRounding = 0x1p-20;

/// In voxel sides: with a greater one axis_distance() exceeds epsilon wherever two contacts are equally far. Mode
/// thesis has no such bound, but bisects lines to epsilon.
double greatest_error(const ExtractionOptions& options) {
  if (options.mode == Mode::kThesis) return 0.5 * options.epsilon;
  const double angle = options.radius > 0 ? std::min(options.deep_angle, options.object_angle) : options.object_angle;
  return 0.5 * options.epsilon * (1 - std::cos(angle));
}

Status check(const BoundaryFunctions& boundary, const ExtractionOptions& options) {
  if (Status status = check_options(options); !status.ok()) return status;
  const auto usage = [](const char* message) { return Error{ErrorCode::kUsage, message}; };
  for (const std::uint32_t samples : options.thesis.samples) {
    if (samples < 1 || samples > 4096) return usage("`samples` must be 1 to 4096");
  }
  if (!boundary.nearest) return usage("`nearest` must be a function");
  const Point extent = boundary.upper - boundary.lower;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!std::isfinite(extent[k]) || extent[k] < 0) return usage("`lower` and `upper` must span a finite box");
  }
  const double longest = std::max({extent[0], extent[1], extent[2]});
  // Beyond, squares and cubes of lengths are no doubles.
  if (!(longest >= 1e-90 && longest <= 1e90)) return usage("the longest side of the box must be 1e-90 to 1e90");
  const double voxel = longest / options.resolution;
  if (!(boundary.error >= 0 && boundary.error <= greatest_error(options) * voxel)) {
    return usage("`error` must be 0 or more, and at most epsilon (1 - cos `object_angle`) / 2 voxel sides");
  }
  if (BoundaryQueries(boundary).error() - boundary.error > kMostRounding * voxel) {
    return usage("`lower` and `upper` are too far from the origin for a box of this size");
  }
  return {};
}

Salience salience_of(const ExtractionOptions& options, double longest_side) {
  return {.object_angle = options.object_angle,
          .deep_angle = std::min(options.deep_angle, options.object_angle),
          .radius = options.radius * longest_side};
}

/// Equation 2.4 on the sphere around each ball's voxel.
void measure_flux(const SearchFrame& frame, const std::vector<Point>& directions, unsigned threads,
                  const LoopWatch& watch, std::vector<FoundBall>& found) {
  parallel_blocks(found.size(), 64, threads, [&](std::size_t begin, std::size_t end) {
    watch.check();
    SphereSamples samples;
    for (std::size_t i = begin; i < end; ++i) {
      const Point centre = frame.grid.centre(found[i].voxel, frame.grid.voxel_depth());
      samples.query(centre, frame.grid.voxels().voxel_size, directions, frame.queries);
      found[i].ball.sphere.flux = static_cast<float>(samples.flux());
    }
  });
}

BoundaryExtraction in_voxel_order(SearchResult&& searched, const SearchFrame& frame) {
  std::sort(searched.found.begin(), searched.found.end(), [](const FoundBall& a, const FoundBall& b) {
    return is_earlier_voxel(a.ball.sphere.voxel, b.ball.sphere.voxel);
  });
  std::sort(searched.undecided.begin(), searched.undecided.end(),
            [](const UndecidedVoxel& a, const UndecidedVoxel& b) { return is_earlier_voxel(a.voxel, b.voxel); });
  BoundaryExtraction out;
  Extraction& extraction = out.extraction;
  extraction.grid = frame.grid.voxels();
  for (const FoundBall& found : searched.found) {
    extraction.spheres.push_back(found.ball.sphere);
    out.axis_distance.push_back(found.ball.axis_distance);
  }
  extraction.undecided = std::move(searched.undecided);
  extraction.measurements.counters = std::move(searched.counters);
  return out;
}

BoundaryExtraction search(const BoundaryFunctions& boundary, const ExtractionOptions& options,
                          const ProgressCallback& progress, const std::stop_token& stop) {
  const bool is_certified = options.mode == Mode::kCertified;
  const CellGrid grid(boundary.lower, boundary.upper, options.resolution, is_certified ? options.extra_levels : 0);
  const BoundaryQueries queries(boundary);
  const SpreadTest test;
  const SearchFrame frame = {grid, queries, test, salience_of(options, grid.voxels().voxel_size * options.resolution),
                             options.epsilon * grid.voxels().voxel_size};
  std::array<std::vector<Point>, kThesisDepths> spirals;
  for (std::size_t i = 0; i < spirals.size(); ++i) spirals[i] = spiral_points(options.thesis.samples[i]);
  LoopWatch watch(progress, stop);
  SearchResult searched = is_certified ? search_certified(frame, options.threads, watch)
                                       : search_as_published(frame, options.thesis, spirals, options.threads, watch);
  if (is_certified) measure_flux(frame, spirals.back(), options.threads, watch, searched.found);
  BoundaryExtraction out = in_voxel_order(std::move(searched), frame);
  out.extraction.measurements.counters.queries = queries.count();
  if (progress) progress(1);
  return out;
}

}  // namespace

Result<BoundaryExtraction> extract_medial_spheres(const BoundaryFunctions& boundary, const ExtractionOptions& options,
                                                  const ProgressCallback& progress, const std::stop_token& stop) {
  if (const Status status = check(boundary, options); !status.ok()) return status.error();
  return catch_out_of_memory("searching by nearest points", [&]() -> Result<BoundaryExtraction> {
    try {
      return search(boundary, options, progress, stop);
    } catch (const LoopStopped&) {
      return LoopStopped::error();
    } catch (const BadAnswer& bad) {
      return bad.error();
    }
  });
}

}  // namespace medial_vk
