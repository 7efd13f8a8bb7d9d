#include "cli/batch/mesh_row.h"

#include <fmt/format.h>

#include <initializer_list>
#include <string>
#include <string_view>

namespace medial_vk::cli {
namespace {

std::string seconds_of(const RunRecord& record, std::initializer_list<std::string_view> stages) {
  double sum = 0;
  for (const StageTime& time : record.host_times) {
    for (const std::string_view stage : stages) {
      if (time.stage == stage) sum += time.seconds;
    }
  }
  return fmt::format("{:.6f}", sum);
}

void fill_interval(const Bounds& interval, BatchColumn lower, BatchColumn upper, BatchRow& row) {
  row[lower] = fmt::format("{}", interval.lower);
  row[upper] = fmt::format("{}", interval.upper);
}

void fill_boundary(const BoundaryRecord& boundary, BatchRow& row) {
  if (boundary.thickness && !boundary.thickness->intervals.empty()) {
    fill_interval(boundary.thickness->median, BatchColumn::kThicknessLower, BatchColumn::kThicknessUpper, row);
  }
  for (const WallRecord& wall : boundary.walls) {
    const bool is_wall = wall.side == ThicknessSide::kWalls;
    fill_interval(wall.found.diameter, is_wall ? BatchColumn::kLeastWallLower : BatchColumn::kLeastGapLower,
                  is_wall ? BatchColumn::kLeastWallUpper : BatchColumn::kLeastGapUpper, row);
  }
}

}  // namespace

void fill_row(const RunRecord& record, bool has_points, BatchRow& row) {
  row[BatchColumn::kSecondsRead] = seconds_of(record, {"read"});
  if (record.mesh.triangles == 0) return;
  row[BatchColumn::kTriangles] = fmt::format("{}", record.mesh.triangles);
  row[BatchColumn::kClosed] = record.mesh.closed ? "yes" : "no";
  row[BatchColumn::kSecondsPrepare] = seconds_of(record, {"prepare", "perturb", "index"});
  if (record.longest_side > 0) row[BatchColumn::kLongestSide] = fmt::format("{}", record.longest_side);
  if (record.mesh.closed && record.mesh.signed_volume > 0) {
    row[BatchColumn::kVolume] = fmt::format("{}", record.mesh.signed_volume);
  }
  if (record.device) row[BatchColumn::kDevice] = record.device->name;
  if (!has_points) return;
  row[BatchColumn::kPoints] = fmt::format("{}", record.points);
  row[BatchColumn::kSheets] = fmt::format("{}", record.sheets.sheets.size());
  row[BatchColumn::kUndecided] = fmt::format("{}", record.counters.undecided);
  row[BatchColumn::kSecondsSearch] = seconds_of(record, {"extract", "certify"});
  fill_boundary(record.boundary, row);
  if (record.radii) {
    row[BatchColumn::kLeastRadius] = fmt::format("{}", record.radii->least);
    row[BatchColumn::kGreatestRadius] = fmt::format("{}", record.radii->greatest);
  }
  if (record.ball_union) {
    row[BatchColumn::kBallsVolume] = fmt::format("{}", record.ball_union->volume);
    row[BatchColumn::kBallsArea] = fmt::format("{}", record.ball_union->area);
  }
}

}  // namespace medial_vk::cli
