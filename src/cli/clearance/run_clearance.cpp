#include "cli/clearance/run_clearance.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stop_token>
#include <utility>

#include "base/stopwatch.h"
#include "cli/clearance/clearance_summary.h"
#include "cli/clearance/clearance_views.h"
#include "cli/clearance/fitted_links.h"
#include "cli/clearance/kept_bodies.h"
#include "cli/clearance/robot_and_scene.h"
#include "cli/help/help_texts.h"
#include "cli/options/clearance_options.h"
#include "cli/shared/device_opening.h"
#include "cli/shared/pair_views.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/messages.h"
#include "cli/terminal/numbers.h"
#include "cli/terminal/progress.h"
#include "cli/terminal/tables.h"
#include "input/text_scanner.h"
#include "joint_files/read_joint_values.h"
#include "output/atomic_files/atomic_file.h"
#include "reference_bridge/check_clearances.h"

namespace medial_vk::cli {
namespace {

/// The sequence of steps from a robot to its clearances, and their shared data.
class ClearanceRun {
 public:
  explicit ClearanceRun(const ClearanceOptions& options) : options_(options), progress_(!options.quiet) {}

  Status run() {
    for (const NamedOutput& output : outputs_of(options_)) {
      if (output.file->empty()) continue;
      if (Status status = check_writable(*output.file); !status) return status;
    }
    if (!options_.bodies.empty()) {
      if (Status status = check_folder(options_.bodies); !status) return status;
    }
    if (options_.balls > 0 && options_.bodies.empty()) start_device();  // while the robot is read
    if (Status status = load(); !status) return status;
    if (Status status = build(); !status) return status;
    if (!options_.quiet) print_message(clearance_opening(options_, all_, kinematics_->joints().size()));
    if (Status status = fit_balls(); !status) return status;
    if (Status status = compute(); !status) return status;
    if (Status status = check(); !status) return status;
    if (Status status = draw(); !status) return status;
    files_.push_back({options_.output, encode_clearances_csv(clearances_)});
    if (!options_.write_srdf.empty()) files_.push_back({options_.write_srdf, encode_left_out(all_)});
    if (interrupted()) return ended();
    if (Status status = write_files(files_); !status) return status;
    if (!options_.quiet) print_message(summary());
    return report_check();
  }

 private:
  void start_device() {
    if (options_.backend != Backend::kCpu) opening_.start(options_.device, options_.threads, progress_);
  }

  Status load() {
    progress_.update("read", 0);
    Result<RobotAndScene> all = load_robot_and_scene(options_, times_);
    progress_.clear();
    if (!all) return all.error();
    all_ = std::move(all).value();
    kinematics_.emplace(all_.robot);
    return load_joints();
  }

  Status load_joints() {
    const EndAtOnce guard;
    if (interrupted()) return stopped();
    std::vector<std::string> names;
    for (const FreeJoint& joint : kinematics_->joints()) names.push_back(joint.name);
    Result<std::vector<std::vector<double>>> values = read_joint_values(options_.joints, names);
    if (!values) return values.error();
    values_ = std::move(values).value();
    if (Status status = check_row_exists(options_.row, values_.size(), "configuration"); !status) return status;
    beyond_ = find_beyond_limits(kinematics_->joints(), values_);
    return {};
  }

  Result<BodyGroup> group_of(std::span<const GroupPart> parts) const {
    return BodyGroup::create(parts, all_.links(), all_.pairs);
  }

  /// Bodies, pairs and groups.
  Status build() {
    Stopwatch stopwatch;
    std::stop_source stop;
    const auto seen = [&](const char* stage) {
      return [this, stage, &stop](double done) {
        progress_.update(stage, done);
        if (interrupted()) stop.request_stop();
      };
    };
    const auto error = [](const Error& e) { return e.code == ErrorCode::kInterrupted ? stopped() : e; };
    // With --balls, triangles only find the pairs that always touch, and what balls leave undecided.
    const bool has_bodies = answers_by_triangles() || options_.srdf.empty();
    const std::span<const LinkSolid> solids = has_bodies ? all_.solids.around : std::span<const LinkSolid>();
    const Result<std::vector<GroupPart>> around =
        bodies_of(solids, options_.threads, {}, seen("bodies"), stop.get_token());
    if (!around) return error(around.error());
    times_.push_back({"bodies", stopwatch.lap()});
    Status status = find_pairs(options_, *kinematics_, around.value(), all_, seen("pairs"), stop.get_token());
    if (!status) return error(status.error());
    times_.push_back({"pairs", stopwatch.lap()});
    if (!answers_by_triangles()) {
      progress_.clear();
      return {};
    }
    Result<BodyGroup> group = group_of(around.value());
    if (!group) return group.error();
    around_ = std::move(group).value();
    if (all_.solids.facet_share > 0) {
      const Result<std::vector<GroupPart>> inside = bodies_of(
          all_.solids.inside, options_.threads, {all_.solids.around, around.value()}, seen("bodies"), stop.get_token());
      if (!inside) return error(inside.error());
      Result<BodyGroup> second = group_of(inside.value());
      if (!second) return second.error();
      inside_ = std::move(second).value();
    }
    times_.push_back({"bodies", stopwatch.lap()});
    progress_.clear();
    return {};
  }

  bool answers_by_triangles() const { return options_.balls == 0 || options_.decide; }

  /// With --balls, balls in the place of all solids. What was fitted is kept at once, since it took the most time.
  Status fit_balls() {
    if (options_.balls == 0) return {};
    Stopwatch stopwatch;
    Result<BallsOfSolids> known = known_balls(all_, options_, progress_);
    if (!known) return known.error();
    BallsOfSolids balls = known.value();
    times_.push_back({"balls", stopwatch.lap()});
    if (!balls.has_all()) {
      if (Status status = fit_missing(balls); !status) return status;
      stopwatch.lap();  // which fit_missing() has told
    }
    if (!options_.bodies.empty()) {
      if (Status status = keep_fitted_balls(all_, options_, known.value(), balls); !status) return status;
      has_kept_ = balls.fitted > 0;
      if (has_kept_) tell_of_kept_bodies();
    }
    const Result<std::vector<GroupPart>> parts = bodies_of_balls(all_, balls);
    if (!parts) return parts.error();
    Result<BodyGroup> group = group_of(parts.value());
    if (!group) return group.error();
    balls_ = std::move(group).value();
    times_.push_back({"balls", stopwatch.lap()});
    if (!options_.quiet) print_message(balls_opening(options_, balls));
    return {};
  }

  Status fit_missing(BallsOfSolids& balls) {
    if (!options_.bodies.empty()) {
      if (Status status = check_writable_folder(options_.bodies); !status) return status;
      start_device();
    }
    std::optional<Context> context;
    std::optional<DeviceDescription> device;
    if (Status status = opening_.take(context, device, times_); !status) return status;
    Stopwatch stopwatch;
    const std::stop_source stop;
    Status status = fit_missing_balls(all_, options_, context, progress_, stop, balls);
    if (!status && status.error().code == ErrorCode::kInterrupted) return stopped();
    if (!status) return with_hint(status.error(), options_.device);
    times_.push_back({"balls", stopwatch.lap()});
    return {};
  }

  /// The end by a signal, which may come after bodies were kept.
  Error ended() const {
    if (!has_kept_) return stopped();
    return {ErrorCode::kInterrupted,
            fmt::format("interrupted; the bodies in {} are kept, and nothing else was written", options_.bodies)};
  }

  /// The poses of all links, and of the scene, in some configurations.
  Status place(std::size_t begin, std::span<Pose> poses) const {
    const std::size_t links = all_.links();
    for (std::size_t i = 0; i * links < poses.size(); ++i) {
      const std::span<Pose> of_links = poses.subspan(i * links, links);
      std::ranges::fill(of_links, Pose());
      const Status status = kinematics_->place(values_[begin + i], of_links.first(kinematics_->links()));
      if (status) continue;
      const std::string name = options_.joints == "-" ? "stdin" : options_.joints;
      return file_error(name, fmt::format("configuration {}: {}", begin + i + 1, status.error().message));
    }
    return {};
  }

  /// Block by block, so that progress is shown. A signal may end the process within a configuration, as there is
  /// nothing to undo: bodies were kept before.
  Status compute() {
    constexpr std::size_t kBlock = 1024;
    const EndAtOnce guard;
    if (interrupted()) return ended();
    Stopwatch stopwatch;
    clearances_.resize(values_.size());
    by_triangles_.assign(values_.size(), options_.balls == 0);
    std::vector<Pose> poses;
    for (std::size_t begin = 0; begin < values_.size(); begin += kBlock) {
      progress_.update("distances", static_cast<double>(begin) / static_cast<double>(values_.size()));
      const std::size_t count = std::min(kBlock, values_.size() - begin);
      poses.resize(count * all_.links());
      if (Status status = place(begin, poses); !status) return status;
      const std::span<Clearance> clearances = std::span(clearances_).subspan(begin, count);
      Status status = options_.balls > 0 ? answer_by_balls(poses, clearances) : answer_by_triangles(poses, clearances);
      if (!status) return status;
      if (!options_.decide) continue;
      if (status = decide(begin, poses, clearances); !status) return status;
    }
    progress_.clear();
    times_.push_back({"distances", stopwatch.lap()});
    return {};
  }

  Status answer_by_balls(std::span<const Pose> poses, std::span<Clearance> clearances) const {
    std::vector<LeastDistance> least(clearances.size());
    Status status = least_distances(*balls_, poses, least, group_options(options_), {options_.threads});
    if (!status) return status;
    for (std::size_t i = 0; i < clearances.size(); ++i) clearances[i] = clearance_of(least[i], least[i]);
    return {};
  }

  Status answer_by_triangles(std::span<const Pose> poses, std::span<Clearance> clearances) const {
    std::vector<LeastDistance> lower(clearances.size()), upper;
    const GroupOptions of_triangles = triangle_options(options_);
    Status status = least_distances(*around_, poses, lower, of_triangles, {options_.threads});
    if (!status) return status;
    if (inside_) {
      if (status = answer_inside(poses, lower, upper); !status) return status;
    }
    for (std::size_t i = 0; i < clearances.size(); ++i) {
      clearances[i] = clearance_of(lower[i], inside_ ? upper[i] : lower[i]);
    }
    return {};
  }

  /// Upper ends by the facets inside of shapes. Where those around are beyond the limit, so are these, and nothing is
  /// left to prove.
  Status answer_inside(std::span<const Pose> poses, std::span<const LeastDistance> around,
                       std::vector<LeastDistance>& inside) const {
    std::vector<std::size_t> near;
    for (std::size_t i = 0; i < around.size(); ++i) {
      if (!(around[i].lower > 0 && around[i].lower >= options_.limit)) near.push_back(i);
    }
    std::vector<LeastDistance> found(near.size());
    Status status =
        least_distances(*inside_, poses_of(near, poses), found, triangle_options(options_), {options_.threads});
    if (!status) return status;
    inside.assign(around.size(), {});
    for (std::size_t k = 0; k < near.size(); ++k) inside[near[k]] = found[k];
    return {};
  }

  /// Those of some configurations of a block.
  std::vector<Pose> poses_of(std::span<const std::size_t> configurations, std::span<const Pose> poses) const {
    std::vector<Pose> some;
    some.reserve(configurations.size() * all_.links());
    for (const std::size_t i : configurations) {
      const auto first = poses.begin() + static_cast<std::ptrdiff_t>(i * all_.links());
      some.insert(some.end(), first, first + static_cast<std::ptrdiff_t>(all_.links()));
    }
    return some;
  }

  /// With --decide: triangles answer where balls have left a configuration of a block undecided.
  Status decide(std::size_t begin, std::span<const Pose> poses, std::span<Clearance> clearances) {
    std::vector<std::size_t> undecided;
    for (std::size_t i = 0; i < clearances.size(); ++i) {
      if (clearances[i].collision() == Collision::kUndecided) undecided.push_back(i);
    }
    std::vector<Clearance> decided(undecided.size());
    if (Status status = answer_by_triangles(poses_of(undecided, poses), decided); !status) return status;
    for (std::size_t k = 0; k < undecided.size(); ++k) {
      clearances[undecided[k]] = std::move(decided[k]);
      by_triangles_[begin + undecided[k]] = true;
    }
    return {};
  }

  /// The shapes are between both sets of solids, and so is their distance.
  Clearance clearance_of(const LeastDistance& around, const LeastDistance& inside) const {
    Clearance clearance = {std::min(around.lower, inside.upper), inside.upper, {}, {}};
    const PartPair& pair = inside.upper_pair.a != PartPair::kNone ? inside.upper_pair : around.lower_pair;
    if (pair.a == PartPair::kNone) return clearance;
    std::uint32_t first = all_.owner_of(pair.a), second = all_.owner_of(pair.b);
    if (first > second) std::swap(first, second);
    clearance.first = all_.names[first];
    clearance.second = all_.names[second];
    return clearance;
  }

  /// The reference cannot be stopped half-way, but nothing is lost if the process ends.
  Status check() {
    if (!options_.check) return {};
    const EndAtOnce while_checked;
    if (interrupted()) return ended();
    std::vector<Pose> poses(values_.size() * all_.links());
    if (Status status = place(0, poses); !status) return status;
    std::vector<CheckedInterval> intervals;
    for (const Clearance& clearance : clearances_) intervals.push_back({clearance.lower, clearance.upper});
    check_ = check_clearances(checked_solids(), poses, all_.links(), intervals, [&](std::size_t i) {
      progress_.update("check", static_cast<double>(i) / static_cast<double>(values_.size()));
    });
    progress_.clear();
    return {};
  }

  /// Files are made in memory: until they are written a signal may end the program.
  Status draw() {
    const EndAtOnce guard;
    if (interrupted()) return ended();
    Stopwatch stopwatch;
    const ClearanceView view = {
        all_,        balls_,        inside_ ? inside_ : around_,
        clearances_, by_triangles_, [this](std::size_t i, std::span<Pose> poses) { return place(i, poses); }};
    progress_.update("picture", 0);
    Status status = append_clearance_views(options_, view, files_);
    progress_.clear();
    if (!files_.empty()) times_.push_back({"picture", stopwatch.lap()});
    return status;
  }

  CheckedSolids checked_solids() const {
    CheckedSolids checked;
    const auto append = [](const std::vector<LinkSolid>& from, std::vector<CheckedSolid>& to) {
      for (const LinkSolid& solid : from) to.push_back({&solid.mesh.prepared(), solid.link, solid.pose});
    };
    append(all_.solids.around, checked.around);
    append(all_.solids.inside, checked.inside);
    checked.are_same = all_.solids.facet_share == 0;
    for (const LinkPair& pair : all_.pairs) {
      for (std::size_t a = 0; a < checked.around.size(); ++a) {
        if (checked.around[a].link != pair.a) continue;
        for (std::size_t b = 0; b < checked.around.size(); ++b) {
          if (checked.around[b].link == pair.b) checked.pairs.push_back({a, b});
        }
      }
    }
    return checked;
  }

  std::string summary() const {
    const auto by_triangles = static_cast<std::size_t>(std::ranges::count(by_triangles_, true));
    return clearance_summary(options_, clearances_, by_triangles, beyond_, times_, files_);
  }

  Status report_check() const {
    if (!options_.check) return {};
    return print_check(check_, std::ranges::any_of(files_, [](const OutputFile& file) { return file.path == "-"; }));
  }

  const ClearanceOptions& options_;
  Progress progress_;
  DeviceOpening opening_;  // with --balls
  RobotAndScene all_;
  std::optional<Kinematics> kinematics_;
  std::vector<std::vector<double>> values_;  // of each configuration
  BeyondLimits beyond_;
  std::optional<BodyGroup> balls_;   // with --balls
  std::optional<BodyGroup> around_;  // of triangles, where they answer
  std::optional<BodyGroup> inside_;  // none: the same
  bool has_kept_ = false;            // bodies were written to the folder of --bodies
  std::vector<Clearance> clearances_;
  std::vector<bool> by_triangles_;  // the origin of each clearance
  std::vector<StageTime> times_;
  CheckReport check_;
  std::vector<OutputFile> files_;
};

}  // namespace

Status run_clearance(const std::vector<std::string>& arguments) {
  const Result<ClearanceOptions> options = parse_clearance_options(arguments);
  if (!options) return options.error();
  if (options.value().help) return print_result(clearance_help_text());
  return ClearanceRun(options.value()).run();
}

}  // namespace medial_vk::cli
