#include "cli/spheres/run_motion_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

#include "base/stopwatch.h"
#include "cli/shared/load.h"
#include "cli/shared/reference_with_estimate.h"
#include "cli/shared/rest_mesh.h"
#include "cli/shared/shared_of_run.h"
#include "cli/spheres/motion_fit_summary.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/messages.h"
#include "cli/terminal/tables.h"
#include "medial_vk/analysis.h"
#include "medial_vk/follower.h"
#include "medial_vk/sphere_fits.h"
#include "medial_vk/version.h"
#include "motion_files/mesh_motion.h"
#include "motion_fits/choose_balls.h"
#include "output/atomic_files/atomic_file.h"
#include "output/sphere_files/sphere_file.h"
#include "platform/paths.h"
#include "reference_bridge/check_balls.h"

namespace medial_vk::cli {
namespace {

/// Frames in which unions are compared while balls are chosen; the result is measured in all frames.
constexpr std::size_t kMostChoiceFrames = 12;

/// A resolution with some twenty medial points for each ball, on smooth solids.
std::uint32_t usual_resolution(std::size_t count) {
  constexpr double kPointsOfBall = 20, kPointsOfSquare = 0.6;
  return static_cast<std::uint32_t>(
      std::clamp(std::sqrt(static_cast<double>(count) * kPointsOfBall / kPointsOfSquare), 60.0, 180.0));
}

/// The sequence of steps from a mesh and its frames to a file, and their shared data.
class MotionFitRun {
 public:
  explicit MotionFitRun(const SpheresOptions& options) : options_(options), shared_(!options.quiet) {}

  Status run() {
    if (Status status = check_writable(options_.output); !status) return status;
    if (options_.backend != Backend::kCpu) shared_.opening.start(options_.device, threads(), shared_.progress);
    if (Status status = open(); !status) return status;
    if (Status status = prepare(); !status) return status;
    if (Status status = read_frames(); !status) return status;
    if (Status status = shared_.opening.take(shared_.context, shared_.device, shared_.times); !status) return status;
    if (!options_.quiet) {
      print_message(motion_fit_opening(options_, mesh_->prepared().report, motion_->frame_count(), shared_.device));
    }
    if (Status status = find_balls(); !status) return status;
    if (Status status = compare(); !status) return status;
    if (Status status = make_file(); !status) return status;
    if (interrupted()) return stopped();
    if (Status status = write_files(files_); !status) return status;
    if (!options_.quiet) {
      print_message(
          motion_fit_summary(options_, result_.size(), measures_, of_rest_, is_of_rest_, shared_.times, files_));
    }
    return report_check();
  }

 private:
  unsigned threads() const { return options_.spheres.threads; }

  Status open() {
    const EndAtOnce guard;
    if (interrupted()) return stopped();
    shared_.progress.update("read", 0);
    Stopwatch stopwatch;
    Result<std::unique_ptr<MeshMotion>> motion = open_motion();
    shared_.progress.clear();
    if (!motion) return motion.error();
    motion_ = std::move(motion).value();
    shared_.times.push_back({"read", stopwatch.lap()});
    return {};
  }

  Result<std::unique_ptr<MeshMotion>> open_motion() const {
    if (frames_are_animation(options_)) {
      AnimationOptions animation;
      animation.animation = options_.animation;
      return open_animation(options_.input, animation);
    }
    Result<std::vector<std::string>> files = files_of_frames(options_.frames);
    if (!files) return files.error();
    for (const std::string& file : files.value()) {
      if (Status status = check_outputs_differ(outputs_of(options_), file); !status) return status.error();
    }
    return open_mesh_files(options_.input, std::move(files).value());
  }

  /// They are read again while balls follow; but an error in one of them is better known before the long fit.
  Status read_frames() {
    const EndAtOnce guard;
    if (interrupted()) return stopped();
    Stopwatch stopwatch;
    const std::uint64_t count = motion_->frame_count();
    MotionFrame frame;
    Status status;
    for (std::uint64_t i = 0; i < count && status.ok(); ++i) {
      shared_.progress.update("read", static_cast<double>(i) / static_cast<double>(count));
      status = motion_->read_frame(i, frame);
      if (status) status = check_size(frame.positions, frame.name);
    }
    shared_.progress.clear();
    shared_.times.push_back({"read", stopwatch.lap()});
    return status;
  }

  /// As for `medial-vk follow`: without new vertices.
  Status prepare() {
    const PrepareOptions prepare = {.keep_inner_faces = true, .threads = threads(), .keep_outer_faces = true};
    Result<PreparedMesh> prepared =
        prepare_loaded(motion_->rest(), options_.input, shared_.opening, prepare, shared_.times);
    if (!prepared) return prepared.error();
    if (Status status = check_size(prepared.value().mesh.vertices, options_.input); !status) return status;
    if (!encloses_volume(prepared.value().report)) {
      return Error{ErrorCode::kInvalidMesh,
                   fmt::format("{}: it is not closed, or faces cross or lie inside: without a volume at rest no balls "
                               "can be chosen for --frames",
                               options_.input)};
    }
    map_.emplace(prepared.value());
    Result<IndexedMesh> indexed = IndexedMesh::build(std::move(prepared).value(), {.threads = threads()});
    if (!indexed) return with_hint(indexed.error());
    mesh_.emplace(std::move(indexed).value());
    return {};
  }

  /// The fit at rest, and the medial points to choose from.
  Status find_balls() {
    Stopwatch stopwatch;
    std::stop_source stop;
    const StageProgress on_progress = [&](const char*, double done) {
      shared_.progress.update("spheres", done);
      if (interrupted()) stop.request_stop();
    };
    const Extractor extractor =
        shared_.context ? device_extractor(*shared_.context) : reference_with_estimate(shared_.progress);
    SphereFitOptions fit_options = options_.spheres;
    fit_options.balls_only = true;
    Result<SphereFit> fit = fit_spheres(*mesh_, fit_options, extractor, on_progress, stop.get_token());
    if (!fit) return in_words(fit.error());
    plain_ = std::move(fit.value().levels.back());
    AnalysisOptions analysis;
    analysis.extraction.resolution =
        options_.spheres.resolution > 0 ? options_.spheres.resolution : usual_resolution(options_.spheres.count);
    analysis.threads = threads();
    const Result<Analysis> found = analyse(*mesh_, analysis, extractor, on_progress, stop.get_token());
    shared_.progress.clear();
    if (!found) return in_words(found.error());
    candidates_ = plain_;
    for (const MedialSphere& sphere : found.value().spheres) candidates_.push_back({sphere.centre, sphere.radius});
    shared_.times.push_back({"spheres", stopwatch.lap()});
    return {};
  }

  Error in_words(Error error) {
    shared_.progress.clear();
    if (error.code == ErrorCode::kInterrupted) return stopped();
    error.message = in_words_of_options(std::move(error.message), Command::kSpheres);
    return with_hint(std::move(error));
  }

  /// Balls chosen for all frames, and those of the fit at rest if they are better.
  Status compare() {
    Stopwatch stopwatch;
    if (Status status = measure("at rest", plain_, of_rest_); !status) return status;
    if (Status status = follow_candidates(); !status) return status;
    std::vector<std::uint32_t> of_plain(plain_.size());
    std::iota(of_plain.begin(), of_plain.end(), 0u);
    std::optional<MotionChoice> best;
    for (const std::vector<std::uint32_t>& start : {std::vector<std::uint32_t>(), of_plain}) {
      ChoiceOptions choice = {options_.spheres.count, threads(), {}};
      choice.goes_on = [&](double done) {
        shared_.progress.update("choose", 0.5 * done + (start.empty() ? 0 : 0.5));
        return !interrupted();
      };
      Result<MotionChoice> chosen = choose_balls(choice_frames_, start, choice);
      shared_.progress.clear();
      if (!chosen && chosen.error().code == ErrorCode::kInterrupted) return stopped();
      if (!chosen) return chosen.error();
      if (!best || chosen.value().value > best->value) best = std::move(chosen).value();
    }
    for (const std::uint32_t candidate : best->chosen) result_.push_back(candidates_[candidate]);
    if (Status status = measure("chosen", result_, measures_); !status) return status;
    compare_same_frames();
    is_of_rest_ = mean_uncovered(of_rest_) <= mean_uncovered(measures_);
    if (is_of_rest_) {
      result_ = plain_;
      measures_ = of_rest_;
    }
    shared_.times.push_back({"frames", stopwatch.lap()});
    return {};
  }

  /// Balls of one set may show that the triangles of a frame do not give its volume, and those of the other not.
  void compare_same_frames() {
    for (std::size_t i = 0; i < measures_.size(); ++i) {
      double &a = measures_[i].measures.solid_volume, &b = of_rest_[i].measures.solid_volume;
      if (std::isnan(a) || std::isnan(b)) a = b = std::numeric_limits<double>::quiet_NaN();
    }
  }

  /// Without steps, so that no ball depends on the others. Calls seen(name, vertices, follower) at rest, where there
  /// are no vertices, and in each frame.
  template <class Seen>
  Status follow(const char* stage, const std::vector<Ball>& balls, const Seen& seen) {
    FollowerOptions follower_options;
    follower_options.steps = 0;
    follower_options.threads = threads();
    Result<Follower> follower = Follower::create(*mesh_, balls, follower_options);
    if (!follower) return follower.error();
    const std::uint64_t count = motion_->frame_count();
    MotionFrame frame;
    std::vector<Point> vertices;
    if (Status status = seen("rest", vertices, follower.value()); !status) return status;
    for (std::uint64_t i = 0; i < count; ++i) {
      if (interrupted()) return stopped();
      shared_.progress.update(stage, static_cast<double>(i) / static_cast<double>(count));
      if (Status status = motion_->read_frame(i, frame); !status) return status;
      map_->map(frame.positions, vertices);
      if (Status status = follower.value().update(vertices); !status) {
        return Error{status.error().code, frame.name + ": " + status.error().message};
      }
      if (Status status = seen(frame.name, vertices, follower.value()); !status) return status;
    }
    shared_.progress.clear();
    return {};
  }

  Status measure(const char* stage, const std::vector<Ball>& balls, std::vector<MeasuredFrame>& measured) {
    const auto seen = [&](const std::string& name, const std::vector<Point>& vertices,
                          const Follower& follower) -> Status {
      const Result<FollowMeasures> measures = follower.measure();
      if (!measures) return measures.error();
      measured.push_back({name, measures.value()});
      if (vertices.empty()) return {};
      const Result<bool> encloses = encloses_volume(mesh_->prepared(), vertices, threads());
      if (!encloses) return encloses.error();
      if (!encloses.value()) measured.back().measures.solid_volume = std::numeric_limits<double>::quiet_NaN();
      return {};
    };
    return follow(stage, balls, seen);
  }

  /// Where all candidates are in some frames, the first and the last among them.
  Status follow_candidates() {
    const std::size_t count = of_rest_.size(), most = std::min(count, kMostChoiceFrames);
    std::size_t number = 0;
    const auto seen = [&](const std::string&, const std::vector<Point>&, const Follower& follower) -> Status {
      const std::size_t frame = number++;
      const std::size_t next = choice_frames_.size();
      if (next >= most || frame < next * (count - 1) / std::max<std::size_t>(most - 1, 1)) return {};
      const double volume = of_rest_[frame].measures.solid_volume;
      if (!(volume > 0)) return {};
      choice_frames_.push_back({{follower.balls().begin(), follower.balls().end()}, 1 / volume});
      return {};
    };
    return follow("follow", candidates_, seen);
  }

  Status make_file() {
    if (options_.check) {
      const EndAtOnce while_checked;
      if (interrupted()) return stopped();
      check_ = check_balls_inside(mesh_->prepared(), result_);
    }
    SphereFile file;
    file.version = version();
    file.contract = "inside";
    file.method = "best";
    file.name = options_.input == "-" ? "stdin" : platform::stem_of(options_.input);
    file.branch = options_.spheres.count;
    file.parts = {{file.name, file.name, {result_}, {ReachOut()}}};
    Result<std::string> bytes = encode_spheres(options_.format, file);
    if (!bytes) return bytes.error();
    files_.push_back({options_.output, std::move(bytes).value()});
    return {};
  }

  Status report_check() const {
    if (!options_.check) return {};
    return print_check(check_, options_.output == "-");
  }

  const SpheresOptions& options_;
  SharedOfRun shared_;
  std::unique_ptr<MeshMotion> motion_;
  std::optional<VertexMap> map_;
  std::optional<IndexedMesh> mesh_;
  std::vector<Ball> plain_, candidates_, result_;
  std::vector<CandidateFrame> choice_frames_;
  std::vector<MeasuredFrame> of_rest_, measures_;  // of the fit at rest, and of the result
  bool is_of_rest_ = false;                        // the result is the fit at rest
  CheckReport check_;
  std::vector<OutputFile> files_;
};

}  // namespace

Status run_motion_fit(const SpheresOptions& options) { return MotionFitRun(options).run(); }

}  // namespace medial_vk::cli
