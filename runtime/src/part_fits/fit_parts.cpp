// Balls for the parts of an assembly: distributed by need, fitted part by part, moved to the frames of the links.
#include "medial_vk/part_fits.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <new>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "base/format_text.h"
#include "base/host_memory.h"
#include "base/point_ops.h"
#include "base/quoted.h"
#include "base/stopwatch.h"
#include "part_fits/distribute_balls.h"
#include "part_fits/kept_extractions.h"
#include "part_fits/parts_progress.h"
#include "part_fits/place_ball.h"
#include "part_fits/resident_meshes.h"
#include "part_fits/side_by_side.h"

namespace medial_vk {
namespace {

bool is_positive(double x) { return std::isfinite(x) && x > 0; }

/// Gives each part an extractor of its own.
using MakeExtractor = std::function<Extractor()>;

double volume_of(const Ball& ball) { return 4.0 / 3 * std::numbers::pi * ball.radius * ball.radius * ball.radius; }

/// Parts that share a number of balls: those of a link, or all.
struct Group {
  std::vector<std::size_t> parts;
  std::size_t balls = 0;
};

/// An open mesh has no volume; the volume between its surface and the middle of its box serves instead.
double enclosed_with_middle(const PreparedMesh& mesh) {
  const Point middle = 0.5 * (mesh.report.lower + mesh.report.upper);
  double six_times = 0;
  for (const auto& t : mesh.mesh.triangles) {
    const Point a = mesh.mesh.vertices[t[0]] - middle, b = mesh.mesh.vertices[t[1]] - middle;
    six_times += dot(a, cross(b, mesh.mesh.vertices[t[2]] - middle));
  }
  return std::fabs(six_times) / 6;
}

/// The present knowledge about a part.
struct PartState {
  std::size_t count = 0;         // of its balls, or of its group until they are distributed; 0: other goals give it
  std::size_t curve_length = 0;  // that is required
  NeedCurve curve;
  Extractor extractor;  // while it is needed; else an empty function
};

class Fitting {
 public:
  Fitting(std::span<const Part> parts, const PartFitOptions& options, const MakeExtractor& make_extractor,
          const StageProgress& progress, const std::stop_token& stop)
      : parts_(parts),
        options_(options),
        make_extractor_(make_extractor),
        progress_(progress, parts.size()),
        stop_(stop),
        states_(parts.size()),
        fits_(parts.size()) {}

  Result<std::vector<PartFit>> run() {
    if (options_.total > 0 && options_.count_per_link > 0) {
      return Error{ErrorCode::kUsage, "`count_per_link` and `total` cannot be used together"};
    }
    if (options_.spheres.threads != 0 && options_.spheres.threads != options_.threads) {
      return Error{ErrorCode::kUsage, "`threads` of the spheres is neither 0 nor that of the parts"};
    }
    for (const Part& part : parts_) {
      if (Status status = check(part); !status) return named(part, status.error());
    }
    const std::vector<Group> groups = make_groups();
    for (const Group& group : groups) {
      if (Status status = check(group); !status) return status.error();
      for (const std::size_t part : group.parts) states_[part].count = group.balls;
    }
    std::vector<std::size_t> all(parts_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    expect(all);
    if (Status status = count_by_need(groups); !status) return status.error();
    if (Status status = work_on(all, &Fitting::fit_part); !status) return status.error();
    align_levels();
    return std::move(fits_);
  }

 private:
  bool shares() const { return options_.total > 0 || options_.count_per_link > 0; }

  /// In the order of their first parts.
  std::vector<Group> make_groups() const {
    std::vector<Group> groups;
    std::map<std::string, std::size_t> of_link;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const std::string key = options_.total > 0 ? std::string() : shares() ? parts_[i].link : std::to_string(i);
      const auto [group, is_new] = of_link.emplace(key, groups.size());
      if (is_new) {
        groups.emplace_back();
        groups.back().balls = options_.total > 0 ? options_.total
                              : shares()         ? options_.count_per_link
                                                 : options_.spheres.count;
      }
      groups[group->second].parts.push_back(i);
    }
    return groups;
  }

  static Status check(const Part& part) {
    if (!part.mesh && !part.ball) return Error{ErrorCode::kUsage, "it has neither `mesh` nor `ball`"};
    if (part.mesh && part.ball) return Error{ErrorCode::kUsage, "it has both `mesh` and `ball`"};
    if (!is_rigid(part.pose)) return Error{ErrorCode::kUsage, "its `pose` is no rigid motion"};
    if (part.ball && (!is_positive(part.ball->radius) || !std::isfinite(length(part.ball->centre)))) {
      return Error{ErrorCode::kUsage, "its `ball` has no finite centre and positive radius"};
    }
    if (!part.ball && part.volume && !is_positive(*part.volume))
      return Error{ErrorCode::kUsage, "its `volume` is not positive"};
    return {};
  }

  Status check(const Group& group) const {
    const std::size_t parts = group.parts.size();
    if (!shares() || group.balls >= parts) return {};
    if (options_.total > 0) {
      return Error{ErrorCode::kUsage,
                   format_text("{} parts need a ball each; raise `total` from {}", parts, group.balls)};
    }
    const std::string link = medial_vk::quoted(parts_[group.parts.front()].link);
    return Error{ErrorCode::kUsage,
                 format_text("link {} has {} parts, which need a ball each; raise `count_per_link` from {}", link,
                             parts, group.balls)};
  }

  void expect(const std::vector<std::size_t>& numbers) {
    const auto is_mesh = [&](std::size_t number) { return !parts_[number].ball; };
    progress_.expect(static_cast<std::size_t>(std::ranges::count_if(numbers, is_mesh)));
  }

  Status work_on(const std::vector<std::size_t>& numbers, Status (Fitting::*work)(std::size_t, unsigned)) {
    return work_side_by_side(parts_, numbers, options_.threads,
                             [&](std::size_t number, unsigned threads) { return (this->*work)(number, threads); });
  }

  /// Distributes the balls of each group that has several parts. Curves are computed for an equal share first, and
  /// longer ones for parts that get more: in the end every curve has the required length, and the shares are those of
  /// complete curves.
  Status count_by_need(const std::vector<Group>& groups) {
    if (!shares()) return {};
    std::vector<std::size_t> curves;
    for (const Group& group : groups) {
      if (group.parts.size() == 1) continue;
      for (const std::size_t part : group.parts) states_[part].curve_length = curve_length(equal_share(group));
      curves.insert(curves.end(), group.parts.begin(), group.parts.end());
    }
    std::ranges::sort(curves);
    while (!curves.empty()) {
      expect(curves);
      if (Status status = work_on(curves, &Fitting::find_curve); !status) return status;
      curves.clear();
      for (const Group& group : groups) {
        if (group.parts.size() > 1) distribute(group, curves);
      }
      std::ranges::sort(curves);
    }
    return {};
  }

  std::size_t equal_share(const Group& group) const {
    const std::size_t balls = static_cast<std::size_t>(
        std::ranges::count_if(group.parts, [&](std::size_t part) { return parts_[part].ball.has_value(); }));
    const std::size_t others = group.parts.size() - balls;
    return others == 0 ? 1 : std::max<std::size_t>(1, (group.balls - balls) / others);
  }

  /// Adds the parts whose curves are too short for their new counts to `too_short`.
  void distribute(const Group& group, std::vector<std::size_t>& too_short) {
    std::vector<NeedCurve> curves;
    for (const std::size_t part : group.parts) curves.push_back(states_[part].curve);
    const std::vector<std::size_t> counts = distribute_balls(curves, group.balls);
    for (std::size_t i = 0; i < group.parts.size(); ++i) {
      PartState& state = states_[group.parts[i]];
      state.count = counts[i];
      if (is_long_enough(state)) continue;
      state.curve_length = std::max(state.curve_length, curve_length(state.count));
      too_short.push_back(group.parts[i]);
    }
  }

  /// The sets of the source's method are not prefixes of each other: its curves are continued instead.
  bool is_long_enough(const PartState& state) const {
    return state.curve.is_ball || state.curve.ends || options_.spheres.method == SphereMethod::kSource ||
           state.curve.uncovered.size() >= curve_length(state.count);
  }

  Status find_curve(std::size_t number, unsigned threads) {
    const Part& part = parts_[number];
    PartState& state = states_[number];
    state.curve = {};
    state.curve.is_ball = part.ball.has_value();
    if (state.curve.is_ball) return {};
    const Result<CoverageCurve> found = measure_coverage_curve(*part.mesh, fit_options(state.curve_length, threads),
                                                               extractor_of(number), reporter(number), stop_);
    if (!found) return named(part, found.error());
    progress_.finish(number);
    const double whole =
        part.volume.value_or(found.value().solid_volume.value_or(enclosed_with_middle(part.mesh->prepared())));
    for (const double covered : found.value().covered) state.curve.uncovered.push_back(whole - covered);
    state.curve.ends = found.value().ends;
    return {};
  }

  SphereFitOptions fit_options(std::size_t count, unsigned threads) const {
    SphereFitOptions options = options_.spheres;
    options.count = count;
    options.threads = threads;
    return options;
  }

  /// The curve of a part and its spheres share the extractor, and so its medial spheres.
  const Extractor& extractor_of(std::size_t number) {
    Extractor& extractor = states_[number].extractor;
    if (!extractor) extractor = kept_extractions(in_turn());
    return extractor;
  }

  /// An extractor that waits for those of the other parts: extractors need not be safe for several threads, and an
  /// extraction has the device and its memory to itself. It has all threads, as the others mostly wait for it.
  Extractor in_turn() {
    return [this, extractor = made_extractor()](const IndexedMesh& mesh, ExtractionOptions options,
                                                const ProgressCallback& progress, const std::stop_token& stop) {
      const std::lock_guard lock(extractions_);
      options.threads = options_.threads;
      return extractor(mesh, options, progress, stop);
    };
  }

  Extractor made_extractor() {
    const std::lock_guard lock(extractions_);
    return make_extractor_();
  }

  StageProgress reporter(std::size_t number) {
    return [this, number](const char* stage, double done) { progress_.report(number, stage, done); };
  }

  Status fit_part(std::size_t number, unsigned threads) {
    const Part& part = parts_[number];
    PartState& state = states_[number];
    PartFit& fit = fits_[number];
    fit.count = state.count;
    if (part.ball) {
      fit.levels = {{placed(part, *part.ball)}};
      fit.reach = {{}};
      fit.solid_volume = fit.spheres_volume = volume_of(*part.ball);
      fit.of_shape = true;
      return {};
    }
    Stopwatch stopwatch;
    if (Status status = check_position(part); !status) return named(part, status.error());
    Result<SphereFit> fitted =
        fit_spheres(*part.mesh, fit_options(state.count, threads), extractor_of(number), reporter(number), stop_);
    if (!fitted) return named(part, fitted.error());
    release_extractor(number);
    progress_.finish(number);
    take(part, std::move(fitted).value(), fit);
    fit.measurements.seconds = stopwatch.lap();
    return {};
  }

  void release_extractor(std::size_t number) {
    const std::lock_guard lock(extractions_);
    states_[number].extractor = {};
  }

  /// Bounds the loss or gain of radii where balls are moved to the frame of the link. Earlier measurements then
  /// remain true to the digits that are shown.
  static Status check_position(const Part& part) {
    constexpr double kMost = 1e-6;  // of the diagonal
    const MeshReport& report = part.mesh->prepared().report;
    double reach = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      reach = std::max({reach, std::fabs(report.lower[k]), std::fabs(report.upper[k])});
    }
    if (placement_rounding(part.pose, 2 * reach) <= kMost * length(report.upper - report.lower)) return {};
    return Error{ErrorCode::kInvalidMesh,
                 "it lies so far from the origin of its link that its balls can hardly be placed there (double "
                 "precision); move it closer"};
  }

  void take(const Part& part, SphereFit fitted, PartFit& fit) const {
    fit.reach = std::move(fitted.reach);
    place_levels(part, fitted.levels, fit);
    fit.proved = std::move(fitted.levels.back());
    if (options_.spheres.balls_only) return;
    fit.measures = std::move(fitted.measures);
    fit.solid_volume = fitted.solid_volume;
    // Balanced balls are measured by the facets, for which they were balanced.
    fit.of_shape = options_.spheres.contract != SphereContract::kBalanced && part.volume &&
                   measure_against(*part.volume, *fit.measures);
    if (fit.of_shape) fit.solid_volume = part.volume;
    fit.spheres_volume = fit.measures->volume.balls;
  }

  void place_levels(const Part& part, const std::vector<std::vector<Ball>>& sets, PartFit& fit) const {
    for (const std::vector<Ball>& set : sets) {
      std::vector<Ball> balls;
      balls.reserve(set.size());
      for (const Ball& ball : set) balls.push_back(placed(part, ball));
      fit.levels.push_back(std::move(balls));
    }
  }

  /// In the frame of the link.
  Ball placed(const Part& part, const Ball& ball) const {
    // Not rounded.
    if (part.ball && ball.centre == Point{0, 0, 0}) return {part.pose.shift, ball.radius};
    const SphereContract contract = options_.spheres.contract;
    const int grow = contract == SphereContract::kInside ? -1 : contract == SphereContract::kCover ? 1 : 0;
    return place_ball(part.pose, ball, grow);
  }

  static Error named(const Part& part, Error error) {
    if (error.code == ErrorCode::kInterrupted) return error;
    error.message =
        format_text("link {}, {}: {}", medial_vk::quoted(part.link), medial_vk::quoted(part.name), error.message);
    return error;
  }

  /// The coarsest level of a part with few levels also serves as the levels below it.
  void align_levels() {
    std::size_t most = 0;
    for (const PartFit& fit : fits_) most = std::max(most, fit.levels.size());
    for (PartFit& fit : fits_) {
      const std::size_t missing = most - fit.levels.size();
      fit.levels.insert(fit.levels.begin(), missing, std::vector<Ball>(fit.levels.front()));
      fit.reach.insert(fit.reach.begin(), missing, ReachOut(fit.reach.front()));
    }
  }

  std::span<const Part> parts_;
  PartFitOptions options_;
  const MakeExtractor& make_extractor_;
  PartsProgress progress_;
  const std::stop_token& stop_;
  std::mutex extractions_;
  std::vector<PartState> states_;
  std::vector<PartFit> fits_;
};

/// Converts exceptions to errors.
Result<std::vector<PartFit>> guarded(const std::function<Result<std::vector<PartFit>>()>& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return out_of_memory("fitting balls to parts", "try a lower `count`");
  } catch (const std::length_error&) {
    return out_of_memory("fitting balls to parts", "try a lower `count`");
  } catch (const std::exception& error) {
    return Error{ErrorCode::kInternal, std::string("internal error: ") + error.what()};
  }
}

}  // namespace

Result<std::vector<PartFit>> fit_parts(std::span<const Part> parts, const PartFitOptions& options,
                                       const Extractor& extractor, const StageProgress& progress,
                                       const std::stop_token& stop) {
  return guarded([&] {
    return Fitting(
               parts, options, [&] { return extractor; }, progress, stop)
        .run();
  });
}

Result<std::vector<PartFit>> fit_parts(std::span<const Part> parts, const PartFitOptions& options, Context& context,
                                       const StageProgress& progress, const std::stop_token& stop) {
  return guarded([&] {
    ResidentMeshes meshes([&] { return device_extractor(context); });
    return Fitting(
               parts, options, [&] { return meshes.extractor(); }, progress, stop)
        .run();
  });
}

}  // namespace medial_vk
