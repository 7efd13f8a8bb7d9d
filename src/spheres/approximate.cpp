#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <utility>

#include "spheres/approximate.h"
#include "spheres/best_method.h"
#include "spheres/cover_family.h"
#include "spheres/dilation.h"
#include "spheres/prefixes.h"
#include "spheres/source_method.h"

namespace medial_vk {
namespace {

Error usage(const char* message) { return {ErrorCode::kUsage, message}; }

/// Balls inside the solid, whatever the contract: the others begin with these.
Result<SphereSet> inside_spheres(const Solid& solid, const SphereRequest& request, Backend backend, Context* context,
                                 const SphereProgress& progress) {
  switch (request.method) {
    case SphereMethod::kSource:
      return source_spheres(solid, request, backend, context, progress);
    case SphereMethod::kBest:
      break;
  }
  return best_spheres(solid, request, backend, context, progress);
}

/// The set as the contract wants it.
Result<SphereSet> keep_contract(const Solid& solid, SphereSet inside, const SphereRequest& request,
                                const SphereProgress& progress) {
  switch (request.contract) {
    case SphereContract::kInside:
      break;
    case SphereContract::kCover:
      return cover_solid(solid, std::move(inside), request.threads, progress);
    case SphereContract::kBalanced:
      return dilate_to_boundary(solid, std::move(inside), request.threads);
  }
  return inside;
}

Status check_request(const Solid& solid, const SphereRequest& request) {
  const bool finite = std::isfinite(request.error) && std::isfinite(request.max_gap);
  if (!finite || request.error < 0 || request.error >= 1 || request.max_gap < 0) {
    return usage("an error is a share below 1, and a gap a length; neither is negative");
  }
  if (request.error > 0 && !solid.has_volume()) {
    return usage("an error is a share of the volume, which this mesh does not enclose cleanly; give a count");
  }
  // Balls inside stay off the boundary by rounding.
  if (request.max_gap > 0 && request.max_gap < 16 * solid.rounding()) {
    return usage("so small a gap is below the rounding of distances");
  }
  if (request.contract != SphereContract::kInside && (request.error > 0 || request.max_gap > 0)) {
    return usage("an error or a gap is a goal for balls inside; for the other contracts say how many");
  }
  return {};
}

/// From balls inside, more than are wanted: how many depends on the next number that covers are searched for.
Result<std::vector<SphereSet>> best_covers(const Solid& solid, const SphereRequest& request, bool all_levels,
                                           Backend backend, Context* context, const SphereProgress& progress) {
  if (request.count == 0) return usage("say how many balls shall cover the solid");
  SphereRequest start = request;
  start.contract = SphereContract::kInside;
  start.count = cover_top(request.count);
  const Result<SphereSet> inside = best_spheres(solid, start, backend, context, progress);
  if (!inside) return inside.error();
  const std::vector<std::size_t> counts =
      all_levels ? level_counts(request.count) : std::vector<std::size_t>{request.count};
  return cover_by_counts(solid, inside.value().stages, counts, request.threads, progress);
}

/// Every level is what the method has when it has so many balls.
Result<std::vector<SphereSet>> best_balanced(const Solid& solid, const SphereRequest& request, bool all_levels,
                                             Backend backend, Context* context, const SphereProgress& progress) {
  Result<SphereSet> found = best_spheres(solid, request, backend, context, progress);
  if (!found) return found.error();
  SphereSet& last = found.value();
  std::vector<SphereSet> levels;
  for (auto& [count, balls] : last.stages) {
    if (all_levels && count < last.balls.size()) levels.push_back({std::move(balls)});
  }
  levels.push_back({std::move(last.balls)});
  return levels;
}

Result<std::vector<SphereSet>> levels_of(const Solid& solid, const SphereRequest& request, bool all_levels,
                                         Backend backend, Context* context, const SphereProgress& progress) {
  if (Status status = check_request(solid, request); !status) return status.error();
  if (request.contract == SphereContract::kCover && request.method == SphereMethod::kBest) {
    return best_covers(solid, request, all_levels, backend, context, progress);
  }
  if (request.contract == SphereContract::kBalanced && request.method == SphereMethod::kBest) {
    return best_balanced(solid, request, all_levels, backend, context, progress);
  }
  Result<SphereSet> inside = inside_spheres(solid, request, backend, context, progress);
  if (!inside) return inside.error();
  const std::vector<Ball>& balls = inside.value().balls;
  const std::vector<std::size_t> counts =
      all_levels && !balls.empty() ? level_counts(balls.size()) : std::vector<std::size_t>{balls.size()};
  std::vector<SphereSet> levels;
  for (const std::size_t count : counts) {
    const auto end = balls.begin() + static_cast<std::ptrdiff_t>(count);
    Result<SphereSet> level = keep_contract(solid, {std::vector<Ball>(balls.begin(), end)}, request, progress);
    if (!level) return level.error();
    levels.push_back(std::move(level).value());
  }
  return levels;
}

/// No exception leaves here.
Result<std::vector<SphereSet>> guarded_levels(const Solid& solid, const SphereRequest& request, bool all_levels,
                                              Backend backend, Context* context, const SphereProgress& progress) {
  try {
    return levels_of(solid, request, all_levels, backend, context, progress);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory, "out of memory; ask for fewer balls"};
  } catch (const std::exception& error) {
    return Error{ErrorCode::kInternal, std::string("internal error: ") + error.what()};
  }
}

}  // namespace

Result<SphereSet> approximate_by_spheres(const Solid& solid, const SphereRequest& request, Backend backend,
                                         Context* context, const SphereProgress& progress) {
  Result<std::vector<SphereSet>> levels = guarded_levels(solid, request, false, backend, context, progress);
  if (!levels) return levels.error();
  SphereSet last = std::move(levels.value().back());
  return last;
}

Result<std::vector<SphereSet>> approximate_in_levels(const Solid& solid, const SphereRequest& request, Backend backend,
                                                     Context* context, const SphereProgress& progress) {
  return guarded_levels(solid, request, true, backend, context, progress);
}

}  // namespace medial_vk
