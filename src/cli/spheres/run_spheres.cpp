#include "cli/spheres/run_spheres.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <utility>

#include "base/stopwatch.h"
#include "cli/help/help_texts.h"
#include "cli/options/spheres_options.h"
#include "cli/shared/load.h"
#include "cli/shared/reference_with_estimate.h"
#include "cli/shared/shared_of_run.h"
#include "cli/spheres/run_body.h"
#include "cli/spheres/run_motion_fit.h"
#include "cli/spheres/spheres_summary.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/messages.h"
#include "cli/terminal/tables.h"
#include "common/file_extension.h"
#include "medial_vk/version.h"
#include "output/atomic_files/atomic_file.h"
#include "output/charts_and_tables/measures_output.h"
#include "output/fit_reports/fits_advice.h"
#include "output/fit_reports/fits_picture.h"
#include "output/fit_reports/fits_record.h"
#include "output/fit_reports/fits_report.h"
#include "output/picture/picture.h"
#include "platform/paths.h"
#include "reference_bridge/check_balls.h"
#include "robots/model/read_urdf.h"
#include "robots/parts.h"
#include "scene_files/part_names.h"

namespace medial_vk::cli {
namespace {

/// The sequence of steps from a mesh or robot to its files, and their shared data.
class SpheresRun {
 public:
  /// `options` name the files of this mesh. `part` is its name among several; empty: there is one mesh or robot.
  SpheresRun(SpheresOptions options, std::string part, SharedOfRun& shared)
      : options_(std::move(options)), shared_(shared) {
    record_.input = options_.input;
    record_.part = std::move(part);
    record_.output = options_.output;
    record_.output_format = name_of(options_.format);
    record_.is_robot = options_.is_robot;
    record_.spheres = options_.spheres;
    record_.count_per_link = options_.count_per_link;
    record_.total = options_.total;
    record_.backend = options_.backend;
  }

  Status load_mesh(Mesh mesh) {
    record_.times = shared_.times;
    const unsigned threads = options_.spheres.threads;
    Result<PreparedMesh> prepared =
        prepare_loaded(std::move(mesh), options_.input, shared_.opening, prepare_options(), record_.times);
    if (!prepared) return prepared.error();
    record_.name = options_.input == "-" ? "stdin" : platform::stem_of(options_.input);
    if (!record_.part.empty()) record_.name = record_.part;
    Result<IndexedMesh> indexed = IndexedMesh::build(std::move(prepared).value(), {.threads = threads});
    if (!indexed) return with_hint(indexed.error());
    FittedSolid solid;
    solid.link = solid.name = record_.name;
    solid.mesh = std::move(indexed).value();
    record_.solids.push_back(std::move(solid));
    return {};
  }

  PrepareOptions prepare_options() const {
    return {.keep_inner_faces = options_.keep_inner_faces,
            .threads = options_.spheres.threads,
            .keep_outer_faces = options_.spheres.contract != SphereContract::kInside};
  }

  Status load_robot() {
    const EndAtOnce guard;
    if (interrupted()) return stopped();
    Stopwatch stopwatch;
    Result<std::string> bytes = read_urdf_bytes(options_.input);
    if (!bytes) return bytes.error();
    urdf_ = std::move(bytes).value();
    Result<Robot> robot = read_urdf(urdf_, options_.input);
    if (!robot) return robot.error();
    robot_ = std::move(robot).value();
    record_.name = robot_.name.empty() ? platform::stem_of(options_.input) : robot_.name;
    const Result<MeshPlaces> places = mesh_places(options_.input, options_.packages);
    if (!places) return places.error();
    const bool cover = options_.spheres.contract == SphereContract::kCover;
    Result<RobotParts> loaded =
        load_parts(robot_, options_.visual, cover ? FacetSide::kCircumscribed : FacetSide::kInscribed, places.value(),
                   options_.input, prepare_options());
    if (!loaded) return loaded.error();
    parts_ = std::move(loaded.value().parts);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const PartOrigin& origin = loaded.value().origins[i];
      record_.solids.push_back(solid_of(parts_[i], origin.facet_share));
      if (origin.file.empty()) continue;
      if (Status status = check_outputs_differ(outputs_of(options_), origin.file); !status) return status;
    }
    record_.times.push_back({"read", stopwatch.lap()});
    return {};
  }

  /// All steps between the input and the bytes of the files.
  Status compute() {
    Status opened = shared_.opening.take(shared_.context, shared_.device, record_.times);
    record_.device = shared_.device;
    if (!opened) return opened;
    if (!options_.quiet) print_message(spheres_opening(options_, record_));
    if (Status status = fit(); !status) return status;
    if (Status status = check(); !status) return status;
    record_.times.push_back({"spheres", fit_and_check_.lap()});
    return make_files();
  }

  const std::vector<OutputFile>& files() const { return files_; }
  const std::string& part() const { return record_.part; }

  /// After the files have been written. An error of --check is kCheckFailed.
  Status conclude() const {
    if (!options_.quiet) print_message(spheres_summary(options_, record_, files_));
    if (options_.verbose) print_message(spheres_details(options_, record_));
    return report_check();
  }

 private:
  Status fit() {
    fit_and_check_.lap();
    std::stop_source stop;
    const StageProgress on_progress = [&](const char*, double done) {
      shared_.progress.update("spheres", done);
      if (interrupted()) stop.request_stop();
    };
    Status status =
        options_.is_robot ? fit_robot(on_progress, stop.get_token()) : fit_one_mesh(on_progress, stop.get_token());
    shared_.progress.clear();
    if (!status) return status.error().code == ErrorCode::kInterrupted ? stopped() : in_words(status.error());
    for (FittedSolid& solid : record_.solids) solid.advice = advise(solid, options_.spheres.contract);
    return {};
  }

  /// An error of the fit in words of options. For a defect it adds that no file has changed.
  Error in_words(Error error) const {
    if (error.code == ErrorCode::kInternal) error.message += "; nothing was written";
    error.message =
        in_words_of_options(std::move(error.message), options_.is_robot ? Command::kRobotSpheres : Command::kSpheres);
    return with_hint(std::move(error));
  }

  Status fit_robot(const StageProgress& on_progress, const std::stop_token& stop) {
    const PartFitOptions fit_options = {options_.spheres, options_.count_per_link, options_.total,
                                        options_.spheres.threads};
    Result<std::vector<PartFit>> fits =
        shared_.context ? fit_parts(parts_, fit_options, *shared_.context, on_progress, stop)
                        : fit_parts(parts_, fit_options, reference_with_estimate(shared_.progress), on_progress, stop);
    if (!fits) return fits.error();
    for (std::size_t i = 0; i < parts_.size(); ++i) take_fit(std::move(fits.value()[i]), record_.solids[i]);
    return {};
  }

  Status fit_one_mesh(const StageProgress& on_progress, const std::stop_token& stop) {
    Stopwatch stopwatch;
    FittedSolid& solid = record_.solids.front();
    const SphereFitOptions& fit_options = options_.spheres;
    Result<SphereFit> fit = shared_.context ? fit_spheres(*solid.mesh, fit_options, *shared_.context, on_progress, stop)
                                            : fit_spheres(*solid.mesh, fit_options,
                                                          reference_with_estimate(shared_.progress), on_progress, stop);
    if (!fit) return fit.error();
    take_fit(std::move(fit).value(), fit_options.count, solid);
    solid.seconds = stopwatch.lap();
    return {};
  }

  /// The reference cannot be stopped half-way, but nothing is lost if the process ends.
  Status check() {
    if (!options_.check) return {};
    const EndAtOnce while_checked;
    if (interrupted()) return stopped();
    for (std::size_t i = 0; i < record_.solids.size(); ++i) {
      FittedSolid& solid = record_.solids[i];
      if (!solid.mesh) continue;
      shared_.progress.update("check", static_cast<double>(i) / static_cast<double>(record_.solids.size()));
      const bool covers = options_.spheres.contract == SphereContract::kCover;
      const PreparedMesh& mesh = solid.mesh->prepared();
      solid.check = covers ? check_balls_cover(mesh, solid.proved) : check_balls_inside(mesh, solid.proved);
    }
    shared_.progress.clear();
    return {};
  }

  /// Files are made in memory: until they are written a signal may end the program.
  Status make_files() {
    const EndAtOnce guard;
    if (interrupted()) return stopped();
    Result<std::string> bytes = encode_spheres(options_.format, sphere_file());
    if (!bytes) return bytes.error();
    files_.push_back({options_.output, std::move(bytes).value()});
    if (Status status = draw(); !status) return status;
    draw_histogram();
    if (!options_.report.empty()) files_.push_back({options_.report, encode_fits_report(record_)});
    return {};
  }

  SphereFile sphere_file() const {
    SphereFile file;
    file.version = version();
    file.contract = name_of(options_.spheres.contract);
    file.method = name_of(options_.spheres.method);
    file.is_robot = options_.is_robot;
    file.name = record_.name;
    file.with_levels = options_.spheres.levels;
    file.branch = std::max(options_.spheres.count, options_.count_per_link);
    file.urdf = urdf_;
    for (const FittedSolid& solid : record_.solids) {
      file.parts.push_back({solid.link, solid.name, solid.levels, solid.reach});
    }
    if (file.branch > 0) return file;
    for (const PartSpheres& part : file.parts) file.branch = std::max(file.branch, part.levels.back().size());
    return file;
  }

  Status draw() {
    if (options_.picture.empty()) return {};
    shared_.progress.update("picture", 0);
    Stopwatch stopwatch;
    const std::vector<Pose> poses = options_.is_robot ? link_poses(robot_, record_.solids) : std::vector<Pose>(1);
    Result<std::string> png =
        encode_fits_picture(record_, poses, options_.view, record_.device ? &*record_.device : nullptr);
    if (!png) return png.error();
    files_.push_back({options_.picture, std::move(png).value()});
    record_.times.push_back({"picture", stopwatch.lap()});
    return {};
  }

  void draw_histogram() {
    if (options_.histogram.empty()) return;
    const SphereMeasures& measures = *record_.solids.front().measures;
    const bool as_table = file_extension(options_.histogram) == ".csv";
    files_.push_back(
        {options_.histogram, as_table ? encode_histograms_csv(measures) : encode_histograms_svg(measures)});
  }

  /// All parts in one table, a row for each condition.
  Status report_check() const {
    if (!options_.check) return {};
    const CheckReport check = joint_check(record_);
    std::string table = check_table(check);
    if (!record_.part.empty()) table = record_.part + ":\n" + table;
    const bool taken = std::ranges::any_of(files_, [](const OutputFile& file) { return file.path == "-"; });
    if (taken) {
      print_message(table);
    } else if (Status status = print_result(table); !status) {
      return status;
    }
    return verdict(check);
  }

  const SpheresOptions options_;
  SharedOfRun& shared_;
  std::string urdf_;
  Robot robot_;
  std::vector<Part> parts_;  // of the robot
  Stopwatch fit_and_check_;
  std::vector<OutputFile> files_;
  FitsRecord record_;
};

/// A run over the mesh or robot of the input, or with --each over its meshes, one after the other, whose files are
/// written together at the end.
class SpheresRuns {
 public:
  explicit SpheresRuns(const SpheresOptions& options) : options_(options), shared_(!options.quiet) {}

  Status run() {
    if (Status status = check_outputs(options_); !status) return status;
    if (options_.backend != Backend::kCpu)
      shared_.opening.start(options_.device, options_.spheres.threads, shared_.progress);  // while the input is read
    if (Status status = options_.is_robot ? run_robot() : run_meshes(); !status) return status;
    shared_.progress.clear();
    if (interrupted()) return stopped();
    std::vector<OutputFile> files;
    for (const auto& run : runs_) files.insert(files.end(), run->files().begin(), run->files().end());
    if (Status status = write_files(files); !status) return status;
    Status failed;
    for (const auto& run : runs_) {
      if (Status status = run->conclude(); !status && failed) failed = status;
    }
    return failed;
  }

 private:
  /// An early test, which saves hours of work.
  static Status check_outputs(const SpheresOptions& options) {
    for (const NamedOutput& output : outputs_of(options)) {
      if (output.file->empty()) continue;
      if (Status status = check_writable(*output.file); !status) return status;
    }
    return {};
  }

  Status run_robot() {
    runs_.push_back(std::make_unique<SpheresRun>(options_, "", shared_));
    shared_.progress.update("read", 0);
    Status status = runs_.front()->load_robot();
    shared_.progress.clear();
    return status ? runs_.front()->compute() : status;
  }

  Status run_meshes() {
    shared_.progress.update("read", 0);
    Result<std::vector<ScenePart>> read = read_meshes(options_.input, options_.each, shared_.times);
    shared_.progress.clear();
    if (!read) return read.error();
    std::vector<ScenePart> parts = std::move(read).value();
    if (Status status = prepare_runs(parts); !status) return status;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      Status status = runs_[i]->load_mesh(std::exchange(parts[i].mesh, Mesh()));
      if (status) status = runs_[i]->compute();
      if (!status) return options_.each ? error_in_part(status.error(), i, parts.size(), runs_[i]->part()) : status;
    }
    return {};
  }

  /// A run for each part, with files of its own.
  Status prepare_runs(const std::vector<ScenePart>& parts) {
    std::vector<std::string> names(1);
    if (options_.each) names = safe_part_names(parts);
    for (const std::string& name : names) {
      const SpheresOptions of_part = options_.each ? options_of_part(options_, name) : options_;
      if (Status status = check_outputs(of_part); !status) return status;
      if (Status status = check_outputs_differ(outputs_of(of_part), of_part.input); !status) return status;
      runs_.push_back(std::make_unique<SpheresRun>(of_part, name, shared_));
    }
    return {};
  }

  const SpheresOptions& options_;
  SharedOfRun shared_;
  std::vector<std::unique_ptr<SpheresRun>> runs_;
};

}  // namespace

Status run_spheres(const std::vector<std::string>& arguments) {
  const Result<SpheresOptions> options = parse_spheres_options(arguments);
  if (!options) return options.error();
  if (options.value().help) return print_result(spheres_help_text());
  if (options.value().both) return run_body(options.value());
  if (!options.value().frames.empty()) return run_motion_fit(options.value());
  return SpheresRuns(options.value()).run();
}

}  // namespace medial_vk::cli
