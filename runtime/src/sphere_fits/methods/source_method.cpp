#include "sphere_fits/methods/source_method.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "base/format_text.h"
#include "medial_vk/ball_union.h"
#include "sphere_fits/methods/prefixes.h"

namespace medial_vk {
namespace {

Error source_usage(std::string message) { return {ErrorCode::kUsage, std::move(message)}; }

constexpr std::uint32_t kFinestGrid = 4096;  // the range of ExtractionOptions::resolution
constexpr std::uint32_t kFirstGrid = 4;

/// Searches the grid; every attempt is an extraction.
class GridSearch {
 public:
  GridSearch(const Solid& solid, const SphereFitOptions& options, const Extractor& extractor,
             const SphereProgress& progress)
      : solid_(solid), options_(options), extractor_(extractor), progress_(progress) {}

  Result<SphereSet> run() {
    const bool by_count = options_.count > 0, by_error = options_.error > 0;
    Status status = by_count ? finest_within_count() : by_error ? coarsest_within_error() : one_grid();
    if (!status) return status.error();
    if (by_count && by_error && !(error_of(best_).value_or(1) <= options_.error)) {
      return source_usage(
          format_text("one ball per voxel leaves {:.3g} of the volume uncovered with {} balls, more than the "
                      "`error` of {:.3g}; raise `count`, or use `method` best",
                      error_of(best_).value_or(1), best_.size(), options_.error));
    }
    if (Status ordered = order_by_share(best_, options_.threads); !ordered) return ordered.error();
    return SphereSet{std::move(best_)};
  }

 private:
  Result<std::vector<Ball>> balls_at(std::uint32_t resolution) {
    ExtractionOptions options;
    options.resolution = resolution;
    options.object_angle = options_.object_angle;
    const double begun = static_cast<double>(attempts_++);
    // The number of attempts is unknown in advance: each takes half of the remaining progress.
    options.threads = options_.threads;
    const SphereProgress part = [&](const char*, double done) {
      return !progress_ || progress_("spheres", 1 - 1 / (1 + 0.25 * (begun + done)));
    };
    return find_medial_balls(solid_, options, extractor_, part);
  }

  /// Share of the volume that no ball covers (Lemma 7.1: exact, as no ball is outside); no value for solids without a
  /// volume.
  std::optional<double> error_of(const std::vector<Ball>& balls) const {
    if (!(solid_.volume() > 0)) return std::nullopt;
    const Result<BallUnion> measured = measure_ball_union(balls, {options_.threads, false});
    if (!measured) return std::nullopt;
    return 1 - measured.value().volume / solid_.volume();
  }

  Status one_grid() {
    Result<std::vector<Ball>> balls = balls_at(options_.resolution);
    if (!balls) return balls.error();
    best_ = std::move(balls).value();
    return best_.empty() ? no_balls() : Status();
  }

  /// True if the grid gives no more balls than the count. Keeps the largest such set; of equal ones the finer.
  Result<bool> within_count(std::uint32_t resolution) {
    Result<std::vector<Ball>> balls = balls_at(resolution);
    if (!balls) return balls.error();
    fewest_ = std::min(fewest_, balls.value().empty() ? fewest_ : balls.value().size());
    if (balls.value().size() > options_.count) return false;
    if (balls.value().size() >= best_.size()) best_ = std::move(balls).value();
    return true;
  }

  Result<bool> within_error(std::uint32_t resolution) {
    Result<std::vector<Ball>> balls = balls_at(resolution);
    if (!balls) return balls.error();
    if (!(error_of(balls.value()).value_or(1) <= options_.error)) return false;
    best_ = std::move(balls).value();
    return true;
  }

  /// The last grid, from `low` on, for which `holds` gives `begins`, and the first for which it does not, by doubling
  /// and then bisection, under the assumption of a single change.
  template <class Holds>
  Result<std::uint32_t> search(Holds holds, bool begins) {
    std::uint32_t low = 0, high = kFirstGrid;
    for (;; high *= 2) {
      const Result<bool> answer = holds(high);
      if (!answer) return answer.error();
      if (answer.value() != begins) break;
      low = high;
      if (high == kFinestGrid) return high;
    }
    while (high - low > 1) {
      const std::uint32_t middle = low + (high - low) / 2;
      const Result<bool> answer = holds(middle);
      if (!answer) return answer.error();
      (answer.value() == begins ? low : high) = middle;
    }
    return low;
  }

  Status finest_within_count() {
    const Result<std::uint32_t> found = search([this](std::uint32_t n) { return within_count(n); }, true);
    if (!found) return found.error();
    if (!best_.empty()) return {};
    if (fewest_ == SIZE_MAX) return no_balls();
    return source_usage(
        format_text("one ball per voxel gives {} balls even on the coarsest grid that has any, more than the {} "
                    "allowed; raise `count`, or use `method` best",
                    fewest_, options_.count));
  }

  Status coarsest_within_error() {
    const Result<std::uint32_t> found = search([this](std::uint32_t n) { return within_error(n); }, false);
    if (!found) return found.error();
    if (!best_.empty()) return {};
    return source_usage(
        format_text("one ball per voxel reaches an `error` of {:.3g} on no grid; use `method` best", options_.error));
  }

  Status no_balls() const {
    return source_usage(format_text("no medial ball has an object angle of {:.3g} or more; lower `object_angle`",
                                    options_.object_angle));
  }

  const Solid& solid_;
  const SphereFitOptions& options_;
  const Extractor& extractor_;
  const SphereProgress& progress_;
  std::vector<Ball> best_;
  std::size_t fewest_ = SIZE_MAX;  // balls on any grid that has some
  int attempts_ = 0;
};

}  // namespace

Result<SphereSet> source_spheres(const Solid& solid, const SphereFitOptions& options, const Extractor& extractor,
                                 const SphereProgress& progress) {
  if (options.max_gap > 0) return source_usage("`method` source does not support `max_gap`; use `method` best");
  const bool has_goal = options.count > 0 || options.error > 0;
  if (has_goal && options.resolution > 0) {
    return source_usage("`method` source finds its own resolution; use either `resolution`, or `count` and `error`");
  }
  if (!has_goal && options.resolution == 0)
    return source_usage("there is no goal: use `count`, `error` or `resolution`");
  return GridSearch(solid, options, extractor, progress).run();
}

}  // namespace medial_vk
