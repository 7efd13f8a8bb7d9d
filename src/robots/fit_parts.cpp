#include "robots/fit_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <utility>

#include "base/point_ops.h"
#include "base/stopwatch.h"
#include "input/text_scanner.h"
#include "judge/check_balls.h"
#include "medial_vk/ball_union.h"
#include "robots/share_out.h"
#include "spheres/methods/approximate.h"
#include "spheres/methods/prefixes.h"

namespace medial_vk {
namespace {

double volume_of(const Ball& ball) { return 4.0 / 3 * std::numbers::pi * ball.radius * ball.radius * ball.radius; }

/// Parts that share a number of balls: those of a link, or all.
struct Group {
  std::vector<std::size_t> parts;
  std::size_t balls = 0;
};

/// An open mesh has no volume; what its surface encloses with the middle of its box, wherever that is, will do.
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
  Fitting(std::span<const Part> parts, const FitGoals& goals, Backend backend, Context* context,
          const FitProgress& progress)
      : parts_(parts), goals_(goals), backend_(backend), context_(context), progress_(progress), fits_(parts.size()) {}

  Result<std::vector<PartFit>> run() {
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
  bool shares() const { return goals_.total > 0 || goals_.count_per_link > 0; }

  /// In the order of their first parts.
  std::vector<Group> make_groups() const {
    std::vector<Group> groups;
    std::map<std::string, std::size_t> of_link;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const std::string key = goals_.total > 0 ? std::string() : shares() ? parts_[i].link : std::to_string(i);
      const auto [group, is_new] = of_link.emplace(key, groups.size());
      if (is_new) {
        groups.emplace_back();
        groups.back().balls = goals_.total > 0 ? goals_.total : shares() ? goals_.count_per_link : goals_.request.count;
      }
      groups[group->second].parts.push_back(i);
    }
    return groups;
  }

  Status check(const Group& group) const {
    if (!shares() || group.balls >= group.parts.size()) return {};
    const std::string who = goals_.total > 0 ? std::string("the robot")
                                             : fmt::format("the link {}", quoted(parts_[group.parts.front()].link));
    return Error{ErrorCode::kUsage,
                 fmt::format("{} has {} geometries, each of which needs a sphere; {} too few", who, group.parts.size(),
                             group.balls == 1 ? "1 is" : fmt::format("{} are", group.balls))};
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

  /// Curves for an equal share first, and longer ones for those who get more: in the end every curve says all that was
  /// asked, and the shares are those of whole curves.
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
      counts = share_out(curves, group.balls);
      for (std::size_t i = 0; i < curves.size(); ++i) is_known = is_known && is_long_enough(curves[i], counts[i]);
    }
    return counts;
  }

  /// The method of the source has no set that another begins with: its curves are continued instead.
  bool is_long_enough(const NeedCurve& curve, std::size_t count) const {
    return curve.is_ball || curve.ends || goals_.request.method == SphereMethod::kSource ||
           curve.uncovered.size() >= curve_length(count);
  }

  Result<NeedCurve> curve_of(std::size_t number, std::size_t count) {
    const Part& part = parts_[number];
    NeedCurve curve;
    curve.is_ball = part.ball.has_value();
    if (curve.is_ball) return curve;
    const Result<Solid> solid = Solid::build(part.mesh, goals_.request.threads);
    if (!solid) return named(part, solid.error());
    SphereRequest request = goals_.request;
    // The volume that is left inside is what is needed; other goals are for the sets that are kept.
    request.contract = SphereContract::kInside;
    request.error = request.max_gap = 0;
    // The method of the source may have no set of so few; one of a few more has the curve, too.
    Result<std::vector<SphereSet>> sets = approximate(part, solid.value(), request, count, false);
    for (int tries = 0; !sets && sets.error().code == ErrorCode::kUsage && tries < 6; ++tries) {
      sets = approximate(part, solid.value(), request, count <<= 1, false);
    }
    if (!sets) return named(part, sets.error());
    ++done_;
    const SphereSet& set = sets.value().back();
    const Result<std::vector<double>> volumes = volumes_of(set);
    if (!volumes) return named(part, volumes.error());
    const double whole =
        part.volume.value_or(solid.value().has_volume() ? solid.value().volume() : enclosed_with_middle(part.mesh));
    for (const double volume : volumes.value()) curve.uncovered.push_back(whole - volume);
    curve.ends = goals_.request.method == SphereMethod::kBest && set.balls.size() < count;
    return curve;
  }

  /// The method best says what they were; other sets are told by their beginnings.
  Result<std::vector<double>> volumes_of(const SphereSet& set) const {
    if (!set.volumes.empty()) return set.volumes;
    return prefix_volumes(set.balls, goals_.request.threads);
  }

  Result<std::vector<SphereSet>> approximate(const Part& part, const Solid& solid, SphereRequest request,
                                             std::size_t count, bool levels) {
    request.count = count;
    const SphereProgress on_progress = [&](const char*, double done) { return report(part, done); };
    if (levels) return approximate_in_levels(solid, request, backend_, context_, on_progress);
    Result<SphereSet> set = approximate_by_spheres(solid, request, backend_, context_, on_progress);
    if (!set) return set.error();
    return std::vector<SphereSet>{std::move(set).value()};
  }

  /// False: stop.
  bool report(const Part& part, double done) const {
    const double share = (static_cast<double>(done_) + done) / static_cast<double>(steps_);
    return !progress_ || progress_(FitStage::kSpheres, part, std::min(1.0, share));
  }

  Status fit_part(std::size_t number, std::size_t count) {
    const Part& part = parts_[number];
    PartFit& fit = fits_[number];
    fit.wanted = count;
    if (part.ball) {
      // Exact for every contract; its centre is the shift of its pose, which is not rounded.
      fit.levels = {{Ball{part.pose.shift, part.ball->radius}}};
      fit.reach = {{}};
      fit.solid_volume = fit.spheres_volume = volume_of(*part.ball);
      fit.of_shape = true;
      return {};
    }
    Stopwatch stopwatch;
    const Result<Solid> solid = Solid::build(part.mesh, goals_.request.threads);
    if (!solid) return named(part, solid.error());
    if (Status status = check_place(part, solid.value()); !status) return named(part, status.error());
    Result<std::vector<SphereSet>> sets = approximate(part, solid.value(), goals_.request, count, goals_.levels);
    if (!sets) return named(part, sets.error());
    ++done_;
    if (Status status = measure(part, solid.value(), sets.value(), fit); !status) return named(part, status.error());
    place_levels(part, sets.value(), fit);
    fit.seconds = stopwatch.lap();
    return {};
  }

  /// What radii may lose, or gain, where spheres are moved to the frame of the link. What was measured before is then
  /// still true to the digits that are shown.
  static Status check_place(const Part& part, const Solid& solid) {
    constexpr double kMost = 1e-6;  // of the diagonal
    const MeshReport& report = part.mesh.report;
    double reach = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      reach = std::max({reach, std::fabs(report.lower[k]), std::fabs(report.upper[k])});
    }
    if (placement_rounding(part.pose, 2 * reach) <= kMost * solid.diagonal()) return {};
    return Error{ErrorCode::kInvalidMesh,
                 "it lies so far from the origin of its link that its spheres can hardly be placed there (double "
                 "precision); move it closer"};
  }

  /// In the frame of the part, where what the contract says is proved.
  Status measure(const Part& part, const Solid& solid, const std::vector<SphereSet>& sets, PartFit& fit) const {
    const std::vector<Ball>& balls = sets.back().balls;
    std::mutex mutex;
    const auto goes_on = [&] {
      const std::lock_guard lock(mutex);
      return report(part, 1);
    };
    Result<SphereMeasures> measured = measure_spheres(solid, balls, {.threads = {goals_.request.threads, goes_on}});
    if (!measured) return measured.error();
    fit.measures = std::move(measured).value();
    if (Status status = check_promise(*fit.measures); !status) return status;
    if (solid.has_volume()) fit.solid_volume = solid.volume();
    // Balanced balls are measured by the facets, which are what they were balanced for.
    fit.of_shape = goals_.request.contract != SphereContract::kBalanced && part.volume &&
                   measure_against(*part.volume, *fit.measures);
    if (fit.of_shape) fit.solid_volume = part.volume;
    fit.spheres_volume = fit.measures->volume.balls;
    if (goals_.check) {
      if (progress_ && !progress_(FitStage::kCheck, part, 1)) return Error{ErrorCode::kInterrupted, "interrupted"};
      fit.check = goals_.request.contract == SphereContract::kCover ? check_balls_cover(solid.mesh(), balls)
                                                                    : check_balls_inside(solid.mesh(), balls);
    }
    for (const SphereSet& set : sets) fit.reach.push_back(reach_of(solid, set));
    return {};
  }

  /// Better no spheres than some that do not keep what they promise.
  Status check_promise(const SphereMeasures& measures) const {
    const InsideProof& inside = measures.inside;
    if (goals_.request.contract == SphereContract::kInside && !inside.proved()) {
      return Error{ErrorCode::kInternal,
                   fmt::format("{} of {} spheres reach out of the solid, the worst by {:.3g}; nothing was written",
                               inside.failed, inside.tested, inside.worst)};
    }
    if (goals_.request.contract == SphereContract::kCover && !measures.cover.surface_proved()) {
      return Error{ErrorCode::kInternal, "the spheres are not proved to cover the solid; nothing was written"};
    }
    return {};
  }

  /// No point of a ball is farther out than radius and distance to the boundary say: less than their difference if the
  /// centre is inside, their sum if it is not. Nothing is outside where the contract says so.
  ReachOut reach_of(const Solid& solid, const SphereSet& set) const {
    ReachOut reach;
    if (goals_.request.contract == SphereContract::kInside || set.balls.empty()) return reach;
    reach.best = HUGE_VAL;
    CompensatedSum sum;
    for (const Ball& ball : set.balls) {
      const double distance = solid.distance(ball.centre) * (solid.contains(ball.centre) ? -1 : 1);
      const double out = std::max(0.0, ball.radius + distance + solid.rounding());
      sum.add(out);
      reach.best = std::min(reach.best, out);
      reach.worst = std::max(reach.worst, out);
    }
    reach.mean = sum.value() / static_cast<double>(set.balls.size());
    return reach;
  }

  void place_levels(const Part& part, const std::vector<SphereSet>& sets, PartFit& fit) const {
    const SphereContract contract = goals_.request.contract;
    const int grow = contract == SphereContract::kInside ? -1 : contract == SphereContract::kCover ? 1 : 0;
    for (const SphereSet& set : sets) {
      std::vector<Ball> placed;
      for (const Ball& ball : set.balls) placed.push_back(place(part, ball, grow));
      fit.levels.push_back(std::move(placed));
    }
  }

  Error named(const Part& part, Error error) const {
    if (parts_.size() == 1 && part.link == part.name) return error;
    if (error.code == ErrorCode::kInterrupted) return error;
    error.message = fmt::format("link {}, {}: {}", quoted(part.link), quoted(part.name), error.message);
    return error;
  }

  /// The coarsest of a part with few levels stands for the levels below it, too.
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
  const FitGoals& goals_;
  Backend backend_;
  Context* context_;
  const FitProgress& progress_;
  std::vector<PartFit> fits_;
  std::size_t steps_ = 0, done_ = 0;  // approximations
};

}  // namespace

Result<std::vector<PartFit>> fit_parts(std::span<const Part> parts, const FitGoals& goals, Backend backend,
                                       Context* context, const FitProgress& progress) {
  return Fitting(parts, goals, backend, context, progress).run();
}

}  // namespace medial_vk
