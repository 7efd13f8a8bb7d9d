#include "cli/distance/run_distance.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stop_token>
#include <utility>

#include "base/stopwatch.h"
#include "body_files/body_file.h"
#include "cli/distance/distance_summary.h"
#include "cli/distance/distance_views.h"
#include "cli/help/help_texts.h"
#include "cli/options/distance_options.h"
#include "cli/shared/ball_points.h"
#include "cli/shared/load.h"
#include "cli/shared/load_body.h"
#include "cli/shared/pair_views.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/messages.h"
#include "cli/terminal/progress.h"
#include "cli/terminal/tables.h"
#include "output/atomic_files/atomic_file.h"
#include "output/distance_files/distances_csv.h"
#include "pose_files/read_poses.h"
#include "reference_bridge/check_balls.h"
#include "reference_bridge/check_distances.h"

namespace medial_vk::cli {
namespace {

/// The sequence of steps from two solids to their distances, and their shared data.
class DistanceRun {
 public:
  explicit DistanceRun(const DistanceCommandOptions& options) : options_(options), progress_(!options.quiet) {}

  Status run() {
    for (const NamedOutput& output : outputs_of(options_)) {
      if (output.file->empty()) continue;
      if (Status status = check_writable(*output.file); !status) return status;
    }
    if (Status status = load_poses(); !status) return status;
    if (Status status = check_row_exists(options_.row, poses_.size(), "pose"); !status) return status;
    if (Status status = load(options_.a, side_a_); !status) return status;
    if (options_.b == options_.a) {
      side_b_ = side_a_;
    } else if (Status status = load(options_.b, side_b_); !status) {
      return status;
    }
    if (Status status = build_bodies(); !status) return status;
    if (Status status = compute(); !status) return status;
    if (Status status = check(); !status) return status;
    if (Status status = make_files(); !status) return status;
    if (interrupted()) return stopped();
    if (Status status = write_files(files_); !status) return status;
    if (!options_.quiet) print_message(summary());
    return report_check();
  }

 private:
  Status load_poses() {
    if (options_.poses.empty()) return {};
    const EndAtOnce guard;
    if (interrupted()) return stopped();
    Result<std::vector<Pose>> poses = read_poses(options_.poses);
    if (!poses) return poses.error();
    poses_ = std::move(poses).value();
    return {};
  }

  Status load(const std::string& path, std::optional<LoadedBody>& side) {
    if (is_body_file(path)) return load_file(path, side);
    progress_.update("read", 0);
    Result<std::vector<ScenePart>> read = read_meshes(path, false, times_);
    progress_.clear();
    if (!read) return read.error();
    const PrepareOptions prepare = {
        .keep_inner_faces = options_.keep_inner_faces, .threads = options_.threads, .keep_outer_faces = true};
    const DeviceOpening no_device;
    Result<PreparedMesh> prepared =
        prepare_loaded(std::move(read.value().front().mesh), path, no_device, prepare, times_);
    if (!prepared) return prepared.error();
    if (!options_.quiet) print_message(distance_opening(path, prepared.value().report, options_.verbose));
    Result<IndexedMesh> indexed = IndexedMesh::build(std::move(prepared).value(), {.threads = options_.threads});
    if (!indexed) return indexed.error();
    side = LoadedBody{std::move(indexed).value(), {}, {}};
    return {};
  }

  Status load_file(const std::string& path, std::optional<LoadedBody>& side) {
    progress_.update("read", 0);
    Stopwatch stopwatch;
    const Result<BodyFile> file = [&]() -> Result<BodyFile> {
      const EndAtOnce guard;  // a pipe may wait
      if (interrupted()) return stopped();
      return read_body_file(path);
    }();
    if (!file) return file.error();
    times_.push_back({"read", stopwatch.lap()});
    progress_.update("prove", 0);
    Result<LoadedBody> body = load_body(file.value(), path, options_.threads, times_);
    progress_.clear();
    if (!body) return body.error();
    side = std::move(body).value();
    if (!options_.quiet) print_message(body_file_opening(path, *side, options_.verbose));
    return {};
  }

  /// With --balls, trees of triangles are not needed.
  Result<Body> body_of(const LoadedBody& side) {
    if (options_.balls) {
      const EndAtOnce guard;  // trees over balls are not stopped half-way
      if (interrupted()) return stopped();
      return Body::create(side.inside, side.cover);
    }
    std::stop_source stop;
    const auto on_progress = [&](double done) {
      progress_.update("bodies", done);
      if (interrupted()) stop.request_stop();
    };
    Result<Body> body =
        Body::create(side.mesh, side.inside, side.cover, {options_.threads}, on_progress, stop.get_token());
    if (!body && body.error().code == ErrorCode::kInterrupted) return stopped();
    return body;
  }

  Status build_bodies() {
    Stopwatch stopwatch;
    Result<Body> a = body_of(*side_a_);
    if (!a) return a.error();
    body_a_ = body_b_ = std::move(a).value();
    if (!side_b_->mesh.is_same(side_a_->mesh)) {
      Result<Body> b = body_of(*side_b_);
      if (!b) return b.error();
      body_b_ = std::move(b).value();
    }
    progress_.clear();
    times_.push_back({"bodies", stopwatch.lap()});
    return {};
  }

  /// Block by block, so that progress is shown. One pose of large meshes may take long, and nothing is lost if a signal
  /// ends the process within it.
  Status compute() {
    constexpr std::size_t kBlock = 4096;
    const EndAtOnce guard;
    if (interrupted()) return stopped();
    Stopwatch stopwatch;
    (options_.balls ? bounds_.resize(poses_.size()) : distances_.resize(poses_.size()));
    for (std::size_t begin = 0; begin < poses_.size(); begin += kBlock) {
      progress_.update("distances", static_cast<double>(begin) / static_cast<double>(poses_.size()));
      const std::size_t count = std::min(kBlock, poses_.size() - begin);
      const std::span<const Pose> poses = std::span(poses_).subspan(begin, count);
      if (options_.balls) {
        distance_bounds(*body_a_, *body_b_, poses, std::span(bounds_).subspan(begin, count), {options_.threads});
        continue;
      }
      Status status = distances(*body_a_, *body_b_, poses, std::span(distances_).subspan(begin, count),
                                distance_options(options_), {options_.threads});
      if (!status) return status;
    }
    progress_.clear();
    times_.push_back({"distances", stopwatch.lap()});
    return {};
  }

  /// The reference cannot be stopped half-way, but nothing is lost if the process ends.
  Status check() {
    if (!options_.check) return {};
    const EndAtOnce while_checked;
    if (interrupted()) return stopped();
    const PreparedMesh &a = side_a_->mesh.prepared(), &b = side_b_->mesh.prepared();
    const auto seen = [&](std::size_t i) {
      progress_.update("check", static_cast<double>(i) / static_cast<double>(poses_.size()));
    };
    check_ = options_.balls ? check_distance_bounds(a, b, poses_, bounds_, seen)
                            : check_distances(a, b, poses_, distances_, distance_options(options_), seen);
    check_balls(*side_a_);
    if (!side_b_->mesh.is_same(side_a_->mesh)) check_balls(*side_b_);
    progress_.clear();
    return {};
  }

  void check_balls(const LoadedBody& side) {
    const auto append = [&](const CheckReport& report) {
      check_.lines.insert(check_.lines.end(), report.lines.begin(), report.lines.end());
    };
    if (!side.inside.empty()) append(check_balls_inside(side.mesh.prepared(), side.inside));
    if (!side.cover.empty()) append(check_balls_cover(side.mesh.prepared(), side.cover));
  }

  /// Files are made in memory: until they are written a signal may end the program.
  Status make_files() {
    const EndAtOnce guard;
    if (interrupted()) return stopped();
    progress_.update("picture", 0);
    Stopwatch stopwatch;
    const DistanceView view = {*side_a_, *side_b_, *body_a_, *body_b_, poses_, distances_, bounds_};
    Status status = append_distance_views(options_, view, files_);
    progress_.clear();
    if (!status) return status;
    if (!files_.empty()) times_.push_back({"picture", stopwatch.lap()});
    files_.push_back({options_.output, options_.balls ? encode_bounds() : encode_distances_csv(distances_)});
    return {};
  }

  std::string encode_bounds() const {
    std::vector<Distance> by_balls;
    by_balls.reserve(bounds_.size());
    for (std::size_t i = 0; i < bounds_.size(); ++i) {
      by_balls.push_back(distance_by_balls(*body_a_, *body_b_, poses_[i], bounds_[i]));
    }
    return encode_distances_csv(by_balls);
  }

  std::string summary() const {
    return options_.balls ? bounds_summary(options_, bounds_, times_, files_)
                          : distance_summary(options_, distances_, times_, files_);
  }

  Status report_check() const {
    if (!options_.check) return {};
    return print_check(check_, std::ranges::any_of(files_, [](const OutputFile& file) { return file.path == "-"; }));
  }

  const DistanceCommandOptions& options_;
  Progress progress_;
  std::vector<Pose> poses_ = {Pose()};
  std::optional<LoadedBody> side_a_, side_b_;
  std::optional<Body> body_a_, body_b_;
  std::vector<Distance> distances_;     // without --balls
  std::vector<DistanceBounds> bounds_;  // with it
  std::vector<StageTime> times_;
  CheckReport check_;
  std::vector<OutputFile> files_;
};

}  // namespace

Status run_distance(const std::vector<std::string>& arguments) {
  const Result<DistanceCommandOptions> options = parse_distance_options(arguments);
  if (!options) return options.error();
  if (options.value().help) return print_result(distance_help_text());
  return DistanceRun(options.value()).run();
}

}  // namespace medial_vk::cli
