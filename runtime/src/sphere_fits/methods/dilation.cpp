#include "sphere_fits/methods/dilation.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <new>
#include <numbers>
#include <string>
#include <utility>

#include "base/host_memory.h"
#include "sphere_fits/cover/cover_family.h"

namespace medial_vk {
namespace {

Status check(const std::vector<Ball>& balls) {
  if (balls.empty()) return Error{ErrorCode::kUsage, "no balls to cover the solid with"};
  for (std::size_t i = 0; i < balls.size(); ++i) {
    bool is_finite = std::isfinite(balls[i].radius) && balls[i].radius >= 0;
    for (const double x : balls[i].centre) is_finite = is_finite && std::isfinite(x);
    if (!is_finite) {
      return Error{ErrorCode::kUsage, "ball " + std::to_string(i) + " has a centre or radius that is no number"};
    }
  }
  return {};
}

}  // namespace

Result<SphereSet> cover_solid(const Solid& solid, SphereSet inside, unsigned threads, const SphereProgress& progress) {
  if (Status status = check(inside.balls); !status.ok()) return status.error();
  try {
    std::mutex mutex;
    double shown = 0;
    const Cover::Report report = [&](double done) {
      const std::lock_guard lock(mutex);
      shown = std::max(shown, done);
      if (progress && !progress("cover", shown)) throw Stopped();
    };
    SphereSet cover = {search_cover(solid, std::move(inside.balls), threads, report).certified()};
    const Ball one = ball_around(solid);
    const Result<BallUnion> measured = measure_ball_union(cover.balls, {threads, false});
    if (!measured) return measured.error();
    const bool is_smaller = 4 * std::numbers::pi / 3 * one.radius * one.radius * one.radius < measured.value().volume;
    return is_smaller ? SphereSet{{one}} : cover;
  } catch (const Stopped&) {
    return Error{ErrorCode::kInterrupted, "interrupted"};
  } catch (const std::bad_alloc&) {
    return out_of_memory("covering the solid");
  }
}

Result<std::vector<SphereSet>> cover_by_counts(const Solid& solid,
                                               const std::map<std::size_t, std::vector<Ball>>& starts,
                                               const std::vector<std::size_t>& counts, unsigned threads,
                                               const SphereProgress& progress) {
  try {
    CoverFamily family(solid, starts, threads, progress);
    std::vector<SphereSet> covers;
    covers.reserve(counts.size());
    for (const std::size_t count : counts) covers.push_back({family.of(count).balls});
    return covers;
  } catch (const Stopped&) {
    return Error{ErrorCode::kInterrupted, "interrupted"};
  } catch (const std::bad_alloc&) {
    return out_of_memory("covering the solid");
  }
}

}  // namespace medial_vk
