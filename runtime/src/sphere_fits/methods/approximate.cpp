#include <algorithm>
#include <cmath>
#include <exception>
#include <iterator>
#include <mutex>
#include <new>
#include <utility>

#include "base/host_memory.h"
#include "sphere_fits/cover/cover.h"
#include "sphere_fits/cover/cover_family.h"
#include "sphere_fits/methods/approximate.h"
#include "sphere_fits/methods/best_method.h"
#include "sphere_fits/methods/by_distance.h"
#include "sphere_fits/methods/dilation.h"
#include "sphere_fits/methods/nearness.h"
#include "sphere_fits/methods/prefixes.h"
#include "sphere_fits/methods/source_method.h"

namespace medial_vk {
namespace {

Error usage(const char* message) { return {ErrorCode::kUsage, message}; }

/// Balls inside the solid, with which the methods of all contracts begin.
Result<SphereSet> inside_spheres(const Solid& solid, const SphereFitOptions& options, const Extractor& extractor,
                                 const SphereProgress& progress) {
  switch (options.method) {
    case SphereMethod::kSource:
      return source_spheres(solid, options, extractor, progress);
    case SphereMethod::kBest:
      break;
  }
  return best_spheres(solid, options, extractor, progress);
}

/// Turns the set into one for the contract.
Result<SphereSet> keep_contract(const Solid& solid, SphereSet inside, const SphereFitOptions& options,
                                const SphereProgress& progress) {
  switch (options.contract) {
    case SphereContract::kInside:
      break;
    case SphereContract::kCover:
      return cover_solid(solid, std::move(inside), options.threads, progress);
    case SphereContract::kBalanced:
      return dilate_to_boundary(solid, std::move(inside), options.threads);
  }
  return inside;
}

Status check_distance_bound(const Solid& solid, const SphereFitOptions& options) {
  constexpr double kLeast = 1e-3;  // of the diagonal
  if (!std::isfinite(options.max_distance) || options.max_distance < 0) {
    return usage("`max_distance` must be finite and not negative");
  }
  if (options.max_distance == 0) return {};
  if (options.contract != SphereContract::kBalanced || options.method != SphereMethod::kBest) {
    return usage("`max_distance` is about balanced balls of the `method` best");
  }
  if (options.max_distance < kLeast * solid.diagonal()) return usage("`max_distance` is below 1e-3 of the diagonal");
  return {};
}

Status check_request(const Solid& solid, const SphereFitOptions& options) {
  const bool finite = std::isfinite(options.error) && std::isfinite(options.max_gap);
  if (!finite || options.error < 0 || options.error >= 1 || options.max_gap < 0) {
    return usage("`error` must be in [0, 1), and `max_gap` finite and not negative");
  }
  if (options.error > 0 && !solid.has_volume()) {
    return usage("`error` is a share of the volume, which this mesh does not enclose cleanly; use `count` instead");
  }
  if (Status status = check_distance_bound(solid, options); !status) return status;
  if (Status status = check_distances(solid, options); !status) return status;
  if (options.balls_only && options.levels) return usage("`balls_only` gives one set of balls, and no levels");
  if (options.for_distances) {
    const bool is_by_count = options.count > 0 && options.error == 0 && options.max_gap == 0 && !options.levels;
    if (options.method == SphereMethod::kBest && options.contract != SphereContract::kBalanced && is_by_count)
      return {};
    return usage("`for_distances` gives sets of the method best, inside or covers, by `count` alone, without levels");
  }
  const bool is_by_resolution = options.method == SphereMethod::kSource && options.resolution > 0;
  const bool has_goal = options.error > 0 || options.max_gap > 0 || options.max_reach > 0 || options.max_distance > 0;
  if (options.count == 0 && !has_goal && !is_by_resolution) {
    return usage("there is no goal: give a `count`, an `error`, a `max_gap`, a `max_reach` or a `max_distance`");
  }
  // Balls inside keep a distance of the rounding from the boundary.
  if (options.max_gap > 0 && options.max_gap < 16 * solid.rounding()) {
    return usage("`max_gap` is below the rounding of distances");
  }
  if (options.contract == SphereContract::kCover && options.max_gap > 0) {
    return usage("balls that cover leave no gap; use `error` or `count` instead of `max_gap`");
  }
  const bool is_best = options.method == SphereMethod::kBest;
  if (options.contract == SphereContract::kBalanced && is_best && !solid.mesh().report.closed) {
    return usage("balanced balls need a mesh without open edges; use `contract` inside, or `method` source");
  }
  if (has_goal && options.contract != SphereContract::kInside && !is_best) {
    return usage("`method` source with this `contract` supports neither `error` nor `max_gap`; use `count`");
  }
  return {};
}

/// The balls inside with which covers of `count` balls begin: more than `count`, up to the next number for which covers
/// are searched.
Result<SphereSet> cover_starts(const Solid& solid, const SphereFitOptions& options, std::size_t count,
                               const Extractor& extractor, const SphereProgress& progress) {
  SphereFitOptions start = options;
  start.contract = SphereContract::kInside;
  start.error = 0;
  start.count = cover_top(count);
  return best_spheres(solid, start, extractor, progress);
}

/// A cover that adds no more than the error: tries the numbers for which covers are searched, one after the other, then
/// fewer balls.
Result<SphereSet> cover_for_error(const Solid& solid, const SphereFitOptions& options, const Extractor& extractor,
                                  const SphereProgress& progress) {
  const std::size_t most = options.count > 0 ? options.count : kMostBalls;
  const double volume = (1 + options.error) * solid.volume();
  std::map<std::size_t, std::vector<Ball>> starts;
  CoverFamily family(solid, starts, options.threads, progress);
  for (std::size_t top = 1;; top *= top < 64 ? 4 : 2) {
    const std::size_t count = std::min(top, most), half = top / 4 * 3;
    Result<SphereSet> inside = cover_starts(solid, options, count, extractor, progress);
    if (!inside) return inside.error();
    starts = std::move(inside.value().stages);  // the previous starts, and one or two more
    for (const std::size_t tried : {half, count}) {
      if (tried == half && (cover_top(half) != half || half >= count)) continue;
      if (std::vector<Ball> cover = family.few(tried, volume); !cover.empty()) return SphereSet{std::move(cover)};
    }
    if (count == most) return usage("no cover of so many balls adds so little; raise `count` or `error`");
  }
}

/// The smaller levels of a cover, and the cover itself.
Result<std::vector<SphereSet>> levels_below(const Solid& solid, const SphereFitOptions& options, bool all_levels,
                                            SphereSet cover, const Extractor& extractor,
                                            const SphereProgress& progress) {
  std::vector<SphereSet> levels;
  if (const std::size_t next = cover.balls.size() / 2; all_levels && next > 0) {
    const Result<SphereSet> inside = cover_starts(solid, options, next, extractor, progress);
    if (!inside) return inside.error();
    Result<std::vector<SphereSet>> smaller =
        cover_by_counts(solid, inside.value().stages, level_counts(next), options.threads, progress);
    if (!smaller) return smaller.error();
    levels = std::move(smaller).value();
  }
  levels.push_back(std::move(cover));
  return levels;
}

/// Sets for distances, from the balls inside that the method finds for their volume.
Result<SphereSet> best_for_distances(const Solid& solid, const SphereFitOptions& options, const Extractor& extractor,
                                     const SphereProgress& progress) {
  SphereFitOptions start = options;
  start.contract = SphereContract::kInside;
  Result<SphereSet> inside = best_spheres(solid, start, extractor, progress);
  if (!inside) return inside.error();
  std::vector<Ball>& balls = inside.value().balls;
  const bool covers = options.contract == SphereContract::kCover;
  std::mutex mutex;  // for one call at a time
  const auto report = [&](double done) {
    const std::lock_guard lock(mutex);
    if (progress && !progress(covers ? "cover" : "spheres", done)) throw Stopped();
  };
  const Threads threads = {options.threads, [&] {
                             report(covers ? 0 : 1);
                             return true;
                           }};
  constexpr std::size_t kLeast = 1024, kOfBall = 16, kOfCovering = 4;
  const std::size_t wanted = std::max(kLeast, (covers ? kOfCovering : kOfBall) * balls.size());
  const std::vector<Probe> probes = probes_around(solid, wanted, options.threads, threads.goes_on);
  if (covers) return SphereSet{search_cover(solid, std::move(balls), options.threads, report, probes).certified()};
  balls = nearer_balls(solid, balls, probes, threads);
  if (Status status = order_by_share(balls, options.threads); !status) return status.error();
  return SphereSet{std::move(balls)};
}

Result<std::vector<SphereSet>> best_covers(const Solid& solid, const SphereFitOptions& options, bool all_levels,
                                           const Extractor& extractor, const SphereProgress& progress) {
  const std::size_t count = options.count;
  if (options.error > 0) {
    Result<SphereSet> cover = cover_for_error(solid, options, extractor, progress);
    if (!cover) return cover.error();
    return levels_below(solid, options, all_levels, std::move(cover).value(), extractor, progress);
  }
  if (count == 0) return usage("a cover requires `count` or `error`");
  Result<SphereSet> inside = cover_starts(solid, options, count, extractor, progress);
  if (!inside) return inside.error();
  if (options.balls_only) {  // of the numbers for which covers are searched, only the greatest
    auto& starts = inside.value().stages;
    starts.erase(starts.begin(), std::prev(starts.end()));
  }
  const std::vector<std::size_t> counts = all_levels ? level_counts(count) : std::vector<std::size_t>{count};
  return cover_by_counts(solid, inside.value().stages, counts, options.threads, progress);
}

/// Every level is the state of the method at its number of balls.
Result<std::vector<SphereSet>> best_balanced(const Solid& solid, const SphereFitOptions& options, bool all_levels,
                                             const Extractor& extractor, const SphereProgress& progress) {
  Result<SphereSet> found = best_spheres(solid, options, extractor, progress);
  if (found && all_levels && (options.error > 0 || options.max_gap > 0 || options.count == 0)) {
    // The numbers of the levels are known only now.
    SphereFitOptions again = options;
    again.count = found.value().balls.size();
    again.error = again.max_gap = 0;
    found = best_spheres(solid, again, extractor, progress);
  }
  if (!found) return found.error();
  SphereSet& last = found.value();
  std::vector<SphereSet> levels;
  for (auto& [count, balls] : last.stages) {
    if (all_levels && count < last.balls.size()) levels.push_back({std::move(balls)});
  }
  levels.push_back({std::move(last.balls)});
  return levels;
}

Result<std::vector<SphereSet>> levels_of(const Solid& solid, const SphereFitOptions& options, bool all_levels,
                                         const Extractor& extractor, const SphereProgress& progress) {
  if (Status status = check_request(solid, options); !status) return status.error();
  if (options.max_reach > 0) return cover_by_reach(solid, options, progress);
  if (aim_for(solid, options) == SphereAim::kDistance) {
    SphereFitOptions by_distance = options;
    by_distance.levels = all_levels;
    return sets_by_distance(solid, by_distance, progress);
  }
  if (options.for_distances) {
    Result<SphereSet> set = best_for_distances(solid, options, extractor, progress);
    if (!set) return set.error();
    return std::vector<SphereSet>{std::move(set).value()};
  }
  if (options.contract == SphereContract::kCover && options.method == SphereMethod::kBest) {
    return best_covers(solid, options, all_levels, extractor, progress);
  }
  if (options.contract == SphereContract::kBalanced && options.method == SphereMethod::kBest) {
    return best_balanced(solid, options, all_levels, extractor, progress);
  }
  Result<SphereSet> inside = inside_spheres(solid, options, extractor, progress);
  if (!inside) return inside.error();
  if (options.contract == SphereContract::kInside && !all_levels) {
    return std::vector<SphereSet>{std::move(inside).value()};  // with the volumes for fewer balls
  }
  const std::vector<Ball>& balls = inside.value().balls;
  const std::vector<std::size_t> counts =
      all_levels && !balls.empty() ? level_counts(balls.size()) : std::vector<std::size_t>{balls.size()};
  std::vector<SphereSet> levels;
  for (const std::size_t count : counts) {
    const auto end = balls.begin() + static_cast<std::ptrdiff_t>(count);
    Result<SphereSet> level = keep_contract(solid, {std::vector<Ball>(balls.begin(), end)}, options, progress);
    if (!level) return level.error();
    levels.push_back(std::move(level).value());
  }
  return levels;
}

/// Converts exceptions to errors.
Result<std::vector<SphereSet>> guarded_levels(const Solid& solid, const SphereFitOptions& options, bool all_levels,
                                              const Extractor& extractor, const SphereProgress& progress) {
  try {
    return levels_of(solid, options, all_levels, extractor, progress);
  } catch (const Stopped&) {
    return Error{ErrorCode::kInterrupted, "interrupted"};
  } catch (const std::bad_alloc&) {
    return out_of_memory("choosing balls", "try a lower `count`");
  } catch (const std::exception& error) {
    return Error{ErrorCode::kInternal, std::string("internal error: ") + error.what()};
  }
}

}  // namespace

Result<SphereSet> approximate_by_spheres(const Solid& solid, const SphereFitOptions& options,
                                         const Extractor& extractor, const SphereProgress& progress) {
  Result<std::vector<SphereSet>> levels = guarded_levels(solid, options, false, extractor, progress);
  if (!levels) return levels.error();
  SphereSet last = std::move(levels.value().back());
  return last;
}

Result<std::vector<SphereSet>> approximate_once(const Solid& solid, const SphereFitOptions& options,
                                                const Extractor& extractor, const SphereProgress& progress) {
  return guarded_levels(solid, options, false, extractor, progress);
}

Result<std::vector<SphereSet>> approximate_in_levels(const Solid& solid, const SphereFitOptions& options,
                                                     const Extractor& extractor, const SphereProgress& progress) {
  return guarded_levels(solid, options, true, extractor, progress);
}

}  // namespace medial_vk
