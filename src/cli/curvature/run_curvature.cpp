#include "cli/curvature/run_curvature.h"

#include <fmt/format.h>

#include <stop_token>
#include <utility>

#include "ball_files/read_balls.h"
#include "base/stopwatch.h"
#include "cli/curvature/curvature_summary.h"
#include "cli/help/help_texts.h"
#include "cli/options/curvature_options.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/messages.h"
#include "cli/terminal/progress.h"
#include "output/atomic_files/atomic_file.h"
#include "output/curvature_files/curvature_files.h"

namespace medial_vk::cli {
namespace {

/// The sequence of steps from a file of balls to their curvatures, and their shared data.
class CurvatureRun {
 public:
  explicit CurvatureRun(const CurvatureCommandOptions& options) : options_(options), progress_(!options.quiet) {}

  Status run() {
    for (const NamedOutput& output : outputs_of(options_)) {
      if (output.file->empty()) continue;
      if (Status status = check_writable(*output.file); !status) return status;
    }
    if (Status status = read(); !status) return status;
    if (Status status = measure(); !status) return status;
    if (Status status = make_files(); !status) return status;
    if (interrupted()) return stopped();
    if (Status status = write_files(files_); !status) return status;
    if (!options_.quiet) print_message(curvature_summary(summary_, times_, files_, options_.verbose));
    return {};
  }

 private:
  Status read() {
    const EndAtOnce guard;  // a pipe may wait
    if (interrupted()) return stopped();
    Stopwatch stopwatch;
    Result<BallsWithSpokes> read = read_balls_with_spokes(options_.balls);
    if (!read) return read.error();
    input_ = std::move(read).value();
    if (options_.curvature.method == CurvatureMethod::kDifferences && input_.spokes.empty()) {
      return Error{
          ErrorCode::kInvalidMesh,
          fmt::format("{}: there are no spokes, which --method source needs; medial points have them", options_.balls)};
    }
    times_.push_back({"read", stopwatch.lap()});
    return {};
  }

  Status measure() {
    Stopwatch stopwatch;
    std::stop_source stop;
    const auto on_progress = [&](const char* stage, double done) {
      progress_.update(stage, done);
      if (interrupted()) stop.request_stop();
    };
    Result<BoundaryCurvature> measured =
        measure_curvature(input_.balls, options_.curvature, input_.spokes, on_progress, stop.get_token());
    progress_.clear();
    if (!measured && measured.error().code == ErrorCode::kInterrupted) return stopped();
    if (!measured) return measured.error();
    curvature_ = std::move(measured).value();
    summary_ = summarize(options_.balls, {input_.balls, curvature_, options_.curvature.method});
    times_.push_back({"measure", stopwatch.lap()});
    return {};
  }

  /// Files are made in memory: until they are written a signal may end the program.
  Status make_files() {
    const EndAtOnce guard;
    if (interrupted()) return stopped();
    const CurvatureTable table = {input_.balls, curvature_, options_.curvature.method};
    Result<std::string> bytes = encode(table);
    if (!bytes) return bytes.error();
    files_.push_back({options_.output, std::move(bytes).value()});
    if (!options_.report.empty()) files_.push_back({options_.report, curvature_report(summary_, times_)});
    return {};
  }

  Result<std::string> encode(const CurvatureTable& table) const {
    switch (options_.format()) {
      case CurvatureFormat::kPly:
        return encode_curvature_ply(table);
      case CurvatureFormat::kNpz:
        return encode_curvature_npz(table);
      case CurvatureFormat::kGlb:
        return encode_curvature_glb(table);
      case CurvatureFormat::kJson:
        return encode_curvature_json(table);
      case CurvatureFormat::kCsv:
        break;
    }
    return encode_curvature_csv(table);
  }

  const CurvatureCommandOptions& options_;
  Progress progress_;
  BallsWithSpokes input_;
  BoundaryCurvature curvature_;
  CurvatureSummary summary_;
  std::vector<StageTime> times_;
  std::vector<OutputFile> files_;
};

}  // namespace

Status run_curvature(const std::vector<std::string>& arguments) {
  const Result<CurvatureCommandOptions> options = parse_curvature_options(arguments);
  if (!options) return options.error();
  if (options.value().help) return print_result(curvature_help_text());
  return CurvatureRun(options.value()).run();
}

}  // namespace medial_vk::cli
