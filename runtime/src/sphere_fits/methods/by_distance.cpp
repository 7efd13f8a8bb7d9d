#include "sphere_fits/methods/by_distance.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "base/format_text.h"
#include "sphere_fits/methods/prefixes.h"
#include "sphere_fits/spread/reach_cover.h"

namespace medial_vk {
namespace {

/// Whether another aim than the volume is possible.
bool may_have_aim(const SphereFitOptions& options) {
  return options.method == SphereMethod::kBest && options.contract == SphereContract::kInside && options.error == 0 &&
         !options.for_distances;
}

Error excluded(const char* message) { return {ErrorCode::kUsage, message}; }

/// Progress from the threads of a search.
class Reports {
 public:
  Reports(const SphereProgress& progress, const char* stage) : progress_(progress), stage_(stage) {}
  bool operator()(double done) {
    const std::lock_guard lock(mutex_);
    shown_ = std::max(shown_, done);
    return !progress_ || progress_(stage_, shown_);
  }
  Threads threads(unsigned count) {
    return {count, [this] { return (*this)(0); }};
  }

 private:
  const SphereProgress& progress_;
  const char* stage_;
  std::mutex mutex_;
  double shown_ = 0;
};

/// The fewest balls inside that leave no wider gap, or an error that names the number that is needed.
Result<std::vector<Ball>> fewest_within(const Solid& solid, double distance, const char* goal,
                                        const SphereFitOptions& options, Reports& reports) {
  const bool for_cover = options.contract == SphereContract::kCover;
  Result<std::vector<Ball>> found = spread_within(solid, distance, for_cover, options.count, kMostBalls,
                                                  reports.threads(options.threads), [&](double done) {
                                                    if (!reports(done)) throw Stopped();
                                                  });
  if (!found) {
    Error error = found.error();
    if (error.code == ErrorCode::kUsage) error.message += format_text("; raise {}", goal);
    return error;
  }
  const std::size_t needed = found.value().size();
  if (options.count == 0 || needed <= options.count) return found;
  return Error{ErrorCode::kUsage, format_text("no {} balls are found that keep to {}, but {} are; raise `count` or {}",
                                              options.count, goal, needed, goal)};
}

}  // namespace

SphereAim aim_for(const Solid& solid, const SphereFitOptions& options) {
  if (options.aim != SphereAim::kAuto || !may_have_aim(options)) return options.aim;
  return options.count > 0 && options.count <= sparse_count(solid) ? SphereAim::kDistance : SphereAim::kVolume;
}

Result<SphereAim> aim_for(const IndexedMesh& mesh, const SphereFitOptions& options) {
  if (options.aim != SphereAim::kAuto || !may_have_aim(options)) return options.aim;
  const Result<Solid> solid = Solid::build(mesh);
  if (!solid) return solid.error();
  return aim_for(solid.value(), options);
}

Status check_distances(const Solid& solid, const SphereFitOptions& options) {
  if (!std::isfinite(options.max_reach) || options.max_reach < 0) {
    return excluded("`max_reach` must be finite and not negative");
  }
  if (options.aim != SphereAim::kVolume && !may_have_aim(options)) {
    return excluded(
        "other values of `aim` than volume are of the method best with `contract` inside, by `count` or "
        "`max_gap`");
  }
  if (options.max_reach == 0) return {};
  const bool is_best = options.method == SphereMethod::kBest && options.error == 0 && !options.for_distances;
  if (!is_best || options.contract != SphereContract::kCover || options.levels) {
    return excluded("`max_reach` is of the method best with `contract` cover, with or without `count`");
  }
  if (options.max_reach < 16 * solid.rounding()) return excluded("`max_reach` is below the rounding of distances");
  return {};
}

Result<std::vector<SphereSet>> sets_by_distance(BallSpread& spread, const SphereFitOptions& options) {
  const std::size_t most = spread.of(options.count).size();
  if (most == 0) return Error{ErrorCode::kInvalidMesh, "no ball fits into the solid"};
  std::vector<SphereSet> sets;
  for (const std::size_t count : options.levels ? level_counts(most) : std::vector<std::size_t>{most}) {
    sets.push_back({spread.of(count)});
    if (Status status = order_by_share(sets.back().balls, options.threads); !status) return status.error();
  }
  return sets;
}

Result<std::vector<SphereSet>> sets_by_distance(const Solid& solid, const SphereFitOptions& options,
                                                const SphereProgress& progress) {
  Reports reports(progress, "spheres");
  if (options.max_gap == 0) {
    BallSpread spread(solid, reports.threads(options.threads));
    return sets_by_distance(spread, options);
  }
  Result<std::vector<Ball>> found = fewest_within(solid, options.max_gap, "`max_gap`", options, reports);
  if (!found) return found.error();
  SphereSet last = {std::move(found).value()};
  if (Status status = order_by_share(last.balls, options.threads); !status) return status.error();
  std::vector<SphereSet> sets;
  if (const std::size_t next = last.balls.size() / 2; options.levels && next > 0) {
    SphereFitOptions below = options;
    below.count = next;
    BallSpread spread(solid, reports.threads(options.threads));
    Result<std::vector<SphereSet>> smaller = sets_by_distance(spread, below);
    if (!smaller) return smaller.error();
    sets = std::move(smaller).value();
  }
  sets.push_back(std::move(last));
  return sets;
}

Result<std::vector<SphereSet>> cover_by_reach(const Solid& solid, const SphereFitOptions& options,
                                              const SphereProgress& progress) {
  Reports reports(progress, "cover");
  const Result<std::vector<Ball>> found = fewest_within(solid, options.max_reach, "`max_reach`", options, reports);
  if (!found) return found.error();
  return std::vector<SphereSet>{{grown_balls(solid, found.value(), options.max_reach)}};
}

}  // namespace medial_vk
