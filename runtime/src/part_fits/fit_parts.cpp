// Balls for the parts of an assembly: distributed by need, fitted part by part, moved to the frames of the links.
#include "medial_vk/part_fits.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <new>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "base/format_text.h"
#include "base/host_memory.h"
#include "base/point_ops.h"
#include "base/quoted.h"
#include "base/stopwatch.h"
#include "part_fits/distribute_balls.h"
#include "part_fits/kept_extractions.h"
#include "part_fits/part_groups.h"
#include "part_fits/parts_progress.h"
#include "part_fits/place_ball.h"
#include "part_fits/resident_meshes.h"
#include "part_fits/side_by_side.h"
#include "sphere_fits/methods/by_distance.h"
#include "sphere_fits/methods/kept_search.h"

namespace medial_vk {
namespace {

/// Gives each part an extractor of its own.
using MakeExtractor = std::function<Extractor()>;

double volume_of(const Ball& ball) { return 4.0 / 3 * std::numbers::pi * ball.radius * ball.radius * ball.radius; }

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
  std::size_t most = 0;          // of its group
  std::size_t curve_length = 0;  // that is required
  bool is_settled = false;       // the number is final
  NeedCurve curve;
  // While they are needed; else empty.
  Extractor extractor;
  std::unique_ptr<KeptSearch> search;
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
      if (Status status = check_part(part); !status) return named(part, status.error());
    }
    std::vector<PartGroup> groups = groups_of(parts_, options_);
    for (const PartGroup& group : groups) {
      if (Status status = check_group(group, parts_, options_); !status) return status.error();
      for (const std::size_t part : group.parts) states_[part].count = states_[part].most = group.balls;
    }
    if (Status status = fit_all(groups); !status) return status.error();
    for (const PartGroup& group : groups) {
      if (Status status = check_needed(group, fits_, parts_, options_); !status) return status.error();
    }
    align_levels();
    return std::move(fits_);
  }

 private:
  bool is_by_gap() const {
    const SphereFitOptions& spheres = options_.spheres;
    return spheres.aim == SphereAim::kDistance && has_kept_curve(spheres);
  }

  bool shares() const { return options_.total > 0 || options_.count_per_link > 0; }

  void expect(const std::vector<std::size_t>& numbers) {
    const auto is_mesh = [&](std::size_t number) { return !parts_[number].ball; };
    progress_.expect(static_cast<std::size_t>(std::ranges::count_if(numbers, is_mesh)));
  }

  /// Fits parts whose number of balls is final, and finds curves of the others, until all are fitted. Curves are
  /// computed for an equal share first, and longer ones for parts that get more: in the end every curve has the
  /// required length, and the shares are those of complete curves.
  Status fit_all(std::vector<PartGroup>& groups) {
    std::vector<std::size_t> next;
    for (PartGroup& group : groups) begin(group, next);
    while (!next.empty()) {
      expect(next);
      // The most work first. Equal ones keep their order.
      std::ranges::stable_sort(next, std::greater<>(), [&](std::size_t part) { return balls_to_find(part); });
      Status done = work_side_by_side(parts_, next, options_.threads, [&](std::size_t part, unsigned threads) {
        Stopwatch stopwatch;
        Status status = states_[part].is_settled ? fit_part(part, threads) : find_curve(part, threads);
        fits_[part].measurements.seconds += stopwatch.lap();
        return status;
      });
      if (!done) return done;
      next.clear();
      for (PartGroup& group : groups) {
        if (!group.is_settled) distribute(group, next);
      }
    }
    return {};
  }

  std::size_t balls_to_find(std::size_t part) const {
    const PartState& state = states_[part];
    const std::size_t wanted = state.is_settled ? state.count : state.curve_length,
                      found = state.curve.uncovered.size();
    return parts_[part].ball ? 0 : wanted - std::min(wanted, found);
  }

  /// No curve is needed where a single part can have more than one ball.
  void begin(PartGroup& group, std::vector<std::size_t>& next) {
    const bool is_shared = shares() && group.parts.size() > 1 && options_.spheres.max_reach == 0;
    if (is_shared && group.parts.size() - group.exact > 1) {
      for (const std::size_t part : group.parts) states_[part].curve_length = curve_length(group.equal_share());
      next.insert(next.end(), group.parts.begin(), group.parts.end());
      return;
    }
    for (const std::size_t part : group.parts) {
      if (is_shared) states_[part].count = parts_[part].ball ? 1 : group.balls - group.exact;
      if (shares() && options_.spheres.max_reach > 0) states_[part].count = 0;  // as many as are needed
    }
    settle(group, next);
  }

  void settle(PartGroup& group, std::vector<std::size_t>& next) {
    group.is_settled = true;
    for (const std::size_t part : group.parts) states_[part].is_settled = true;
    next.insert(next.end(), group.parts.begin(), group.parts.end());
  }

  /// Adds the parts whose curves are too short for their new counts to `next`, or all if none is.
  void distribute(PartGroup& group, std::vector<std::size_t>& next) {
    std::vector<NeedCurve> curves;
    for (const std::size_t part : group.parts) curves.push_back(states_[part].curve);
    const std::vector<std::size_t> counts =
        is_by_gap() ? distribute_by_gap(curves, group.balls) : distribute_balls(curves, group.balls);
    bool is_settled = true;
    for (std::size_t i = 0; i < group.parts.size(); ++i) {
      PartState& state = states_[group.parts[i]];
      state.count = counts[i];
      if (is_long_enough(state)) continue;
      state.curve_length = std::max(state.curve_length, curve_length(state.count));
      next.push_back(group.parts[i]);
      is_settled = false;
    }
    if (is_settled) settle(group, next);
  }

  /// The sets of the source's method are not prefixes of each other: its curves are continued instead.
  bool is_long_enough(const PartState& state) const {
    if (is_by_gap()) return state.curve.is_ball || state.curve.ends || state.curve.gaps.size() >= state.count;
    return state.curve.is_ball || state.curve.ends || options_.spheres.method == SphereMethod::kSource ||
           state.curve.uncovered.size() >= curve_length(state.count);
  }

  Status find_curve(std::size_t number, unsigned threads) {
    const Part& part = parts_[number];
    PartState& state = states_[number];
    state.curve = {};
    state.curve.is_ball = part.ball.has_value();
    if (state.curve.is_ball) return {};
    SphereFitOptions options = fit_options(state.curve_length, threads);
    if (is_by_gap()) return find_gaps(number, options);
    options.aim = SphereAim::kVolume;
    const Result<CoverageCurve> found =
        has_kept_curve(options)
            ? search_of(number, options).curve(options.count, reporter(number), stop_)
            : measure_coverage_curve(*part.mesh, options, extractor_of(number), reporter(number), stop_);
    if (!found) return named(part, found.error());
    progress_.finish(number);
    const double whole =
        part.volume.value_or(found.value().solid_volume.value_or(enclosed_with_middle(part.mesh->prepared())));
    for (const double covered : found.value().covered) state.curve.uncovered.push_back(whole - covered);
    state.curve.ends = found.value().ends;
    return {};
  }

  Status find_gaps(std::size_t number, const SphereFitOptions& options) {
    PartState& state = states_[number];
    Result<std::vector<double>> gaps = search_of(number, options).gaps(options.count, stop_);
    if (!gaps) return named(parts_[number], gaps.error());
    progress_.finish(number);
    state.curve.ends = gaps.value().size() < options.count;
    state.curve.gaps = std::move(gaps).value();
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

  /// One for the curve of a part and its balls.
  KeptSearch& search_of(std::size_t number, const SphereFitOptions& options) {
    std::unique_ptr<KeptSearch>& search = states_[number].search;
    if (!search) {
      const std::size_t most = curve_length(states_[number].most);
      search = std::make_unique<KeptSearch>(*parts_[number].mesh, options, most, extractor_of(number));
    }
    return *search;
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
    if (Status status = check_position(part); !status) return named(part, status.error());
    SphereFitOptions options = fit_options(state.count, threads);
    const Result<SphereAim> aim = aim_for(*part.mesh, options);
    if (!aim) return named(part, aim.error());
    options.aim = aim.value();
    Result<SphereFit> fitted = is_kept(options)
                                   ? search_of(number, options).fit(options.count, options.aim, reporter(number), stop_)
                                   : fit_spheres(*part.mesh, options, extractor_of(number), reporter(number), stop_);
    if (!fitted) return named(part, fitted.error());
    release(number);
    progress_.finish(number);
    take(part, std::move(fitted).value(), fit);
    return {};
  }

  void release(std::size_t number) {
    const std::lock_guard lock(extractions_);
    states_[number].search.reset();
    states_[number].extractor = {};
  }

  void take(const Part& part, SphereFit fitted, PartFit& fit) const {
    fit.aim = fitted.aim;
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
