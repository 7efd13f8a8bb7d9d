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
    if (options_.balls > 0 && options_.backend != Backend::kCpu) {
      opening_.start(options_.device, options_.threads, progress_);  // while the robot is read
    }
    if (Status status = load(); !status) return status;
    if (Status status = build(); !status) return status;
    if (!options_.quiet) print_message(clearance_opening(options_, all_, kinematics_->joints().size()));
    if (Status status = fit_balls(); !status) return status;
    if (Status status = compute(); !status) return status;
    if (Status status = check(); !status) return status;
    if (Status status = draw(); !status) return status;
    files_.push_back({options_.output, encode_clearances_csv(clearances_)});
    if (!options_.write_srdf.empty()) files_.push_back({options_.write_srdf, encode_left_out(all_)});
    if (interrupted()) return stopped();
    if (Status status = write_files(files_); !status) return status;
    if (!options_.quiet) print_message(clearance_summary(options_, clearances_, beyond_, times_, files_));
    return report_check();
  }

 private:
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
    beyond_ = static_cast<std::size_t>(std::ranges::count_if(values_, [this](const auto& of_joints) {
      for (std::size_t i = 0; i < of_joints.size(); ++i) {
        const FreeJoint& joint = kinematics_->joints()[i];
        if (of_joints[i] < joint.lower || of_joints[i] > joint.upper) return true;
      }
      return false;
    }));
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
    // With --balls, triangles only find the pairs that always touch.
    const bool has_bodies = options_.balls == 0 || options_.srdf.empty();
    const std::span<const LinkSolid> solids = has_bodies ? all_.solids.around : std::span<const LinkSolid>();
    const Result<std::vector<GroupPart>> around =
        bodies_of(solids, options_.threads, {}, seen("bodies"), stop.get_token());
    if (!around) return error(around.error());
    times_.push_back({"bodies", stopwatch.lap()});
    Status status = find_pairs(options_, *kinematics_, around.value(), all_, seen("pairs"), stop.get_token());
    if (!status) return error(status.error());
    times_.push_back({"pairs", stopwatch.lap()});
    if (options_.balls > 0) {
      progress_.clear();
      return {};  // their group follows
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

  /// With --balls, balls in the place of all solids.
  Status fit_balls() {
    if (options_.balls == 0) return {};
    std::optional<Context> context;
    std::optional<DeviceDescription> device;
    if (Status status = opening_.take(context, device, times_); !status) return status;
    Stopwatch stopwatch;
    const std::stop_source stop;
    Result<FittedLinks> fitted = fit_links(all_, options_, context, progress_, stop);
    if (!fitted && fitted.error().code == ErrorCode::kInterrupted) return stopped();
    if (!fitted) return with_hint(fitted.error(), options_.device);
    Result<BodyGroup> group = group_of(fitted.value().parts);
    if (!group) return group.error();
    around_ = std::move(group).value();
    times_.push_back({"balls", stopwatch.lap()});
    if (options_.quiet) return {};
    print_message(labelled("balls", fmt::format("{} inside and {} that cover, proved", grouped(fitted.value().inside),
                                                grouped(fitted.value().cover))));
    return {};
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

  /// Block by block, so that progress is shown and a signal is seen.
  Status compute() {
    constexpr std::size_t kBlock = 1024;
    Stopwatch stopwatch;
    clearances_.resize(values_.size());
    std::vector<Pose> poses;
    std::vector<LeastDistance> lower, upper;
    for (std::size_t begin = 0; begin < values_.size(); begin += kBlock) {
      if (interrupted()) return stopped();
      progress_.update("distances", static_cast<double>(begin) / static_cast<double>(values_.size()));
      const std::size_t count = std::min(kBlock, values_.size() - begin);
      poses.resize(count * all_.links());
      if (Status status = place(begin, poses); !status) return status;
      lower.assign(count, {});
      upper.assign(count, {});
      Status status = least_distances(*around_, poses, lower, group_options(options_), {options_.threads});
      if (!status) return status;
      if (inside_) status = least_distances(*inside_, poses, upper, group_options(options_), {options_.threads});
      if (!status) return status;
      for (std::size_t i = 0; i < count; ++i) {
        clearances_[begin + i] = clearance_of(lower[i], inside_ ? upper[i] : lower[i]);
      }
    }
    progress_.clear();
    times_.push_back({"distances", stopwatch.lap()});
    return {};
  }

  /// The shapes are between both sets of solids, and so is their distance.
  Clearance clearance_of(const LeastDistance& around, const LeastDistance& inside) const {
    Clearance clearance = {std::min(around.lower, inside.upper), inside.upper, {}, {}};
    const PartPair& pair = inside.upper_pair.a != PartPair::kNone ? inside.upper_pair : around.lower_pair;
    if (pair.a == PartPair::kNone) return clearance;
    std::uint32_t first = around_->parts()[pair.a].link, second = around_->parts()[pair.b].link;
    if (first > second) std::swap(first, second);
    clearance.first = all_.names[first];
    clearance.second = all_.names[second];
    return clearance;
  }

  /// The reference cannot be stopped half-way, but nothing is lost if the process ends.
  Status check() {
    if (!options_.check) return {};
    const EndAtOnce while_checked;
    if (interrupted()) return stopped();
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
    if (interrupted()) return stopped();
    Stopwatch stopwatch;
    const ClearanceView view = {all_, inside_ ? *inside_ : *around_, clearances_,
                                [this](std::size_t i, std::span<Pose> poses) { return place(i, poses); }};
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
  std::size_t beyond_ = 0;                   // configurations beyond limits
  std::optional<BodyGroup> around_;
  std::optional<BodyGroup> inside_;  // none: the same
  std::vector<Clearance> clearances_;
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
