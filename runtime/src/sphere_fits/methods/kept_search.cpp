#include "sphere_fits/methods/kept_search.h"

#include <algorithm>
#include <exception>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "base/host_memory.h"
#include "sphere_fits/methods/best_method.h"
#include "sphere_fits/methods/by_distance.h"
#include "sphere_fits/methods/fit_steps.h"
#include "sphere_fits/methods/prefixes.h"

namespace medial_vk {

struct KeptSearch::State {
  State(const IndexedMesh& of_part, const SphereFitOptions& of_fit, std::size_t most, Extractor own)
      : mesh(of_part), options(of_fit), given(std::move(own)), extractor(stopped_by(given, stop)) {
    options.contract = SphereContract::kInside;
    options.error = options.max_gap = options.max_distance = 0;
    options.count = most;
  }

  const IndexedMesh mesh;
  SphereFitOptions options;
  const Extractor given;
  std::stop_token stop;       // of the present call
  const Extractor extractor;  // reached by it
  std::optional<Solid> solid;
  std::unique_ptr<GrowingBalls> balls;
  std::optional<BallSpread> spread;

  Status build() {
    if (solid) return {};
    Result<Solid> built = Solid::build(mesh);
    if (!built) return built.error();
    solid.emplace(std::move(built).value());
    return {};
  }

  Status grow(std::size_t count, const SphereProgress& progress) {
    if (Status status = build(); !status) return status;
    if (!balls) {
      Result<std::unique_ptr<GrowingBalls>> begun = grow_inside(*solid, options, extractor);
      if (!begun) return begun.error();
      balls = std::move(begun).value();
    }
    return balls->grow(std::min(count, options.count), progress);
  }

  Result<BallSpread*> spread_out() {
    if (Status status = build(); !status) return status.error();
    if (!spread) spread.emplace(*solid, Threads(options.threads, [this] { return !stop.stop_requested(); }));
    return &*spread;
  }

  Result<std::vector<SphereSet>> sets_for(std::size_t count, SphereAim aim, const SphereProgress& progress) {
    if (aim != SphereAim::kDistance) {
      if (Status status = grow(count, progress); !status) return status.error();
      return sets(count);
    }
    const Result<BallSpread*> spread_balls = spread_out();
    if (!spread_balls) return spread_balls.error();
    SphereFitOptions own = options;
    own.count = count;
    return sets_by_distance(*spread_balls.value(), own);
  }

  /// A set for each level, or the last of them alone.
  Result<std::vector<SphereSet>> sets(std::size_t count) const {
    std::vector<Ball> last = balls->at(std::min(count, balls->volumes().size()));
    if (Status status = order_by_share(last, options.threads); !status) return status.error();
    const std::size_t size = last.size();
    std::vector<SphereSet> found;
    for (const std::size_t level : options.levels ? level_counts(size) : std::vector<std::size_t>{size}) {
      found.push_back({std::vector<Ball>(last.begin(), last.begin() + static_cast<std::ptrdiff_t>(level))});
    }
    return found;
  }

  /// Converts exceptions to errors.
  template <class Work>
  auto guarded(const std::stop_token& of_call, const Work& work) -> decltype(work()) {
    stop = of_call;
    try {
      return work();
    } catch (const Stopped&) {
      return Error{ErrorCode::kInterrupted, "interrupted"};
    } catch (const std::bad_alloc&) {
      return out_of_memory("fitting spheres", "try a lower `count`");
    } catch (const std::exception& error) {
      return Error{ErrorCode::kInternal, std::string("internal error: ") + error.what()};
    }
  }
};

KeptSearch::KeptSearch(const IndexedMesh& mesh, const SphereFitOptions& options, std::size_t most, Extractor extractor)
    : state_(std::make_unique<State>(mesh, options, most, std::move(extractor))) {}

KeptSearch::~KeptSearch() = default;

Result<CoverageCurve> KeptSearch::curve(std::size_t count, const StageProgress& progress, const std::stop_token& stop) {
  return state_->guarded(stop, [&]() -> Result<CoverageCurve> {
    if (Status status = state_->grow(count, progress_of_fit(state_->options, progress, stop)); !status) {
      return status.error();
    }
    CoverageCurve curve;
    curve.covered = state_->balls->volumes();
    curve.ends = state_->balls->ends();
    if (state_->solid->has_volume()) curve.solid_volume = state_->solid->volume();
    return curve;
  });
}

Result<std::vector<double>> KeptSearch::gaps(std::size_t count, const std::stop_token& stop) {
  return state_->guarded(stop, [&]() -> Result<std::vector<double>> {
    const Result<BallSpread*> spread = state_->spread_out();
    if (!spread) return spread.error();
    return spread.value()->gaps(count);
  });
}

Result<SphereFit> KeptSearch::fit(std::size_t count, SphereAim aim, const StageProgress& progress,
                                  const std::stop_token& stop) {
  return state_->guarded(stop, [&]() -> Result<SphereFit> {
    const SphereProgress on_progress = progress_of_fit(state_->options, progress, stop);
    Result<std::vector<SphereSet>> sets = state_->sets_for(count, aim, on_progress);
    if (!sets) return sets.error();
    SphereFitOptions options = state_->options;
    options.aim = aim;
    return finish_fit(*state_->solid, std::move(sets).value(), options, on_progress);
  });
}

bool has_kept_curve(const SphereFitOptions& options) {
  return options.method == SphereMethod::kBest && !options.for_distances && !(options.balls_only && options.levels);
}

bool is_kept(const SphereFitOptions& options) {
  return has_kept_curve(options) && options.contract == SphereContract::kInside && options.count > 0 &&
         options.error == 0 && options.max_gap == 0 && options.max_reach == 0 && options.max_distance == 0 &&
         options.aim != SphereAim::kAuto;
}

}  // namespace medial_vk
