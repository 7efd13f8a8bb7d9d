#include "cli/extract/mesh_run.h"

#include <algorithm>
#include <iterator>
#include <stop_token>
#include <string_view>
#include <utility>
#include <vector>

#include "base/stopwatch.h"
#include "check_reports/check_sheets.h"
#include "cli/extract/both_sides.h"
#include "cli/extract/summary.h"
#include "cli/extract/wall_run.h"
#include "cli/options/measures.h"
#include "cli/shared/load.h"
#include "cli/shared/reference_with_estimate.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/messages.h"
#include "common/file_extension.h"
#include "output/charts_and_tables/ball_volumes.h"
#include "output/charts_and_tables/volume_curve.h"
#include "output/extraction_report/report_json.h"
#include "output/medial_formats/encode_medial_mesh.h"
#include "output/medial_formats/encode_points.h"
#include "output/page/page.h"
#include "output/picture/boundary_picture.h"
#include "output/picture/picture.h"
#include "reference_bridge/check_balls.h"

namespace medial_vk::cli {
namespace {

AnalysisOptions analysis_options(const Options& options) {
  AnalysisOptions out;
  out.extraction = options.extraction;
  out.sheets = options.sheets;
  out.sheets->areas = false;  // unless volumes are measured
  out.simplify = options.simplify;
  out.volumes = options.volumes || !options.ball_volumes.empty() || !options.report.empty() || !options.html.empty();
  out.keep_volume = options.keep_volume;
  out.keep_topology = options.keep_topology;
  out.removal_orders = !options.sheet_curve.empty();
  out.medial_mesh = !options.medial_mesh.empty();
  out.threads = options.threads;
  return out;
}

}  // namespace

MeshRun::MeshRun(Options options, std::string part, SharedOfRun& shared)
    : options_(std::move(options)), shared_(shared) {
  record_.input = options_.mesh;
  record_.part = std::move(part);
  record_.output = options_.output;
  record_.options = options_.extraction;
  record_.backend = options_.backend;
  record_.seed = options_.seed;
  record_.perturb = options_.perturb;
  record_.simplify = options_.simplify;
  record_.keep_inner_faces = options_.keep_inner_faces;
}

Status MeshRun::load(Mesh mesh) {
  shared_.progress.update("prepare", 0);
  record_.host_times = shared_.times;
  Result<PreparedMesh> prepared = prepare_loaded(std::move(mesh), options_, shared_.opening, record_.host_times);
  shared_.progress.clear();
  if (!prepared) return prepared.error();
  record_.mesh = prepared.value().report;
  if (options_.needs_walls() && !record_.mesh.closed) {
    return Error{ErrorCode::kInvalidMesh, "the mesh has open edges: the least wall, or gap, is that of a closed one"};
  }
  return index(std::move(prepared).value());
}

Status MeshRun::index(PreparedMesh mesh) {
  const EndAtOnce guard;
  if (interrupted()) return stopped();
  Stopwatch stopwatch;
  const unsigned threads = shared_.opening.threads_beside(mesh.mesh.triangles.size(), options_.threads);
  Result<IndexedMesh> made = IndexedMesh::build(std::move(mesh), {.threads = threads});
  if (!made) return with_hint(made.error());
  mesh_.emplace(std::move(made).value());
  record_.longest_side = mesh_->longest_side();
  if (Status status = choose_sides(threads); !status) return status;
  index_seconds_ = stopwatch.lap();
  if (reports_index()) record_.host_times.push_back({"index", index_seconds_});
  return {};
}

/// Both sides have one grid, since their boxes are the same.
Status MeshRun::choose_sides(unsigned threads) {
  const double margin = options_.margin ? options_.margin->of(mesh_->longest_side()) : 0;
  for (const MeshSide side : {MeshSide::kInside, MeshSide::kOutside}) {
    if (!(side == MeshSide::kInside ? options_.searches_inside() : options_.searches_outside())) continue;
    if (!options_.searches_outside()) {
      searched_.push_back(*mesh_);
      continue;
    }
    Result<IndexedMesh> made = mesh_->on_side({side, margin, threads});
    if (!made) return with_hint(made.error());
    searched_.push_back(std::move(made).value());
  }
  const IndexedMesh& searched = searched_.back();
  record_.search = {options_.searches_inside(), options_.searches_outside(), searched.margin(),
                    searched.region_lower(),    searched.region_upper(),     searched.longest_side()};
  return {};
}

/// In other runs only the certificate reads the index, and its time counts as part of the extraction.
bool MeshRun::reports_index() const {
  return options_.backend == Backend::kVulkan && options_.extraction.mode == Mode::kCertified;
}

Status MeshRun::take_device() {
  Status status = shared_.opening.take(shared_.context, shared_.device, record_.host_times);
  record_.device = shared_.device;
  return status;
}

std::string MeshRun::opening_line() const { return opening(record_); }

/// While a device computes, a signal requests a stop; afterwards it may end the program at once.
Result<Analysis> MeshRun::analyse_side(const IndexedMesh& mesh, const Extractor& extractor) {
  std::optional<EndAtOnce> on_host;
  std::stop_source stop;
  const StageProgress on_progress = [&](const char* stage, double done) {
    const bool searches = std::string_view(stage) == "extract" || std::string_view(stage) == "certify";
    if (!searches && !on_host) on_host.emplace();
    shared_.progress.update(stage, done);
    if (interrupted()) stop.request_stop();
  };
  Result<Analysis> made = analyse(mesh, analysis_options(options_), extractor, on_progress, stop.get_token());
  shared_.progress.clear();
  if (made) return made;
  return made.error().code == ErrorCode::kInterrupted ? stopped() : with_hint(made.error());
}

Status MeshRun::analyse_mesh() {
  const Extractor extractor = options_.backend == Backend::kCpu ? reference_with_estimate(shared_.progress)
                                                                : device_extractor(*shared_.context);
  for (const IndexedMesh& mesh : searched_) {
    Result<Analysis> made = analyse_side(mesh, extractor);
    if (!made) return made.error();
    const bool is_first = &mesh == searched_.data();
    if (mesh.side() == MeshSide::kInside) {
      record_.search.inside_points = made.value().spheres.size();
      record_.search.inside_sheets = made.value().sheets->sheets.size();
    }
    if (record_.search.outside) record_.search.sides.push_back(record_of(mesh.side(), made.value()));
    if (made.value().significance) {
      (is_first ? record_.ball_union : record_.outside_union) = record_union(*made.value().significance);
    }
    analysis_ = is_first ? std::move(made).value() : joined(std::move(analysis_), std::move(made).value());
  }
  describe();
  return {};
}

void MeshRun::describe() {
  record_analysis(analysis_, record_);
  record_.sheet_options = options_.sheets;
  record_.orders_end_at = options_.sheet_curve.empty() ? options_.keep_volume : 0;
  record_.keep_volume = options_.keep_volume;
  record_.keep_topology = options_.keep_volume > 0 && options_.keep_topology;
  for (StageTime& time : analysis_.measurements.host_times) {
    if (time.stage == "extract" && !reports_index()) time.seconds += index_seconds_;
    (time.stage == "medial mesh" ? medial_mesh_times_ : record_.host_times).push_back(std::move(time));
  }
}

Status MeshRun::measure() {
  if (!measures_of(options_).any() && !options_.needs_walls()) return {};
  const EndAtOnce guard;
  if (interrupted()) return stopped();
  Result<MeasuredBoundary> made = measure_boundary(*mesh_, spheres_inside(), record_.grid.voxel_size, options_,
                                                   shared_.progress, record_.host_times);
  shared_.progress.clear();
  if (!made) return made.error();
  boundary_ = std::move(made).value();
  Result<std::vector<WallRecord>> compared = measure_walls(*mesh_, options_, shared_.progress, record_.host_times);
  shared_.progress.clear();
  if (!compared) return compared.error();
  boundary_.record.walls = std::move(compared).value();
  record_.boundary = boundary_.record;
  return {};
}

std::span<const MedialSphere> MeshRun::spheres_inside() const {
  const std::span<const MedialSphere> all = analysis_.spheres;
  return record_.search.outside ? all.first(record_.search.inside_points) : all;
}

/// Files are made in memory: until they are written a signal may end the program. These steps do not test for one.
Status MeshRun::make_files() {
  const EndAtOnce guard;
  if (interrupted()) return stopped();
  if (Status status = measure_fat(); !status) return status;
  encode_volumes();
  if (Status status = encode(); !status) return status;
  if (Status status = encode_boundary(); !status) return status;
  if (Status status = check(); !status) return status;
  if (Status status = draw(); !status) return status;
  make_page();
  encode_mesh();
  encode_report();
  mesh_.reset();
  searched_.clear();
  analysis_ = Analysis();
  boundary_ = MeasuredBoundary();
  return {};
}

/// For the report, and for the page, which shows it. A solid without an end is not fat or thin (Section 8.3).
Status MeshRun::measure_fat() {
  if ((options_.report.empty() && options_.html.empty()) || record_.search.outside) return {};
  Stopwatch stopwatch;
  Status status = record_fatness(analysis_.spheres, options_.threads, record_);
  if (!status) return status;
  record_.host_times.push_back({"fatness", stopwatch.lap()});
  return {};
}

void MeshRun::encode_volumes() {
  if (!options_.sheet_curve.empty()) {
    const VolumeCurves curves = {*record_.by_significance, *record_.keeping_topology};
    const bool is_drawing = file_extension(options_.sheet_curve) == ".svg";  // standard output gets the table
    files_.push_back({options_.sheet_curve, is_drawing ? encode_curve_svg(curves) : encode_curve_csv(curves)});
  }
  if (!options_.ball_volumes.empty()) {
    files_.push_back({options_.ball_volumes, encode_ball_volumes(*analysis_.significance, analysis_.spheres)});
  }
}

/// The mesh comes last in the report, and is not part of the page.
void MeshRun::encode_mesh() {
  if (!analysis_.medial_mesh) return;
  record_.medial_mesh = analysis_.medial_mesh->topology;
  record_.euler_characteristic = analysis_.euler_characteristic;
  files_.push_back({options_.medial_mesh, encode_medial_mesh(options_.medial_mesh, header_, analysis_.spheres,
                                                             record_.sheets, *analysis_.medial_mesh, options_.ascii)});
  std::ranges::move(medial_mesh_times_, std::back_inserter(record_.host_times));
}

Status MeshRun::encode() {
  header_ = make_header(record_.grid, options_.extraction, record_.search.longest_side);
  if (record_.search.outside) header_.inside_count = record_.search.inside_points;
  Result<std::string> bytes = encode_points(
      {options_.format, options_.ascii, options_.mesh_spheres, options_.gpu_instancing, options_.sphere_detail},
      header_, analysis_.spheres, record_.sheets.marks);
  if (!bytes) return bytes.error();
  points_file_ = files_.size();
  files_.push_back({options_.output, std::move(bytes).value()});
  return {};
}

Status MeshRun::encode_boundary() { return encode_boundary_files(*mesh_, boundary_, options_, files_); }

/// The check reads the numbers as written, back from the bytes of the file. The other formats are made from the same
/// numbers as a PLY, so their points are checked as that PLY.
Status MeshRun::check() {
  if (!options_.check) return {};
  shared_.progress.update("check", 0);
  Stopwatch stopwatch;
  const bool is_ply = options_.format == MedialFormat::kPly && !options_.mesh_spheres;
  const std::string ply = is_ply ? std::string() : encode_ply(header_, analysis_.spheres, false);
  const Result<MedialFile> written = decode_ply(is_ply ? files_[points_file_].bytes : ply, options_.output);
  if (!written) return Error{ErrorCode::kInternal, "what was written cannot be read: " + written.error().message};
  record_.check = CheckReport();
  for (const IndexedMesh& searched : searched_) {
    CheckReport side = check_side(searched, written.value());
    for (CheckLine& line : side.lines) {
      if (searched_.size() > 1) line.condition = std::string(side_name(searched.side())) + ": " + line.condition;
      record_.check->lines.push_back(std::move(line));
    }
  }
  record_.host_times.push_back({"check", stopwatch.lap()});
  shared_.progress.clear();
  return {};
}

CheckReport MeshRun::check_side(const IndexedMesh& searched, const MedialFile& written) const {
  const MedialHeader& header = written.header;
  std::vector<MedialSphere> spheres;
  for (std::size_t i = 0; i < written.spheres.size(); ++i) {
    if (header.side_of(i) != searched.side()) continue;
    spheres.push_back(written.spheres[i]);
    if (searched.side() == MeshSide::kOutside) {
      spheres.back().sheet -= static_cast<std::int32_t>(record_.search.inside_sheets);
    }
  }
  const VoxelGrid grid = {header.grid_origin, header.voxel_size, record_.grid.size};
  CheckReport report =
      check_medial_spheres(searched, grid, spheres, header.epsilon, header.object_angle, header.radius_threshold);
  for (CheckLine& line : check_sheets(spheres, !record_.removal)) report.lines.push_back(std::move(line));
  return report;
}

Status MeshRun::draw() {
  if (options_.picture.empty()) return {};
  shared_.progress.update("picture", 0);
  Stopwatch stopwatch;
  if (options_.look.show == PictureShow::kBoundary) {
    const Picture drawn = draw_boundary(boundary_.surface(*mesh_), boundary_.fields, boundary_colour_of(options_),
                                        options_.strokes, options_.look);
    return add_picture(drawn, "the CPU", stopwatch);
  }
  PictureOptions look = options_.look;
  look.least_angle = options_.extraction.object_angle;
  look.frame_points = record_.search.outside;
  DrawnPicture drawn = draw_picture(mesh_->prepared().mesh, analysis_.spheres, record_.grid.voxel_size, look,
                                    record_.device && !options_.draws_on_host ? &*record_.device : nullptr);
  return add_picture(drawn.picture, std::move(drawn.drawn_by), stopwatch);
}

Status MeshRun::add_picture(const Picture& picture, std::string drawn_by, Stopwatch& stopwatch) {
  Result<std::string> png = encode_png(picture);
  if (!png) return png.error();
  record_.picture_drawn_by = std::move(drawn_by);
  files_.push_back({options_.picture, std::move(png).value()});
  record_.host_times.push_back({"picture", stopwatch.lap()});
  return {};
}

void MeshRun::make_page() {
  if (options_.html.empty()) return;
  shared_.progress.update("page", 0);
  Stopwatch stopwatch;
  const Mesh& mesh = boundary_.surface(*mesh_);
  files_.push_back(
      {options_.html, encode_page(mesh, analysis_.spheres, record_, options_.look.view.up, boundary_.fields)});
  record_.host_times.push_back({"page", stopwatch.lap()});
}

void MeshRun::encode_report() {
  if (!options_.report.empty()) files_.push_back({options_.report, report_json(record_)});
}

}  // namespace medial_vk::cli
