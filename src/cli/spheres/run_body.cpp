#include "cli/spheres/run_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

#include "base/stopwatch.h"
#include "body_files/body_file.h"
#include "cli/shared/load.h"
#include "cli/shared/load_body.h"
#include "cli/shared/reference_with_estimate.h"
#include "cli/shared/shared_of_run.h"
#include "cli/spheres/body_summary.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/messages.h"
#include "cli/terminal/tables.h"
#include "medial_vk/version.h"
#include "output/atomic_files/atomic_file.h"
#include "output/fit_reports/fits_record.h"
#include "output/fit_reports/fits_report.h"
#include "output/picture/body_picture.h"
#include "output/picture/panels/image.h"
#include "platform/paths.h"
#include "reference_bridge/check_balls.h"

namespace medial_vk::cli {
namespace {

/// The sequence of steps from a mesh to a body file, and their shared data.
class BodyRun {
 public:
  explicit BodyRun(const SpheresOptions& options) : options_(options), shared_(!options.quiet) {}

  Status run() {
    for (const NamedOutput& output : outputs_of(options_)) {
      if (output.file->empty()) continue;
      if (Status status = check_writable(*output.file); !status) return status;
    }
    if (options_.backend != Backend::kCpu) {
      shared_.opening.start(options_.device, options_.spheres.threads, shared_.progress);  // while the mesh is read
    }
    if (Status status = load(); !status) return status;
    if (Status status = shared_.opening.take(shared_.context, shared_.device, shared_.times); !status) return status;
    if (!options_.quiet) print_message(body_opening(options_, mesh_->prepared().report, shared_.device));
    if (Status status = fit(SphereContract::kInside, inside_); !status) return status;
    if (Status status = fit(SphereContract::kCover, cover_); !status) return status;
    if (Status status = check(); !status) return status;
    if (Status status = make_file(); !status) return status;
    if (Status status = draw(); !status) return status;
    if (!options_.report.empty()) files_.push_back({options_.report, encode_fits_report(record())});
    if (interrupted()) return stopped();
    if (Status status = write_files(files_); !status) return status;
    if (!options_.quiet) print_message(body_summary(options_, inside_.fit, cover_.fit, shared_.times, files_));
    return report_check();
  }

 private:
  Status load() {
    shared_.progress.update("read", 0);
    Result<std::vector<ScenePart>> read = read_meshes(options_.input, false, shared_.times);
    shared_.progress.clear();
    if (!read) return read.error();
    // The same preparation as for distances without a file.
    const unsigned threads = options_.spheres.threads;
    const PrepareOptions prepare = {
        .keep_inner_faces = options_.keep_inner_faces, .threads = threads, .keep_outer_faces = true};
    Result<PreparedMesh> prepared =
        prepare_loaded(std::move(read.value().front().mesh), options_.input, shared_.opening, prepare, shared_.times);
    if (!prepared) return prepared.error();
    if (!prepared.value().report.closed) {
      return Error{ErrorCode::kInvalidMesh,
                   fmt::format("{}: the mesh is not closed: a body needs one that encloses a solid", options_.input)};
    }
    Result<IndexedMesh> indexed = IndexedMesh::build(std::move(prepared).value(), {.threads = threads});
    if (!indexed) return indexed.error();
    mesh_ = std::move(indexed).value();
    return {};
  }

  /// A set of balls, and what is known about it.
  struct Set {
    SphereFit fit;
    double seconds = 0;
    std::optional<CheckReport> check;
  };

  Status fit(SphereContract contract, Set& result) {
    Stopwatch stopwatch;
    std::stop_source stop;
    const char* const step = contract == SphereContract::kInside ? "inside" : "cover";
    const StageProgress on_progress = [&](const char*, double done) {
      shared_.progress.update(step, done);
      if (interrupted()) stop.request_stop();
    };
    SphereFitOptions fit_options = options_.spheres;
    fit_options.contract = contract;
    // An error is one of the volume, which sets for distances give up for nearness.
    fit_options.for_distances = fit_options.error == 0;
    Result<SphereFit> fit = shared_.context
                                ? fit_spheres(*mesh_, fit_options, *shared_.context, on_progress, stop.get_token())
                                : fit_spheres(*mesh_, fit_options, reference_with_estimate(shared_.progress),
                                              on_progress, stop.get_token());
    shared_.progress.clear();
    if (!fit && fit.error().code == ErrorCode::kInterrupted) return stopped();
    if (!fit) {
      Error error = fit.error();
      error.message = in_words_of_options(std::move(error.message), Command::kSpheres);
      return with_hint(std::move(error));
    }
    result.fit = std::move(fit).value();
    result.seconds = stopwatch.lap();
    shared_.times.push_back({step, result.seconds});
    return {};
  }

  /// The reference cannot be stopped half-way, but nothing is lost if the process ends.
  Status check() {
    if (!options_.check) return {};
    const EndAtOnce while_checked;
    if (interrupted()) return stopped();
    shared_.progress.update("check", 0);
    inside_.check = check_balls_inside(mesh_->prepared(), inside_.fit.levels.back());
    cover_.check = check_balls_cover(mesh_->prepared(), cover_.fit.levels.back());
    shared_.progress.clear();
    return {};
  }

  /// The bytes are read and proved as every reader will do, so that no file is written that would be refused.
  Status make_file() {
    BodyFile body;
    body.version = version();
    body.mesh.vertices = mesh_->prepared().mesh.vertices;
    body.mesh.triangles = mesh_->prepared().mesh.triangles;
    const SphereMeasures &inside = inside_.fit.measures, &cover = cover_.fit.measures;
    body.inside = inside_.fit.levels.back();
    body.cover = cover_.fit.levels.back();
    body.measures = {inside.inside.greatest_excess,
                     inside.distances.boundary_to_balls,
                     cover.distances.balls_to_solid,
                     cover.cover.triangles,
                     cover.cover.vertices,
                     inside.volume.solid,
                     inside.volume.balls,
                     cover.volume.balls};
    Result<std::string> bytes = encode_body_file(body);
    if (!bytes) return bytes.error();
    const Result<BodyFile> again = decode_body_file(bytes.value(), options_.output);
    if (!again) return defect(again.error());
    std::vector<StageTime> times;
    const Result<LoadedBody> loaded = load_body(again.value(), options_.output, options_.spheres.threads, times);
    if (!loaded) return defect(loaded.error());
    for (const StageTime& time : times) {
      if (time.stage == "prove") shared_.times.push_back(time);
    }
    files_.push_back({options_.output, std::move(bytes).value()});
    return {};
  }

  /// Files are made in memory: until they are written a signal may end the program.
  Status draw() {
    if (options_.picture.empty()) return {};
    const EndAtOnce guard;
    if (interrupted()) return stopped();
    shared_.progress.update("picture", 0);
    Stopwatch stopwatch;
    Result<std::string> png = encode_png(
        draw_body(mesh_->prepared().mesh, inside_.fit.levels.back(), cover_.fit.levels.back(), options_.view));
    shared_.progress.clear();
    if (!png) return png.error();
    files_.push_back({options_.picture, std::move(png).value()});
    shared_.times.push_back({"picture", stopwatch.lap()});
    return {};
  }

  FitsRecord record() const {
    FitsRecord record;
    record.input = options_.input;
    record.output = options_.output;
    record.output_format = "body";
    record.is_body = true;
    record.spheres = options_.spheres;
    record.backend = options_.backend;
    record.name = options_.input == "-" ? "stdin" : platform::stem_of(options_.input);
    record.device = shared_.device;
    record.times = shared_.times;
    for (const auto& [contract, set] :
         {std::pair(SphereContract::kInside, &inside_), {SphereContract::kCover, &cover_}}) {
      FittedSolid& solid = record.solids.emplace_back();
      solid.link = solid.name = record.name;
      solid.mesh = mesh_;
      solid.contract = contract;
      solid.check = set->check;
      solid.seconds = set->seconds;
      take_fit(set->fit, options_.spheres.count, solid);
    }
    return record;
  }

  static Error defect(const Error& error) {
    if (error.code != ErrorCode::kInvalidMesh) return error;
    return {ErrorCode::kInternal,
            fmt::format("the file would not be accepted: {}; nothing was written", error.message)};
  }

  Status report_check() const {
    if (!options_.check) return {};
    CheckReport all = *inside_.check;
    all.lines.insert(all.lines.end(), cover_.check->lines.begin(), cover_.check->lines.end());
    return print_check(all, std::ranges::any_of(files_, [](const OutputFile& file) { return file.path == "-"; }));
  }

  const SpheresOptions& options_;
  SharedOfRun shared_;
  std::optional<IndexedMesh> mesh_;
  Set inside_, cover_;
  std::vector<OutputFile> files_;
};

}  // namespace

Status run_body(const SpheresOptions& options) { return BodyRun(options).run(); }

}  // namespace medial_vk::cli
