#include "cli/plane/run_plane.h"

#include <fmt/format.h>

#include <algorithm>
#include <stop_token>
#include <utility>

#include "base/stopwatch.h"
#include "cli/help/help_texts.h"
#include "cli/options/plane/plane_options.h"
#include "cli/plane/load_shape.h"
#include "cli/plane/plane_summary.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/messages.h"
#include "cli/terminal/progress.h"
#include "cli/terminal/tables.h"
#include "medial_vk/plane_centre_line.h"
#include "medial_vk/plane_thesis.h"
#include "output/atomic_files/atomic_file.h"
#include "output/page/page.h"
#include "output/plane_files/plane_files.h"
#include "output/plane_page/plane_page.h"
#include "output/plane_picture/plane_picture.h"
#include "reference_bridge/check_plane_axis.h"

namespace medial_vk::cli {
namespace {

/// The sequence of steps from a shape to its axis, and their shared data.
class PlaneRun {
 public:
  explicit PlaneRun(const PlaneCommandOptions& options) : options_(options), progress_(!options.quiet) {}

  Status run() {
    if (Status status = check_slice(options_); !status) return status;
    if (!options_.html.empty()) {
      if (Status status = check_page_available(); !status) return status;
    }
    for (const NamedOutput& output : outputs_of(options_)) {
      if (output.file->empty()) continue;
      if (Status status = check_writable(*output.file); !status) return status;
    }
    if (Status status = load(); !status) return status;
    take_options();
    if (Status status = find(); !status) return status;
    if (Status status = check(); !status) return status;
    if (Status status = reduce(); !status) return status;
    if (Status status = make_files(); !status) return status;
    if (interrupted()) return stopped();
    if (Status status = write_files(files_); !status) return status;
    if (!options_.quiet) print_message(plane_summary(record_, times_, files_, options_.verbose));
    if (!options_.check) return {};
    return print_check(check_, std::ranges::any_of(files_, [](const OutputFile& file) { return file.path == "-"; }));
  }

 private:
  Status load() {
    const EndAtOnce guard;  // a pipe may wait
    if (interrupted()) return stopped();
    progress_.update("read", 0);
    Status status = load_shape(options_, {}, record_, times_);
    progress_.clear();
    return status;
  }

  /// Lengths are known when the shape is.
  void take_options() {
    const double side = record_.shape.report.longest_side();
    record_.options.side = options_.side;
    record_.options.object_angle = options_.object_angle;
    record_.options.radius = options_.radius.of(side);
    record_.options.margin = options_.margin.of(side);
    record_.options.threads = options_.threads;
    record_.pruning = {options_.prune_length.of(side), options_.prune_significance.of(side)};
    record_.longest_path = options_.longest_path;
    record_.smooth = options_.smooth.of(side);
    // A step below the precision of coordinates makes points without end.
    constexpr double kLeastStep = 1e-9;
    record_.step = std::max(options_.step.of(side), kLeastStep * side);
    record_.colour = options_.colour;
  }

  Status find() {
    Stopwatch stopwatch;
    std::stop_source stop;
    const auto on_progress = [&](double done) {
      progress_.update("axis", done);
      if (interrupted()) stop.request_stop();
    };
    Result<PlaneAxis> axis = options_.mode == PlaneMode::kThesis
                                 ? find_as_published(on_progress, stop.get_token())
                                 : find_plane_axis(record_.shape, record_.options, on_progress, stop.get_token());
    progress_.clear();
    if (!axis && axis.error().code == ErrorCode::kInterrupted) return stopped();
    if (!axis) return axis.error();
    record_.axis = std::move(axis).value();
    record_.branches_found = record_.axis.branches.size();
    times_.push_back({"axis", stopwatch.lap()});
    return {};
  }

  /// Points, as nodes without arcs.
  Result<PlaneAxis> find_as_published(const ProgressCallback& progress, const std::stop_token& stop) {
    PlaneThesisOptions how;
    how.object_angle = record_.options.object_angle;
    how.radius = record_.options.radius;
    how.threads = record_.options.threads;
    how.epsilon = 0x1p-30 * record_.shape.report.longest_side();
    const Result<PublishedAxis> found = find_plane_axis_as_published(record_.shape, how, progress, stop);
    if (!found) return found.error();
    const PublishedAxis& published = found.value();
    record_.published = PublishedCover{published.samples, published.discs, published.undetermined,
                                       published.missed_angle, published.missed_radius};
    PlaneAxis axis;
    axis.epsilon = how.epsilon;
    axis.nodes.reserve(published.points.size());
    for (const PublishedPoint& p : published.points) {
      axis.nodes.push_back({p.point, p.radius, p.object_angle, AxisNodeKind::kMeeting, 0});
    }
    return axis;
  }

  /// Brute force cannot be stopped half-way, but nothing is lost if the process ends.
  Status check() {
    if (!options_.check) return {};
    const EndAtOnce while_checked;
    if (interrupted()) return stopped();
    Stopwatch stopwatch;
    check_ = check_plane_axis(record_.shape, record_.options, record_.axis,
                              [&](double done) { progress_.update("check", done); });
    progress_.clear();
    times_.push_back({"check", stopwatch.lap()});
    return {};
  }

  /// Prunes, and makes polylines of what is left.
  Status reduce() {
    const EndAtOnce guard;
    if (interrupted()) return stopped();
    Stopwatch stopwatch;
    if (record_.pruning.length > 0 || record_.pruning.significance > 0) {
      Result<PlaneAxis> pruned = prune_plane_axis(record_.axis, record_.pruning);
      if (!pruned) return pruned.error();
      record_.axis = std::move(pruned).value();
    }
    if (record_.longest_path) {
      Result<PlaneLongestPaths> paths = find_longest_paths(record_.axis);
      if (!paths) return paths.error();
      record_.axis = std::move(paths.value().axis);
      record_.longest_excess = paths.value().excess;
    }
    record_.lines.reserve(record_.axis.branches.size());
    for (const AxisBranch& branch : record_.axis.branches) {
      std::vector<AxisSample> line = sample_branch(record_.axis, branch, record_.step);
      const bool is_loop = branch.ends[0] == branch.ends[1] && record_.axis.nodes[branch.ends[0]].degree == 2;
      if (record_.smooth > 0) line = smooth_polyline(line, record_.smooth, is_loop);
      record_.lines.push_back(std::move(line));
    }
    times_.push_back({"lines", stopwatch.lap()});
    return {};
  }

  /// Files are made in memory: until they are written a signal may end the program.
  Status make_files() {
    const EndAtOnce guard;
    if (interrupted()) return stopped();
    Stopwatch stopwatch;
    progress_.update("files", 0);
    files_.push_back({options_.output, encode()});
    if (!options_.picture.empty()) {
      Result<std::string> png = encode_png(draw_plane(record_));
      if (!png) return png.error();
      files_.push_back({options_.picture, std::move(png).value()});
    }
    if (!options_.html.empty()) files_.push_back({options_.html, encode_plane_page(record_)});
    progress_.clear();
    times_.push_back({"files", stopwatch.lap()});
    if (!options_.report.empty()) files_.push_back({options_.report, plane_report(record_, times_)});
    return {};
  }

  std::string encode() const {
    switch (options_.format()) {
      case PlaneFormat::kGeoJson:
        return encode_plane_geojson(record_);
      case PlaneFormat::kSvg:
        return encode_plane_svg(record_);
      case PlaneFormat::kCsv:
        return encode_plane_csv(record_);
      case PlaneFormat::kJson:
        break;
    }
    return encode_plane_json(record_);
  }

  const PlaneCommandOptions& options_;
  Progress progress_;
  PlaneRecord record_;
  std::vector<StageTime> times_;
  CheckReport check_;
  std::vector<OutputFile> files_;
};

}  // namespace

Status run_plane(const std::vector<std::string>& arguments) {
  const Result<PlaneCommandOptions> options = parse_plane_options(arguments);
  if (!options) return options.error();
  if (options.value().help) return print_result(plane_help_text());
  return PlaneRun(options.value()).run();
}

}  // namespace medial_vk::cli
