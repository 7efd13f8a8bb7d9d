#include "cli/spheres/run_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stop_token>
#include <utility>

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
#include "reference_bridge/check_balls.h"

namespace medial_vk::cli {
namespace {

/// The sequence of steps from a mesh to a body file, and their shared data.
class BodyRun {
 public:
  explicit BodyRun(const SpheresOptions& options) : options_(options), shared_(!options.quiet) {}

  Status run() {
    if (Status status = check_writable(options_.output); !status) return status;
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
    if (interrupted()) return stopped();
    if (Status status = write_files({&file_, 1}); !status) return status;
    if (!options_.quiet) {
      print_message(body_summary(options_, inside_, cover_, shared_.times, file_.bytes.size()));
    }
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

  Status fit(SphereContract contract, SphereFit& result) {
    Stopwatch stopwatch;
    std::stop_source stop;
    const char* const step = contract == SphereContract::kInside ? "inside" : "cover";
    const StageProgress on_progress = [&](const char*, double done) {
      shared_.progress.update(step, done);
      if (interrupted()) stop.request_stop();
    };
    SphereFitOptions fit_options = options_.spheres;
    fit_options.contract = contract;
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
    result = std::move(fit).value();
    shared_.times.push_back({step, stopwatch.lap()});
    return {};
  }

  /// The reference cannot be stopped half-way, but nothing is lost if the process ends.
  Status check() {
    if (!options_.check) return {};
    const EndAtOnce while_checked;
    if (interrupted()) return stopped();
    shared_.progress.update("check", 0);
    check_ = check_balls_inside(mesh_->prepared(), inside_.levels.back());
    const CheckReport covers = check_balls_cover(mesh_->prepared(), cover_.levels.back());
    check_.lines.insert(check_.lines.end(), covers.lines.begin(), covers.lines.end());
    shared_.progress.clear();
    return {};
  }

  /// The bytes are read and proved as every reader will do, so that no file is written that would be refused.
  Status make_file() {
    BodyFile body;
    body.version = version();
    body.mesh.vertices = mesh_->prepared().mesh.vertices;
    body.mesh.triangles = mesh_->prepared().mesh.triangles;
    body.inside = inside_.levels.back();
    body.cover = cover_.levels.back();
    body.measures = {inside_.measures.inside.greatest_excess,
                     inside_.measures.distances.boundary_to_balls,
                     cover_.measures.distances.balls_to_solid,
                     cover_.measures.cover.triangles,
                     cover_.measures.cover.vertices,
                     inside_.measures.volume.solid,
                     inside_.measures.volume.balls,
                     cover_.measures.volume.balls};
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
    file_ = {options_.output, std::move(bytes).value()};
    return {};
  }

  static Error defect(const Error& error) {
    if (error.code != ErrorCode::kInvalidMesh) return error;
    return {ErrorCode::kInternal,
            fmt::format("the file would not be accepted: {}; nothing was written", error.message)};
  }

  Status report_check() const {
    if (!options_.check) return {};
    return print_check(check_, options_.output == "-");
  }

  const SpheresOptions& options_;
  SharedOfRun shared_;
  std::optional<IndexedMesh> mesh_;
  SphereFit inside_, cover_;
  CheckReport check_;
  OutputFile file_;
};

}  // namespace

Status run_body(const SpheresOptions& options) { return BodyRun(options).run(); }

}  // namespace medial_vk::cli
