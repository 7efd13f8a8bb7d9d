#include "cli/follow/run_follow.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

#include "base/quoted.h"
#include "base/stopwatch.h"
#include "cli/follow/follow_balls.h"
#include "cli/follow/follow_rig.h"
#include "cli/follow/follow_summary.h"
#include "cli/follow/moving_balls.h"
#include "cli/help/help_texts.h"
#include "cli/options/follow_options.h"
#include "cli/shared/load.h"
#include "cli/shared/rest_mesh.h"
#include "cli/shared/shared_of_run.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/messages.h"
#include "cli/terminal/tables.h"
#include "common/file_extension.h"
#include "medial_vk/version.h"
#include "motion_files/frame_patterns.h"
#include "motion_files/mesh_motion.h"
#include "output/atomic_files/atomic_file.h"
#include "output/motion_files/motion_files.h"
#include "output/motion_page/motion_page.h"
#include "output/page/page.h"
#include "output/picture/motion_picture.h"
#include "output/picture/panels/image.h"
#include "platform/paths.h"

namespace medial_vk::cli {
namespace {

/// Frames of which a page holds the vertices: some ten seconds of motion.
constexpr std::size_t kMostPageFrames = 300;

/// Whether `frame` is one of `most` evenly chosen frames of `count`, with the first and the last.
bool is_chosen(std::size_t frame, std::size_t count, std::size_t most) {
  if (count <= most) return true;
  const auto place = [&](std::size_t i) { return i * (most - 1) / (count - 1); };
  return frame == 0 || frame + 1 == count || place(frame) != place(frame - 1);
}

/// The sequence of steps from a mesh and its frames to files, and their shared data.
class FollowRun {
 public:
  explicit FollowRun(const FollowOptions& options) : options_(options), shared_(!options.quiet) {}

  Status run() {
    if (Status status = check_files(); !status) return status;
    if (finds_on_device(options_)) shared_.opening.start(options_.device, threads(), shared_.progress);
    if (Status status = open_motion(); !status) return status;
    if (Status status = prepare(); !status) return status;
    if (Status status = shared_.opening.take(shared_.context, shared_.device, shared_.times); !status) return status;
    if (!options_.quiet) {
      print_message(
          follow_opening(options_, mesh_->prepared().report, motion_->frame_count(), motion_->separable_vertices()));
    }
    if (Status status = take_balls(); !status) return status;
    if (Status status = follow(); !status) return status;
    if (Status status = rig(); !status) return status;
    if (Status status = make_files(); !status) return status;
    if (interrupted()) return stopped();
    if (Status status = write_files(files_); !status) return status;
    if (!options_.quiet) {
      print_message(follow_summary(options_, record_, mesh_->prepared().report.closed, rig_, map_->parted(),
                                   update_seconds_, shared_.times, files_));
    }
    return report_check();
  }

 private:
  unsigned threads() const { return options_.follower.threads; }

  Status check_files() const {
    for (const NamedOutput& output : outputs_of(options_)) {
      if (output.file->empty()) continue;
      if (Status status = check_writable(*output.file); !status) return status;
    }
    return options_.html.empty() ? Status() : check_page_available();
  }

  Status open_motion() {
    const EndAtOnce guard;
    if (interrupted()) return stopped();
    shared_.progress.update("read", 0);
    Stopwatch stopwatch;
    Result<std::unique_ptr<MeshMotion>> motion = open();
    shared_.progress.clear();
    if (!motion) return motion.error();
    motion_ = std::move(motion).value();
    if (Status status = check_rig_file(options_, *motion_); !status) return status;
    shared_.times.push_back({"read", stopwatch.lap()});
    return {};
  }

  Result<std::unique_ptr<MeshMotion>> open() const {
    if (options_.frames.empty()) {
      AnimationOptions animation;
      animation.animation = options_.animation;
      animation.frames_per_second = options_.frames_per_second;
      animation.keep_source = rig_has_nodes(options_);
      return open_animation(options_.rest, animation);
    }
    Result<std::vector<std::string>> files = files_of_frames(options_.frames);
    if (!files) return files.error();
    for (const std::string& frame : files.value()) {
      if (Status status = check_outputs_differ(outputs_of(options_), frame); !status) return status.error();
    }
    return open_mesh_files(options_.rest, std::move(files).value());
  }

  /// Faces inside the solid stay: cuts along crossings would make vertices that no frame has.
  Status prepare() {
    const PrepareOptions prepare = {.keep_inner_faces = true, .threads = threads(), .keep_outer_faces = true};
    Result<PreparedMesh> prepared =
        prepare_loaded(motion_->rest(), options_.rest, shared_.opening, prepare, shared_.times);
    if (!prepared) return prepared.error();
    if (Status status = check_size(prepared.value().mesh.vertices, options_.rest); !status) return status;
    const MeshReport& report = prepared.value().report;
    if (options_.has_usual_renewal && !(report.closed && encloses_volume(report))) options_.follower.renewed = 0;
    if (options_.follower.renewed > 0 && !report.closed) {
      return Error{ErrorCode::kUsage,
                   fmt::format("--renew: {} is not closed, so its uncovered volume is not known", options_.rest)};
    }
    map_.emplace(prepared.value());
    Result<IndexedMesh> indexed = IndexedMesh::build(std::move(prepared).value(), {.threads = threads()});
    if (!indexed) return with_hint(indexed.error());
    mesh_.emplace(std::move(indexed).value());
    return {};
  }

  Status take_balls() {
    const Result<std::vector<Ball>> balls = balls_at_rest(options_, *mesh_, shared_);
    if (!balls) return balls.error();
    const EndAtOnce guard;
    if (interrupted()) return stopped();
    shared_.progress.update("rest", 0);
    Stopwatch stopwatch;
    Result<std::unique_ptr<MovingBalls>> follower = options_.covers()
                                                        ? balls_that_stay_a_cover(options_, *mesh_, balls.value())
                                                        : balls_that_stay_inside(options_, *mesh_, balls.value());
    shared_.progress.clear();
    if (!follower) return follower.error();
    follower_ = std::move(follower).value();
    shared_.times.push_back({"rest", stopwatch.lap()});
    return {};
  }

  Status follow() {
    record_.version = version();
    record_.name = options_.rest == "-" ? "stdin" : platform::file_name_of(options_.rest);
    record_.covers = options_.covers();
    record_.rule = record_.covers                                     ? "cover"
                   : options_.follower.rule == FollowRule::kPublished ? "published"
                                                                      : "tangent";
    record_.frames_per_second = options_.frames_per_second;
    record_.has_volume = encloses_volume(mesh_->prepared().report);
    record_.estimates_outside = !record_.covers && options_.follower.rule == FollowRule::kPublished;
    record_.renews = options_.follower.renewed > 0;
    record_.triangles = mesh_->prepared().mesh.triangles;
    Stopwatch stopwatch;
    const std::size_t count = motion_->frame_count();
    const std::vector<Point> rest = mesh_->prepared().mesh.vertices;
    if (Status status = add_frame("rest", 0, rest, true); !status) return status;
    if (!options_.rig.empty()) rigged_.push_back({joints_at_rest(*motion_->rig()), record_.frames.back().balls});
    for (std::size_t i = 0; i < count; ++i) {
      if (interrupted()) return stopped();
      shared_.progress.update("follow", static_cast<double>(i) / static_cast<double>(count));
      if (Status status = take_frame(i, count); !status) return status;
    }
    shared_.progress.clear();
    shared_.times.push_back({"follow", stopwatch.lap()});
    return {};
  }

  Status take_frame(std::size_t i, std::size_t count) {
    {
      const EndAtOnce guard;  // a pipe may wait
      if (interrupted()) return stopped();
      if (Status status = motion_->read_frame(i, frame_); !status) return status;
    }
    if (Status status = check_size(frame_.positions, frame_.name); !status) return status;
    map_->map(frame_.positions, vertices_);
    Stopwatch stopwatch;
    if (Status status = follower_->update(vertices_); !status) {
      return Error{status.error().code, frame_.name + ": " + status.error().message};
    }
    update_seconds_ += stopwatch.lap();
    const double time = static_cast<double>(i + 1) / options_.frames_per_second;
    const bool shows = (!options_.html.empty() && is_chosen(i + 1, count + 1, kMostPageFrames)) ||
                       (!options_.picture.empty() && is_chosen(i + 1, count + 1, kMostMotionPictures));
    if (Status status = add_frame(frame_.name, time, vertices_, shows); !status) return status;
    if (!options_.rig.empty()) rigged_.push_back({frame_.joints, record_.frames.back().balls});
    return {};
  }

  /// Of the outputs, the summary, tables and arrays alone have the volume by which balls reach out.
  bool shows_outside() const {
    const auto is_npz = [](const std::string& file) { return file_extension(file) == ".npz"; };
    return !options_.quiet || writes_table(options_) || std::ranges::any_of(options_.outputs, is_npz);
  }

  /// The balls as they are now, and what is measured of them. Neither measurements nor the reference can be stopped
  /// half-way; nothing is lost if the process ends.
  Status add_frame(const std::string& name, double time, const std::vector<Point>& vertices, bool keeps_vertices) {
    const EndAtOnce while_measured;
    if (interrupted()) return stopped();
    FollowedFrame frame;
    frame.name = name;
    frame.short_name = options_.frames.empty() ? name : platform::stem_of(name);
    frame.time = time;
    frame.is_mirrored = is_mirrored(mesh_->prepared(), vertices);
    if (Status status = follower_->describe(frame); !status) return status;
    if (record_.has_volume && !record_.frames.empty()) {  // the rest pose has one
      const Result<bool> encloses = encloses_volume(mesh_->prepared(), vertices, threads());
      if (!encloses) return encloses.error();
      if (!encloses.value()) frame.forget_solid_volume();
    }
    if (writes_table(options_)) {
      if (Status status = follower_->measure_distances(vertices, *mesh_, frame); !status) return status;
    }
    if (shows_outside()) {
      if (Status status = follower_->estimate_outside(vertices, *mesh_, frame); !status) return status;
    }
    if (options_.check) check(vertices, frame);
    if (keeps_vertices && (!options_.html.empty() || !options_.picture.empty())) {
      for (const Point& p : vertices) {
        frame.vertices.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
      }
    }
    record_.frames.push_back(std::move(frame));
    return {};
  }

  /// By the reference.
  void check(const std::vector<Point>& vertices, const FollowedFrame& frame) {
    std::vector<Ball> present;
    std::ranges::copy_if(frame.balls, std::back_inserter(present), [](const Ball& ball) { return ball.radius > 0; });
    const CheckReport report = follower_->check(moved(mesh_->prepared(), vertices), present);
    if (check_.lines.empty()) {
      check_.lines = report.lines;
      return;
    }
    for (std::size_t i = 0; i < report.lines.size(); ++i) {
      CheckLine& line = check_.lines[i];
      if (line.failed == 0 && report.lines[i].failed > 0) {
        line.first_failure = frame.name + ": " + report.lines[i].first_failure;
      }
      line.tested += report.lines[i].tested;
      line.failed += report.lines[i].failed;
      line.worst = std::max(line.worst, report.lines[i].worst);
    }
  }

  Status rig() {
    if (options_.rig.empty()) return {};
    Stopwatch stopwatch;
    const BallBinding binding = rig_has_nodes(options_) ? BallBinding::kOneJoint : BallBinding::kBlended;
    Result<BallRig> bound = rig_balls(*motion_, rigged_, *map_, binding, *mesh_, threads(),
                                      [&](double done) { shared_.progress.update("rig", done); });
    shared_.progress.clear();
    if (!bound) return bound.error();
    rig_ = std::move(bound).value();
    shared_.times.push_back({"rig", stopwatch.lap()});
    return {};
  }

  /// Files are made in memory: until they are written a signal may end the program.
  Status make_files() {
    const EndAtOnce guard;
    if (interrupted()) return stopped();
    for (const std::string& output : options_.outputs) {
      Result<std::string> bytes = encode(output);
      if (!bytes) return bytes.error();
      files_.push_back({output, std::move(bytes).value()});
    }
    if (!options_.rig.empty()) {
      Result<std::string> bytes =
          encode_rig_as(options_.rig, {record_.version, record_.name, *motion_->rig(), rig_}, motion_->source());
      if (!bytes) return bytes.error();
      files_.push_back({options_.rig, std::move(bytes).value()});
    }
    if (options_.picture.empty() && options_.html.empty()) return {};
    shared_.progress.update("picture", 0);
    Stopwatch stopwatch;
    if (!options_.picture.empty()) {
      Result<std::string> png = encode_png(draw_motion(record_, options_.view));
      if (!png) return png.error();
      files_.push_back({options_.picture, std::move(png).value()});
    }
    if (!options_.html.empty()) files_.push_back({options_.html, encode_motion_page(record_, options_.view.up)});
    shared_.progress.clear();
    shared_.times.push_back({"picture", stopwatch.lap()});
    return {};
  }

  Result<std::string> encode(const std::string& output) const {
    const std::string extension = file_extension(output);
    if (extension == ".npz") return encode_motion_npz(record_);
    if (extension == ".glb") return encode_motion_glb(record_);
    return encode_motion_csv(record_);
  }

  Status report_check() const {
    if (!options_.check) return {};
    return print_check(check_, std::ranges::any_of(files_, [](const OutputFile& file) { return file.path == "-"; }));
  }

  FollowOptions options_;
  SharedOfRun shared_;
  std::unique_ptr<MeshMotion> motion_;
  std::optional<VertexMap> map_;
  std::optional<IndexedMesh> mesh_;
  std::unique_ptr<MovingBalls> follower_;
  MotionFrame frame_;            // the last that was read
  std::vector<Point> vertices_;  // of the prepared mesh in that frame
  MotionRecord record_;
  double update_seconds_ = 0;
  std::vector<RiggedFrame> rigged_;  // with --rig
  BallRig rig_;                      // likewise
  CheckReport check_;
  std::vector<OutputFile> files_;
};

/// A pattern without further meshes stands for all of them; beside others it cannot be the rest pose.
Result<FollowOptions> with_named_files(const FollowOptions& options) {
  if (!is_frame_pattern(options.rest)) return options;
  if (!options.frames.empty()) {
    return Error{ErrorCode::kUsage, fmt::format("{} stands for several files, and the rest pose is one: a pattern is "
                                                "the only mesh, or comes after REST",
                                                medial_vk::quoted(options.rest))};
  }
  const Result<std::vector<std::string>> files = files_of_pattern(options.rest);
  if (!files) return files.error();
  return with_files_of_pattern(options, files.value());
}

}  // namespace

Status run_follow(const std::vector<std::string>& arguments) {
  const Result<FollowOptions> options = parse_follow_options(arguments);
  if (!options) return options.error();
  if (options.value().help) return print_result(follow_help_text());
  const Result<FollowOptions> named = with_named_files(options.value());
  if (!named) return named.error();
  return FollowRun(named.value()).run();
}

}  // namespace medial_vk::cli
