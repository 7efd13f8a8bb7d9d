// Hulls of balls for one solid: searched, proved, measured.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/format_text.h"
#include "base/host_memory.h"
#include "hull_fits/final_hulls.h"
#include "hull_fits/heartbeat.h"
#include "hull_fits/search/hull_family.h"
#include "medial_vk/certify.h"
#include "medial_vk/hull_fits.h"
#include "medial_vk/hull_union.h"
#include "medial_vk/sphere_fits.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kResolution = 60;
/// Of a medial surface with fewer points, a finer one is taken.
constexpr std::size_t kFewPoints = 200;
constexpr std::uint32_t kFinestResolution = 480;
/// Of the bounds of the volume, as shares of the solid's.
constexpr double kGreatestWidth = 1e-3, kLeastWidth = 1e-5, kWidthOfUncovered = 0.02;
constexpr std::array<HullChoice, 4> kKinds = {HullChoice::kBalls, HullChoice::kCapsules, HullChoice::kCones,
                                              HullChoice::kSlabs};

SoughtHulls sought_of(HullChoice choice) {
  switch (choice) {
    case HullChoice::kCapsules:
      return {2, true};
    case HullChoice::kCones:
      return {2, false};
    case HullChoice::kSlabs:
      return {3, false};
    default:
      return {1, false};
  }
}

std::size_t parameters_of(HullChoice choice) {
  switch (choice) {
    case HullChoice::kCapsules:
      return parameters_of(HullKind::kCapsule);
    case HullChoice::kCones:
      return parameters_of(HullKind::kCone);
    case HullChoice::kSlabs:
      return parameters_of(HullKind::kSlab);
    default:
      return parameters_of(HullKind::kBall);
  }
}

/// The width of the bounds of the covered volume where this share is uncovered, as a share of the solid's.
double derived_width(double uncovered) {
  return std::clamp(kWidthOfUncovered * uncovered, kLeastWidth, kGreatestWidth);
}

Status check_options(const HullFitOptions& options, const Solid& solid) {
  const auto usage = [](const char* message) { return Error{ErrorCode::kUsage, message}; };
  const bool has_goal = options.count > 0 || options.parameters > 0 || options.error > 0 || options.max_gap > 0;
  if (!has_goal) return usage("one of `count`, `parameters`, `error` and `max_gap` is required");
  if (options.count > kMostHulls) return usage("`count` is at most 4096");
  if (!(options.error >= 0 && options.error < 1)) return usage("`error` is a share in [0, 1)");
  if (!(options.max_gap >= 0) || !std::isfinite(options.max_gap)) return usage("`max_gap` is a finite length");
  if (!(options.width >= 0 && options.width < 1)) return usage("`width` is a share in [0, 1)");
  if (options.resolution > 4096) return usage("`resolution` is at most 4096");
  if (options.error > 0 && !solid.has_volume())
    return usage("`error` requires a mesh that encloses a volume cleanly; a limit of `count` does not");
  return {};
}

/// The work on one solid.
class HullFitter {
 public:
  HullFitter(const Solid& solid, const HullFitOptions& options, const Extractor& extractor,
             const StageProgress& progress, const std::stop_token& stop)
      : solid_(solid),
        options_(options),
        extractor_(extractor),
        stop_(stop),
        threads_(options.threads, [this] { return !stop_.stop_requested(); }),
        heartbeat_(progress) {}

  Result<HullFit> run() {
    if (Status status = check_options(options_, solid_); !status) return status.error();
    if (options_.choice == HullChoice::kMix) return best_of_kinds();
    return fit(options_.choice);
  }

 private:
  /// The best set of one kind: every mix of kinds that is tried. One kind may not fit where another does.
  Result<HullFit> best_of_kinds() {
    std::optional<HullFit> best;
    Error last;
    for (const HullChoice kind : kKinds) {
      Result<HullFit> found = fit(kind);
      if (!found) {
        const bool is_unmet = found.error().code == ErrorCode::kUsage;
        if (!is_unmet && found.error().code != ErrorCode::kInvalidMesh) return found.error();
        if (is_unmet || last.message.empty()) last = found.error();
        continue;
      }
      if (!best || is_better(found.value(), *best)) best = std::move(found).value();
    }
    if (!best) return last;
    return std::move(*best);
  }

  /// By goals without a number, fewer parameters; else more volume.
  bool is_better(const HullFit& a, const HullFit& b) const {
    const auto parameters = [](const HullFit& fit) {
      std::size_t sum = 0;
      for (const BallHull& hull : fit.hulls) sum += parameters_of(kind_of(hull));
      return sum;
    };
    if (options_.count == 0 && options_.parameters == 0) return parameters(a) < parameters(b);
    return a.covered.lower > b.covered.lower;
  }

  std::size_t most_hulls(HullChoice choice) const {
    std::size_t most = options_.count > 0 ? options_.count : kMostHulls;
    if (options_.parameters > 0) most = std::min(most, options_.parameters / parameters_of(choice));
    return most;
  }

  Result<HullFit> fit(HullChoice choice) {
    const std::size_t most = most_hulls(choice);
    if (most == 0) {
      return Error{ErrorCode::kUsage,
                   format_text("`parameters` must be at least {}, those of one hull", parameters_of(choice))};
    }
    if (choice == HullChoice::kBalls) return fit_balls(most);
    if (Status status = find_medial_balls(); !status) return status.error();
    if (medial_.empty()) return Error{ErrorCode::kInvalidMesh, "no hull fits into the solid: it has no medial points"};
    HullFamily family(solid_, medial_, sought_of(choice), {}, threads_);
    return fewest(family, most);
  }

  /// The smallest set that meets the goals beside the number, or the one with that number.
  Result<HullFit> fewest(HullFamily& family, std::size_t most) {
    const bool by_number = options_.error == 0 && options_.max_gap == 0;
    if (by_number) return measured(family, most);
    std::size_t below = 0;
    for (std::size_t top = 1;; top = HullFamily::top_for(top + 1)) {
      Result<HullFit> found = measured(family, std::min(top, most));
      const bool is_last = top >= most || searched_ < top;
      if (!found && (is_last || found.error().code != ErrorCode::kInvalidMesh)) return found;
      if (found && meets_goals(found.value()))
        return fewest_between(family, below, std::min(top, most), std::move(found));
      if (is_last) return unmet(found.value(), searched_ < std::min(top, most));
      below = top;
    }
  }

  /// By bisection, of set sizes in (below, enough], of which the last one meets the goals.
  Result<HullFit> fewest_between(HullFamily& family, std::size_t below, std::size_t enough, Result<HullFit> best) {
    while (enough - below > 1) {
      const std::size_t middle = below + (enough - below) / 2;
      Result<HullFit> found = measured(family, middle);
      if (!found && found.error().code != ErrorCode::kInvalidMesh) return found;
      if (found && meets_goals(found.value())) {
        best = std::move(found);
        enough = middle;
      } else {
        below = middle;
      }
    }
    return best;
  }

  bool meets_goals(const HullFit& fit) const {
    if (options_.error > 0 && !(*fit.solid_volume - fit.covered.lower <= options_.error * *fit.solid_volume))
      return false;
    return options_.max_gap == 0 || fit.gap.upper <= options_.max_gap;
  }

  /// `has_ended`: the search finds no more hulls, so that a greater number would not help.
  Error unmet(const HullFit& fit, bool has_ended) const {
    const std::size_t count = fit.hulls.size();
    const char* verb = count == 1 ? "hull leaves" : "hulls leave";
    const bool by_gap = options_.max_gap > 0 && fit.gap.upper > options_.max_gap;
    const std::string what =
        by_gap ? format_text("a gap of {:.4g}", fit.gap.upper)
               : format_text("{:.4g} of the volume uncovered", 1 - fit.covered.lower / *fit.solid_volume);
    const char* goal = by_gap ? "`max_gap`" : "`error`";
    if (has_ended) {
      return {ErrorCode::kUsage,
              format_text("{} {} {}, and the search finds no more; raise {}", count, verb, what, goal)};
    }
    return {ErrorCode::kUsage, format_text("{} {} {}; raise `count` or {}", count, verb, what, goal)};
  }

  Status find_medial_balls() {
    if (!medial_.empty()) return {};
    ExtractionOptions options;
    options.threads = options_.threads;
    options.resolution = options_.resolution > 0 ? options_.resolution : kResolution;
    while (true) {
      if (Status status = extract(options); !status) return status;
      if (options_.resolution > 0 || medial_.size() >= kFewPoints || options.resolution >= kFinestResolution) return {};
      options.resolution *= 2;
    }
  }

  Status extract(const ExtractionOptions& options) {
    const StageProgress report = [&](const char*, double done) { heartbeat_.tell("medial points", done); };
    const Result<CertifiedExtraction> found = extract_and_certify(solid_.indexed(), options, extractor_, report, stop_);
    if (!found) return found.error();
    medial_.clear();
    for (const MedialSphere& sphere : found.value().extraction.spheres) {
      // As for fits of balls: a solid may be thinner than the rounding of an extraction in float.
      if (solid_.contains(sphere.centre)) medial_.push_back({sphere.centre, sphere.radius});
    }
    return {};
  }

  Result<HullFit> measured(HullFamily& family, std::size_t count) {
    const std::vector<BallHull> set = family.set_of(count, [&](double done) { heartbeat_.tell("hulls", done); });
    if (set.empty()) return Error{ErrorCode::kInvalidMesh, "no hull fits into the solid"};
    searched_ = set.size();
    FreedHulls freed = free_hulls(solid_, set, threads_);
    if (freed.hulls.empty()) return Error{ErrorCode::kInvalidMesh, "no hull fits into the solid with a proof"};
    HullFit fit;
    fit.hulls = std::move(freed.hulls);
    fit.left_out = set.size() - fit.hulls.size();
    fit.greatest_shrink = freed.greatest_shrink;
    return with_measures(std::move(fit));
  }

  /// By the search for balls, which is better than that for hulls at one ball each.
  Result<HullFit> fit_balls(std::size_t most) {
    SphereFitOptions options;
    const bool by_number = options_.error == 0 && options_.max_gap == 0;
    options.count = by_number || options_.count > 0 || options_.parameters > 0 ? most : 0;
    // The bounds of volume and gap below have a width, and must meet the goals, too.
    const double width = options_.width > 0 ? options_.width : derived_width(options_.error);
    options.error = std::max(0.5 * options_.error, options_.error - width);
    options.max_gap = std::max(0.5 * options_.max_gap, options_.max_gap - hull_gap_width(solid_, options_.max_gap));
    options.resolution = options_.resolution;
    options.threads = options_.threads;
    options.balls_only = by_number;
    const StageProgress report = [&](const char* stage, double done) {
      heartbeat_.tell(std::string_view(stage) == "medial points" ? "medial points" : "hulls", done);
    };
    const Result<SphereFit> found = fit_spheres(solid_.indexed(), options, extractor_, report, stop_);
    if (!found) return found.error();
    HullFit fit;
    for (const Ball& ball : found.value().levels.back()) fit.hulls.push_back(hull_of(ball));
    FreedHulls freed = free_hulls(solid_, fit.hulls, threads_);
    fit.left_out = fit.hulls.size() - freed.hulls.size();
    if (freed.hulls.empty()) return Error{ErrorCode::kInvalidMesh, "no ball fits into the solid with a proof"};
    fit.hulls = std::move(freed.hulls);
    fit.greatest_shrink = freed.greatest_shrink;
    Result<HullFit> measured = with_measures(std::move(fit));
    if (!measured || meets_goals(measured.value())) return measured;
    return unmet(measured.value(), false);
  }

  Result<HullFit> with_measures(HullFit fit) {
    heartbeat_.tell("measures", 0);
    fit.proof = prove_hulls(solid_, fit.hulls, threads_);
    if (!fit.proof.proved()) {
      return Error{ErrorCode::kInternal,
                   format_text("{} of {} hulls are not proved to lie inside", fit.proof.failed, fit.proof.tested)};
    }
    if (solid_.has_volume()) fit.solid_volume = solid_.volume();
    fit.gap = measure_hull_gap(solid_, fit.hulls, options_.max_gap, threads_);
    heartbeat_.tell("measures", 0.5);
    const Result<Bounds> covered = measure_covered(fit);
    if (!covered) return covered.error();
    fit.covered = covered.value();
    heartbeat_.tell("measures", 1);
    return fit;
  }

  /// With a derived width: first with the greatest, which tells how much is uncovered.
  Result<Bounds> measure_covered(const HullFit& fit) const {
    const double scale = fit.solid_volume ? *fit.solid_volume : greatest_volume(fit.hulls);
    HullUnionOptions options;
    options.width = scale * (options_.width > 0 ? options_.width : kGreatestWidth);
    options.threads = options_.threads;
    Result<Bounds> covered = measure_hull_union(fit.hulls, options, stop_);
    if (options_.width > 0 || !covered || !fit.solid_volume) return covered;
    options.width = scale * derived_width(1 - covered.value().upper / scale);
    return options.width < kGreatestWidth * scale ? measure_hull_union(fit.hulls, options, stop_) : covered;
  }

  /// A scale for meshes that enclose no volume cleanly: that of the largest hull.
  static double greatest_volume(const std::vector<BallHull>& hulls) {
    double greatest = 0;
    for (const BallHull& hull : hulls) greatest = std::max(greatest, volume_of(hull));
    return greatest;
  }

  const Solid& solid_;
  const HullFitOptions& options_;
  const Extractor& extractor_;
  const std::stop_token& stop_;
  Threads threads_;
  Heartbeat heartbeat_;
  std::vector<Ball> medial_;
  std::size_t searched_ = 0;  // hulls of the last set of a search, before any was left out
};

}  // namespace

Result<HullFit> fit_hulls(const IndexedMesh& mesh, const HullFitOptions& options, const Extractor& extractor,
                          const StageProgress& progress, const std::stop_token& stop) {
  try {
    const Result<Solid> solid = Solid::build(mesh);
    if (!solid) return solid.error();
    return HullFitter(solid.value(), options, extractor, progress, stop).run();
  } catch (const Stopped&) {
    return Error{ErrorCode::kInterrupted, "interrupted"};
  } catch (const std::bad_alloc&) {
    return out_of_memory("fitting hulls", "try a lower `count`");
  } catch (const std::exception& error) {
    return Error{ErrorCode::kInternal, std::string("internal error: ") + error.what()};
  }
}

Result<HullFit> fit_hulls(const IndexedMesh& mesh, const HullFitOptions& options, Context& context,
                          const StageProgress& progress, const std::stop_token& stop) {
  return fit_hulls(mesh, options, device_extractor(context), progress, stop);
}

}  // namespace medial_vk
