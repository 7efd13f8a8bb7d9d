// Balls for the parts of an assembly: distributed by need, fitted part by part, moved to the frames of the links.
#include "medial_vk/part_fits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <map>
#include <new>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "base/host_memory.h"
#include "base/point_ops.h"
#include "base/quoted.h"
#include "base/stopwatch.h"
#include "part_fits/distribute_balls.h"
#include "part_fits/kept_extractions.h"
#include "part_fits/place_ball.h"
#include "part_fits/resident_meshes.h"

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

class Fitting {
 public:
  Fitting(std::span<const Part> parts, const PartFitOptions& options, const MakeExtractor& make_extractor,
          const StageProgress& progress, const std::stop_token& stop)
      : parts_(parts),
        options_(options),
        make_extractor_(make_extractor),
        progress_(progress),
        stop_(stop),
        extractors_(parts.size()),
        fits_(parts.size()) {}

  Result<std::vector<PartFit>> run() {
    if (options_.total > 0 && options_.count_per_link > 0) {
      return Error{ErrorCode::kUsage, "`count_per_link` and `total` cannot be used together"};
    }
    if (options_.spheres.threads != 0 && options_.spheres.threads != options_.threads) {
      return Error{ErrorCode::kUsage, "`threads` of the spheres is neither 0 nor that of the parts"};
    }
    options_.spheres.threads = options_.threads;
    for (const Part& part : parts_) {
      if (Status status = check(part); !status) return named(part, status.error());
    }
    const std::vector<Group> groups = make_groups();
    for (const Group& group : groups) {
      if (Status status = check(group); !status) return status.error();
      for (const std::size_t part : group.parts) steps_ += parts_[part].ball ? 0 : group.parts.size() > 1 ? 2 : 1;
    }
    for (const Group& group : groups) {
      if (Status status = fit(group); !status) return status.error();
    }
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
                   fmt::format("{} parts need a ball each; raise `total` from {}", parts, group.balls)};
    }
    const std::string link = medial_vk::quoted(parts_[group.parts.front()].link);
    return Error{ErrorCode::kUsage,
                 fmt::format("link {} has {} parts, which need a ball each; raise `count_per_link` from {}", link,
                             parts, group.balls)};
  }

  Status fit(const Group& group) {
    if (!shares() || group.parts.size() == 1) {
      for (const std::size_t part : group.parts) {
        if (Status status = fit_part(part, group.balls); !status) return status;
      }
      return {};
    }
    Result<std::vector<std::size_t>> counts = counts_by_need(group);
    if (!counts) return counts.error();
    for (std::size_t i = 0; i < group.parts.size(); ++i) {
      if (Status status = fit_part(group.parts[i], counts.value()[i]); !status) return status;
    }
    return {};
  }

  /// Curves are computed for an equal share first, and longer ones for parts that get more: in the end every curve has
  /// the required length, and the shares are those of complete curves.
  Result<std::vector<std::size_t>> counts_by_need(const Group& group) {
    const std::size_t balls = static_cast<std::size_t>(
        std::ranges::count_if(group.parts, [&](std::size_t part) { return parts_[part].ball.has_value(); }));
    const std::size_t others = group.parts.size() - balls;
    const std::size_t equal = others == 0 ? 1 : std::max<std::size_t>(1, (group.balls - balls) / others);
    std::vector<NeedCurve> curves(group.parts.size());
    std::vector<std::size_t> lengths(group.parts.size(), curve_length(equal));
    std::vector<std::size_t> counts(group.parts.size(), 0);
    for (bool is_known = false; !is_known;) {
      is_known = true;
      for (std::size_t i = 0; i < curves.size(); ++i) {
        if (counts[i] > 0 && is_long_enough(curves[i], counts[i])) continue;
        if (counts[i] > 0) ++steps_;
        lengths[i] = std::max(lengths[i], curve_length(counts[i]));
        Result<NeedCurve> curve = curve_of(group.parts[i], lengths[i]);
        if (!curve) return curve.error();
        curves[i] = std::move(curve).value();
      }
      counts = distribute_balls(curves, group.balls);
      for (std::size_t i = 0; i < curves.size(); ++i) is_known = is_known && is_long_enough(curves[i], counts[i]);
    }
    return counts;
  }

  /// The sets of the source's method are not prefixes of each other: its curves are continued instead.
  bool is_long_enough(const NeedCurve& curve, std::size_t count) const {
    return curve.is_ball || curve.ends || options_.spheres.method == SphereMethod::kSource ||
           curve.uncovered.size() >= curve_length(count);
  }

  Result<NeedCurve> curve_of(std::size_t number, std::size_t count) {
    const Part& part = parts_[number];
    NeedCurve curve;
    curve.is_ball = part.ball.has_value();
    if (curve.is_ball) return curve;
    SphereFitOptions options = options_.spheres;
    options.count = count;
    const Result<CoverageCurve> found =
        measure_coverage_curve(*part.mesh, options, extractor_of(number), reporter(), stop_);
    if (!found) return named(part, found.error());
    ++done_;
    const double whole =
        part.volume.value_or(found.value().solid_volume.value_or(enclosed_with_middle(part.mesh->prepared())));
    for (const double covered : found.value().covered) curve.uncovered.push_back(whole - covered);
    curve.ends = found.value().ends;
    return curve;
  }

  /// The curve of a part and its spheres share the extractor, and so its medial spheres.
  const Extractor& extractor_of(std::size_t number) {
    if (!extractors_[number]) extractors_[number] = kept_extractions(make_extractor_());
    return extractors_[number];
  }

  StageProgress reporter() const {
    return [this](const char* stage, double done) {
      const double share = (static_cast<double>(done_) + done) / static_cast<double>(steps_);
      if (progress_) progress_(stage, std::min(1.0, share));
    };
  }

  Status fit_part(std::size_t number, std::size_t count) {
    const Part& part = parts_[number];
    PartFit& fit = fits_[number];
    fit.count = count;
    if (part.ball) {
      fit.levels = {{placed(part, *part.ball)}};
      fit.reach = {{}};
      fit.solid_volume = fit.spheres_volume = volume_of(*part.ball);
      fit.of_shape = true;
      return {};
    }
    Stopwatch stopwatch;
    if (Status status = check_position(part); !status) return named(part, status.error());
    SphereFitOptions options = options_.spheres;
    options.count = count;
    Result<SphereFit> fitted = fit_spheres(*part.mesh, options, extractor_of(number), reporter(), stop_);
    if (!fitted) return named(part, fitted.error());
    extractors_[number] = {};
    ++done_;
    take(part, std::move(fitted).value(), fit);
    fit.measurements.seconds = stopwatch.lap();
    return {};
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
    fit.measures = std::move(fitted.measures);
    fit.solid_volume = fitted.solid_volume;
    // Balanced balls are measured by the facets, for which they were balanced.
    fit.of_shape = options_.spheres.contract != SphereContract::kBalanced && part.volume &&
                   measure_against(*part.volume, *fit.measures);
    if (fit.of_shape) fit.solid_volume = part.volume;
    fit.spheres_volume = fit.measures->volume.balls;
    fit.reach = std::move(fitted.reach);
    place_levels(part, fitted.levels, fit);
    fit.proved = std::move(fitted.levels.back());
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
        fmt::format("link {}, {}: {}", medial_vk::quoted(part.link), medial_vk::quoted(part.name), error.message);
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
  const StageProgress& progress_;
  const std::stop_token& stop_;
  std::vector<Extractor> extractors_;  // by part, while it is needed; else empty functions
  std::vector<PartFit> fits_;
  std::size_t steps_ = 0, done_ = 0;  // approximations
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
