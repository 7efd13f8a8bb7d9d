#include "cli/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <new>
#include <optional>
#include <utility>

#include "analysis/extract.h"
#include "analysis/simplify.h"
#include "base/host_threads.h"
#include "base/stopwatch.h"
#include "checks/check_sheets.h"
#include "cli/extract/device_opening.h"
#include "cli/extract/load.h"
#include "cli/extract/summary.h"
#include "cli/extract/volumes.h"
#include "cli/options/options.h"
#include "cli/spheres/run_spheres.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/messages.h"
#include "cli/terminal/numbers.h"
#include "cli/terminal/progress.h"
#include "cli/terminal/tables.h"
#include "common/version.h"
#include "judge/check_balls.h"
#include "medial_mesh/medial_mesh.h"
#include "mesh/inspect_mesh.h"
#include "output/files/atomic_file.h"
#include "output/formats/encode_medial_mesh.h"
#include "output/formats/encode_points.h"
#include "output/page/page.h"
#include "output/picture/picture.h"
#include "output/report/report_json.h"

namespace medial_vk::cli {
namespace {

Status list_devices() {
  const Result<std::vector<DeviceDescription>> devices = Context::list_devices();
  if (!devices) return with_hint(devices.error());
  if (devices.value().empty()) return with_hint({ErrorCode::kNoDevice, "Vulkan lists no device"});
  return print_result(device_table(devices.value()));
}

// Sanitizers report threads that still run at the end, and memory that a driver points to from where they do not look.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kIsSanitized = true;
#elif defined(__has_feature)
constexpr bool kIsSanitized = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
constexpr bool kIsSanitized = false;
#endif

/// One run: the straight line from the mesh to the files, and what its steps share.
class ExtractionRun {
 public:
  explicit ExtractionRun(const Options& options) : options_(options), progress_(!options.quiet) {}

  Status run() {
    if (Status status = check_outputs(); !status) return status;
    if (options_.backend != Backend::kCpu) opening_.start(options_.device);  // while the mesh is read
    if (Status status = load(); !status) return status;
    if (Status status = index(); !status) return status;
    if (Status status = opening_.take(context_, record_.device, record_.host_times); !status) return status;
    if (!options_.quiet) print_message(opening(record_));
    if (Status status = extract(); !status) return status;
    if (Status status = make_files(); !status) return status;
    progress_.clear();
    if (interrupted()) return stopped();
    if (Status status = write_files(files_); !status) return status;
    leave_device();
    return conclude();
  }

 private:
  /// Better now than after an hour of work.
  Status check_outputs() const {
    if (!options_.html.empty()) {
      if (Status status = check_page_available(); !status) return status;
    }
    for (const std::string* path : {&options_.output, &options_.report, &options_.picture, &options_.html,
                                    &options_.medial_mesh, &options_.sheet_curve, &options_.ball_volumes}) {
      if (path->empty()) continue;
      if (Status status = check_writable(*path); !status) return status;
    }
    return {};
  }

  Status load() {
    progress_.update("read", 0);
    Result<PreparedMesh> mesh = load_mesh(options_, record_.host_times);
    progress_.clear();
    if (!mesh) return mesh.error();
    mesh_ = std::move(mesh).value();
    record_.input = options_.mesh;
    record_.output = options_.output;
    record_.parameters = options_.parameters;
    record_.backend = options_.backend;
    record_.seed = options_.seed;
    record_.perturb = options_.perturb;
    record_.simplify = options_.simplify;
    record_.mesh = mesh_.report;
    record_.longest_side = longest_side(mesh_.report);
    return {};
  }

  Status index() {
    if (!uses_index(options_.parameters, options_.backend)) return {};
    const EndAtOnce guard;
    if (interrupted()) return stopped();
    Stopwatch stopwatch;
    Result<MeshIndex> made = MeshIndex::create(mesh_.view(), host_threads(options_.threads));
    if (!made) return with_hint(made.error());
    index_.emplace(std::move(made).value());
    record_.host_times.push_back({"index", stopwatch.lap()});
    return {};
  }

  Status extract() {
    const StageProgress on_progress = [this](const char* stage, double done) {
      progress_.update(stage, done);
      return !interrupted();
    };
    Context* const context = context_ ? &*context_ : nullptr;
    const auto& parameters = options_.parameters;
    Result<CertifiedExtraction> result =
        index_
            ? extract_and_certify(mesh_, *index_, parameters, options_.backend, context, options_.threads, on_progress)
            : extract_and_certify(mesh_, parameters, options_.backend, context, options_.threads, on_progress);
    progress_.clear();
    if (!result) return result.error().code == ErrorCode::kInterrupted ? stopped() : with_hint(result.error());
    spheres_ = std::move(result.value().extraction.spheres);
    record_.grid = result.value().extraction.grid;
    record_.counters = std::move(result.value().extraction.counters);
    record_.undecided = std::move(result.value().extraction.undecided);
    record_.device_times = std::move(result.value().extraction.device_times);
    record_.certify = result.value().certify;
    for (StageTime& time : result.value().host_times) record_.host_times.push_back(std::move(time));
    return {};
  }

  /// In memory: until they are written a signal may end the program. These steps do not ask for one themselves.
  Status make_files() {
    const EndAtOnce guard;
    if (interrupted()) return stopped();
    simplify();
    group();
    if (Status status = weigh(); !status) return status;
    if (Status status = encode(); !status) return status;
    if (Status status = check(); !status) return status;
    if (Status status = draw(); !status) return status;
    make_page();
    if (Status status = connect(); !status) return status;
    encode_report();
    return {};
  }

  void simplify() {
    if (options_.simplify) {
      const double epsilon = options_.parameters.epsilon * record_.grid.voxel_size;
      record_.simplified = simplify_spheres(epsilon, spheres_);
    }
    describe_points();
  }

  void describe_points() {
    record_.points = spheres_.size();
    record_.radii = range_of_radii(spheres_);
    record_.object_angles = range_of_object_angles(spheres_);
  }

  /// Sheets, for every format that carries them.
  void group() {
    Stopwatch stopwatch;
    record_.sheet_parameters = options_.sheets;
    record_.sheets = find_sheets(spheres_, record_.grid, options_.parameters, options_.sheets,
                                 needs_volumes(options_) ? SheetAreas::kMeasured : SheetAreas::kLeftOut);
    for (std::size_t i = 0; i < spheres_.size(); ++i) spheres_[i].sheet = record_.sheets.of_point[i];
    record_.host_times.push_back({"sheets", stopwatch.lap()});
  }

  /// Volumes, and the sheets that are kept.
  Status weigh() {
    if (!needs_volumes(options_)) return {};
    Stopwatch stopwatch;
    const auto on_progress = [this](const char* stage, double done) {
      progress_.update(stage, done);
      return !interrupted();
    };
    Status status = measure_volumes(options_, on_progress, spheres_, record_, files_);
    progress_.clear();
    if (!status) {
      return status.error().code == ErrorCode::kInterrupted ? stopped() : with_hint(status.error());
    }
    describe_points();
    record_.host_times.push_back({"volumes", stopwatch.lap()});
    return {};
  }

  Status connect() {
    if (options_.medial_mesh.empty()) return {};
    progress_.update("medial mesh", 0);
    Stopwatch stopwatch;
    const double voxel = record_.grid.voxel_size;
    const Result<MedialMesh> mesh =
        make_medial_mesh(spheres_, record_.sheets, {voxel, options_.parameters.epsilon * voxel, options_.threads});
    if (!mesh) return mesh.error();
    record_.medial_mesh = mesh.value().topology;
    record_.euler_characteristic = euler_characteristic_of_solid(mesh_);
    files_.push_back({options_.medial_mesh, encode_medial_mesh(options_.medial_mesh, header_, spheres_, record_.sheets,
                                                               mesh.value(), options_.ascii)});
    record_.host_times.push_back({"medial mesh", stopwatch.lap()});
    return {};
  }

  Status encode() {
    header_ = make_header(record_.grid, options_.parameters, record_.longest_side);
    Result<std::string> bytes = encode_points(
        {options_.format, options_.ascii, options_.mesh_spheres, options_.gpu_instancing, options_.sphere_detail},
        header_, spheres_, record_.sheets.marks);
    if (!bytes) return bytes.error();
    points_file_ = files_.size();
    files_.push_back({options_.output, std::move(bytes).value()});
    return {};
  }

  /// The numbers as written: read back from the bytes that go to the file. The other formats are made from the same
  /// numbers as a PLY, so their points are checked as that PLY.
  Status check() {
    if (!options_.check) return {};
    progress_.update("check", 0);
    Stopwatch stopwatch;
    const bool is_ply = options_.format == MedialFormat::kPly && !options_.mesh_spheres;
    const std::string ply = is_ply ? std::string() : encode_ply(header_, spheres_, false);
    const Result<MedialFile> written = decode_ply(is_ply ? files_[points_file_].bytes : ply, options_.output);
    if (!written) return Error{ErrorCode::kInternal, "what was written cannot be read: " + written.error().message};
    const MedialHeader& header = written.value().header;
    const VoxelGrid grid = {header.grid_origin, header.voxel_size, record_.grid.size};
    record_.check = check_medial_spheres(mesh_, grid, written.value().spheres, header.epsilon, header.object_angle,
                                         header.radius_threshold);
    for (CheckLine& line : check_sheets(written.value().spheres, !record_.removal)) {
      record_.check->lines.push_back(std::move(line));
    }
    record_.host_times.push_back({"check", stopwatch.lap()});
    progress_.clear();
    return {};
  }

  Status draw() {
    if (options_.picture.empty()) return {};
    progress_.update("picture", 0);
    Stopwatch stopwatch;
    PictureOptions look = options_.look;
    look.least_angle = options_.parameters.object_angle;
    DrawnPicture drawn =
        draw_picture(mesh_.mesh, spheres_, record_.grid.voxel_size, look, record_.device ? &*record_.device : nullptr);
    Result<std::string> png = encode_png(drawn.picture);
    if (!png) return png.error();
    record_.picture_drawn_by = std::move(drawn.drawn_by);
    files_.push_back({options_.picture, std::move(png).value()});
    record_.host_times.push_back({"picture", stopwatch.lap()});
    return {};
  }

  void make_page() {
    if (options_.html.empty()) return;
    progress_.update("page", 0);
    Stopwatch stopwatch;
    files_.push_back({options_.html, encode_page(mesh_.mesh, spheres_, record_, options_.look.view.up)});
    record_.host_times.push_back({"page", stopwatch.lap()});
  }

  void encode_report() {
    if (!options_.report.empty()) files_.push_back({options_.report, report_json(record_)});
  }

  bool standard_output_taken() const {
    return std::ranges::any_of(files_, [](const OutputFile& file) { return file.path == "-"; });
  }

  /// All is done, and the process ends: the operating system takes the device back sooner than its driver would.
  void leave_device() {
    if (!context_ || kIsSanitized) return;
    context_->close_programs();
    alignas(Context) static std::byte left[sizeof(Context)];  // is never destroyed
    new (left) Context(std::move(*context_));
    context_.reset();
  }

  Status conclude() {
    if (!options_.quiet) print_message(summary(record_, files_));
    if (options_.verbose) print_message(details(record_));
    if (!record_.check) return {};
    const std::string table = check_table(*record_.check);
    if (standard_output_taken()) {
      print_message(table);
    } else if (Status status = print_result(table); !status) {
      return status;
    }
    return verdict(*record_.check);
  }

  const Options& options_;
  Progress progress_;
  PreparedMesh mesh_;
  std::optional<MeshIndex> index_;
  DeviceOpening opening_;
  std::optional<Context> context_;
  std::vector<MedialSphere> spheres_;
  MedialHeader header_;
  std::vector<OutputFile> files_;
  std::size_t points_file_ = 0;  // its place among them
  RunRecord record_;
};

Status run_action(const Options& options) {
  switch (options.action) {
    case Action::kHelp:
      return print_result(help_text());
    case Action::kVersion:
      return print_result(fmt::format("medial-vk {}\n", version()));
    case Action::kListDevices:
      return list_devices();
    case Action::kExtract:
      break;
  }
  return ExtractionRun(options).run();
}

Status parse_and_run(const std::vector<std::string>& arguments) {
  if (!arguments.empty() && arguments[0] == "spheres") return run_spheres({arguments.begin() + 1, arguments.end()});
  const Result<Options> options = parse_options(arguments);
  if (!options) return options.error();
  return run_action(options.value());
}

}  // namespace

int run(const std::vector<std::string>& arguments) {
  install_interrupt_handlers();
  const char* const command = !arguments.empty() && arguments[0] == "spheres" ? "medial-vk spheres" : "medial-vk";
  try {
    const Status status = parse_and_run(arguments);
    return status ? 0 : report_error(status.error(), command);
  } catch (const std::bad_alloc&) {
    return report_error({ErrorCode::kOutOfMemory, "out of memory; try a lower --resolution"}, command);
  } catch (const std::exception& error) {
    return report_error({ErrorCode::kInternal, fmt::format("internal error: {}", error.what())}, command);
  }
}

}  // namespace medial_vk::cli
