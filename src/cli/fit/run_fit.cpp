#include "cli/fit/run_fit.h"

#include <algorithm>
#include <optional>
#include <stop_token>
#include <utility>

#include "base/stopwatch.h"
#include "cli/fit/fit_summary.h"
#include "cli/help/help_texts.h"
#include "cli/options/fit/fit_options.h"
#include "cli/shared/load.h"
#include "cli/shared/reference_with_estimate.h"
#include "cli/shared/shared_of_run.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/messages.h"
#include "cli/terminal/tables.h"
#include "medial_vk/hull_fits.h"
#include "medial_vk/indexed_mesh.h"
#include "output/atomic_files/atomic_file.h"
#include "output/hull_files/hull_files.h"
#include "output/hull_picture/hull_picture.h"
#include "platform/paths.h"
#include "reference_bridge/check_hulls.h"

namespace medial_vk::cli {
namespace {

/// The sequence of steps from a mesh to its files, and their shared data.
class FitRun {
 public:
  explicit FitRun(const FitCommandOptions& options) : options_(options), shared_(!options.quiet) {
    record_.input = options.input;
    record_.output = options.output;
    record_.output_format = name_of(options.format);
    record_.name = options.input == "-" ? "stdin" : platform::stem_of(options.input);
    record_.options = options.hulls;
    record_.backend = options.backend;
  }

  Status run() {
    for (const NamedOutput& output : outputs_of(options_)) {
      if (output.file->empty()) continue;
      if (Status status = check_writable(*output.file); !status) return status;
    }
    if (options_.backend != Backend::kCpu) {
      shared_.opening.start(options_.device, options_.hulls.threads, shared_.progress);  // while the mesh is read
    }
    if (Status status = load(); !status) return status;
    if (Status status = fit(); !status) return status;
    if (Status status = check(); !status) return status;
    if (Status status = make_files(); !status) return status;
    if (interrupted()) return stopped();
    if (Status status = write_files(files_); !status) return status;
    if (!options_.quiet) print_message(fit_summary(record_, files_, options_.verbose));
    if (!record_.check) return {};
    return print_check(*record_.check,
                       std::ranges::any_of(files_, [](const OutputFile& file) { return file.path == "-"; }));
  }

 private:
  Status load() {
    shared_.progress.update("read", 0);
    Result<std::vector<ScenePart>> read = read_meshes(options_.input, false, record_.times);
    shared_.progress.clear();
    if (!read) return read.error();
    Result<PreparedMesh> prepared = prepare_loaded(std::move(read.value().front().mesh), options_.input,
                                                   shared_.opening, {.threads = options_.hulls.threads}, record_.times);
    if (!prepared) return prepared.error();
    record_.mesh = prepared.value().report;
    Result<IndexedMesh> indexed = IndexedMesh::build(std::move(prepared).value(), {.threads = options_.hulls.threads});
    if (!indexed) return with_hint(indexed.error());
    mesh_ = std::move(indexed).value();
    return {};
  }

  Status fit() {
    Status opened = shared_.opening.take(shared_.context, shared_.device, record_.times);
    record_.device = shared_.device;
    if (!opened) return opened;
    if (!options_.quiet) print_message(fit_opening(record_));
    Stopwatch stopwatch;
    std::stop_source stop;
    const StageProgress on_progress = [&](const char* stage, double done) {
      shared_.progress.update(stage, done);
      if (interrupted()) stop.request_stop();
    };
    Result<HullFit> fit = shared_.context
                              ? fit_hulls(*mesh_, options_.hulls, *shared_.context, on_progress, stop.get_token())
                              : fit_hulls(*mesh_, options_.hulls, reference_with_estimate(shared_.progress),
                                          on_progress, stop.get_token());
    shared_.progress.clear();
    record_.times.push_back({"hulls", stopwatch.lap()});
    if (!fit) return fit.error().code == ErrorCode::kInterrupted ? stopped() : in_words(fit.error());
    record_.fit = std::move(fit).value();
    return {};
  }

  /// For a defect it adds that no file has changed.
  static Error in_words(Error error) {
    if (error.code == ErrorCode::kInternal) error.message += "; nothing was written";
    return with_hint(std::move(error));
  }

  /// The reference cannot be stopped half-way, but nothing is lost if the process ends.
  Status check() {
    if (!options_.check) return {};
    const EndAtOnce while_checked;
    if (interrupted()) return stopped();
    Stopwatch stopwatch;
    record_.check = check_hulls_inside(mesh_->prepared(), record_.fit.hulls,
                                       [&](double done) { shared_.progress.update("check", done); });
    shared_.progress.clear();
    record_.times.push_back({"check", stopwatch.lap()});
    return {};
  }

  /// Files are made in memory: until they are written a signal may end the program.
  Status make_files() {
    const EndAtOnce guard;
    if (interrupted()) return stopped();
    Stopwatch stopwatch;
    Result<std::string> bytes = encode_hulls(options_.format, record_);
    if (!bytes) return bytes.error();
    files_.push_back({options_.output, std::move(bytes).value()});
    if (!options_.picture.empty()) {
      shared_.progress.update("picture", 0);
      const Result<Picture> picture = draw_hulls(record_, mesh_->view(), options_.picture_options);
      shared_.progress.clear();
      if (!picture) return picture.error();
      Result<std::string> png = encode_png(picture.value());
      if (!png) return png.error();
      files_.push_back({options_.picture, std::move(png).value()});
    }
    record_.times.push_back({"files", stopwatch.lap()});
    if (!options_.report.empty()) files_.push_back({options_.report, fit_report(record_)});
    return {};
  }

  const FitCommandOptions& options_;
  SharedOfRun shared_;
  std::optional<IndexedMesh> mesh_;
  std::vector<OutputFile> files_;
  HullRecord record_;
};

}  // namespace

Status run_fit(const std::vector<std::string>& arguments) {
  const Result<FitCommandOptions> options = parse_fit_options(arguments);
  if (!options) return options.error();
  if (options.value().help) return print_result(fit_help_text());
  return FitRun(options.value()).run();
}

}  // namespace medial_vk::cli
