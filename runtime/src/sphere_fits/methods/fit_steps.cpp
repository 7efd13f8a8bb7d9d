#include "sphere_fits/methods/fit_steps.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <string_view>
#include <utility>

#include "base/format_text.h"
#include "base/point_ops.h"
#include "sphere_fits/methods/fit_goals.h"
#include "sphere_fits/quality/branch_and_bound.h"
#include "sphere_fits/quality/envelope_distance.h"
#include "sphere_fits/quality/measures.h"
#include "sphere_fits/quality/sphere_certificate.h"

namespace medial_vk {
namespace {

/// Spheres that violate the contract are not returned.
Status check_contract(SphereContract contract, const SphereMeasures& measures) {
  const InsideProof& inside = measures.inside;
  if (contract == SphereContract::kInside && !inside.proved()) {
    return Error{ErrorCode::kInternal, format_text("{} of {} spheres reach out of the solid, the worst by {:.3g}",
                                                   inside.failed, inside.tested, inside.greatest_excess)};
  }
  if (contract == SphereContract::kCover && !measures.cover.surface_proved()) {
    return Error{ErrorCode::kInternal, "the spheres are not proved to cover the solid"};
  }
  return {};
}

/// Balls that do not keep the bound of the distance are not returned.
Status check_bound(const Bounds& distance, std::size_t count, const SphereFitOptions& options) {
  if (options.max_distance <= 0 || distance.upper <= options.max_distance) return {};
  return Error{ErrorCode::kUsage,
               format_text("{} {} the surfaces within {:.4g} of each other; raise `count` or `max_distance`", count,
                           count == 1 ? "ball keeps" : "balls keep", distance.upper)};
}

/// Without other measures.
Status check_distance(const Solid& solid, const std::vector<Ball>& balls, const SphereFitOptions& options,
                      const SphereProgress& progress) {
  if (options.max_distance <= 0 || !options.balls_only) return {};
  const Threads threads = {options.threads, [&progress] { return progress("spheres", 1); }};
  const Result<Bounds> distance =
      measure_surface_distance(solid, balls, {.tolerance = distance_tolerance(solid, options), .threads = threads});
  if (!distance) return distance.error();
  return check_bound(distance.value(), balls.size(), options);
}

/// The distance of a point of a ball outside the solid is at most the difference of radius and distance of the centre
/// to the boundary if the centre is inside, and at most their sum if it is not. Contract inside excludes points
/// outside.
ReachOut reach_of(const Solid& solid, SphereContract contract, const std::vector<Ball>& balls) {
  ReachOut reach;
  if (contract == SphereContract::kInside || balls.empty()) return reach;
  reach.least = HUGE_VAL;
  CompensatedSum sum;
  for (const Ball& ball : balls) {
    const double distance = solid.distance(ball.centre) * (solid.contains(ball.centre) ? -1 : 1);
    const double out = std::max(0.0, ball.radius + distance + solid.rounding());
    sum.add(out);
    reach.least = std::min(reach.least, out);
    reach.greatest = std::max(reach.greatest, out);
  }
  reach.mean = sum.value() / static_cast<double>(balls.size());
  return reach;
}

/// With `balls_only` nothing but the proof of the contract.
Result<SphereMeasures> measures_of(const Solid& solid, const std::vector<Ball>& balls, const SphereFitOptions& options,
                                   const SphereProgress& progress) {
  const Threads threads = {options.threads, [&progress] { return progress("spheres", 1); }};
  if (!options.balls_only) {
    MeasureOptions how = {.threads = threads};
    if (options.max_distance > 0) how.tolerance = distance_tolerance(solid, options);
    return measure_spheres(solid, balls, how);
  }
  SphereMeasures proofs;
  if (options.contract == SphereContract::kInside) {
    try {
      proofs.inside = prove_inside(solid, balls, threads);
    } catch (const Stopped&) {
      return Error{ErrorCode::kInterrupted, "interrupted"};
    }
  }
  if (options.contract == SphereContract::kCover) {
    Result<CoverProof> cover = prove_cover(solid, balls, threads);
    if (!cover) return cover.error();
    proofs.cover = std::move(cover).value();
  }
  return proofs;
}

}  // namespace

SphereProgress progress_of_fit(const SphereFitOptions& options, const StageProgress& progress,
                               const std::stop_token& stop) {
  struct State {
    std::mutex mutex;
    double greatest = 0;
  };
  const bool has_two_stages = options.contract == SphereContract::kCover && options.method == SphereMethod::kBest &&
                              !(options.error > 0) && !(options.max_reach > 0);
  return [&progress, &stop, has_two_stages, state = std::make_shared<State>()](const char* stage, double done) {
    constexpr double kOfFirst = 0.2;  // of the time
    const std::lock_guard lock(state->mutex);
    if (has_two_stages) {
      const bool is_second = std::string_view(stage) == "cover";
      state->greatest = std::max(state->greatest, is_second ? kOfFirst + (1 - kOfFirst) * done : kOfFirst * done);
      done = state->greatest;
    }
    if (progress) progress(stage, done);
    return !stop.stop_requested();
  };
}

Extractor stopped_by(const Extractor& extractor, const std::stop_token& stop) {
  return [&extractor, &stop](const IndexedMesh& mesh, const ExtractionOptions& options,
                             const ProgressCallback& progress, const std::stop_token& own) {
    std::stop_source either;
    const auto request = [&either] { either.request_stop(); };
    const std::stop_callback on_stop(stop, request), on_own(own, request);
    return extractor(mesh, options, progress, either.get_token());
  };
}

Result<SphereFit> finish_fit(const Solid& solid, std::vector<SphereSet> sets, const SphereFitOptions& options,
                             const SphereProgress& progress) {
  if (Status status = check_distance(solid, sets.back().balls, options, progress); !status) return status.error();
  Result<SphereMeasures> measured = measures_of(solid, sets.back().balls, options, progress);
  if (!measured) return measured.error();
  if (Status status = check_contract(options.contract, measured.value()); !status) return status.error();
  if (!options.balls_only) {
    const Bounds distance = measured.value().distances.between_surfaces();
    if (Status status = check_bound(distance, sets.back().balls.size(), options); !status) return status.error();
  }
  SphereFit out;
  out.measures = std::move(measured).value();
  out.aim = options.aim;
  if (solid.has_volume()) out.solid_volume = solid.volume();
  for (SphereSet& set : sets) {
    out.reach.push_back(reach_of(solid, options.contract, set.balls));
    out.levels.push_back(std::move(set.balls));
  }
  return out;
}

}  // namespace medial_vk
