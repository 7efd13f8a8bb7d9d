#include "cli/plane/load_shape.h"

#include <fmt/format.h>

#include <iterator>
#include <utility>

#include "base/stopwatch.h"
#include "scene_files/read_mesh_file.h"
#include "shape_files/read_shape_file.h"
#include "shape_files/slice_mesh.h"

namespace medial_vk::cli {
namespace {

/// What both ways of reading give.
struct ReadRings {
  std::vector<PlaneRing> rings;
  FillRule rule = FillRule::kNonZero;
};

Result<ReadRings> read_slice(const PlaneCommandOptions& options, PlaneRecord& record) {
  const Result<SlicePlane> plane = parse_slice_plane(options.slice);
  if (!plane) return plane.error();
  const Result<Mesh> mesh = read_mesh_file(options.shape);
  if (!mesh) return mesh.error();
  Result<MeshSlice> slice = slice_mesh(mesh.value(), plane.value());
  if (!slice) return Error{slice.error().code, fmt::format("{}: {}", options.shape, slice.error().message)};
  record.format = fmt::format("slice at {} = {:.6g}", "xyz"[plane.value().axis], slice.value().height);
  record.assumptions = std::move(slice.value().assumptions);
  return ReadRings{std::move(slice.value().rings), options.fill.value_or(FillRule::kNonZero)};
}

Result<ReadRings> read_rings(const PlaneCommandOptions& options, const std::stop_token& stop, PlaneRecord& record) {
  if (!options.slice.empty()) return read_slice(options, record);
  ShapeFileOptions reading;
  if (options.flatness.value > 0) reading.flatness = options.flatness.value;
  reading.fill_rule = options.fill;
  reading.threads = options.threads;
  reading.stop = stop;
  Result<ShapeFile> file = read_shape_file(options.shape, reading);
  if (!file) return file.error();
  record.format = name_of_format(file.value().format);
  record.assumptions = std::move(file.value().assumptions);
  record.y_is_down = file.value().y_is_down;
  record.view_box = file.value().view_box;
  return ReadRings{std::move(file.value().rings), file.value().fill_rule};
}

}  // namespace

Status check_slice(const PlaneCommandOptions& options) {
  if (options.slice.empty()) return {};
  const Result<SlicePlane> plane = parse_slice_plane(options.slice);
  if (plane) return {};
  return Error{ErrorCode::kUsage, "--slice: " + plane.error().message};
}

Status load_shape(const PlaneCommandOptions& options, const std::stop_token& stop, PlaneRecord& record,
                  std::vector<StageTime>& times) {
  Stopwatch stopwatch;
  record.input = options.shape;
  Result<ReadRings> read = read_rings(options, stop, record);
  if (!read) return read.error();
  times.push_back({"read", stopwatch.lap()});
  record.fill_rule = read.value().rule;
  Result<PreparedShape> shape = prepare_shape(read.value().rings, read.value().rule, options.threads, stop);
  if (!shape) {
    if (shape.error().code == ErrorCode::kInterrupted) return shape.error();
    return Error{shape.error().code, fmt::format("{}: {}", options.shape, shape.error().message)};
  }
  record.shape = std::move(shape).value();
  const std::vector<std::string>& assumptions = record.shape.report.assumptions;
  record.assumptions.insert(record.assumptions.end(), assumptions.begin(), assumptions.end());
  times.push_back({"prepare", stopwatch.lap()});
  return {};
}

}  // namespace medial_vk::cli
