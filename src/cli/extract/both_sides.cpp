#include "cli/extract/both_sides.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace medial_vk::cli {
namespace {

template <class T>
void append(std::vector<T>& to, const std::vector<T>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

void add(const std::vector<StageTime>& more, std::vector<StageTime>& times) {
  for (const StageTime& time : more) {
    const auto same = std::ranges::find(times, time.stage, &StageTime::stage);
    if (same == times.end()) {
      times.push_back(time);
    } else {
      same->seconds += time.seconds;
    }
  }
}

void add(const ExtractionCounters& more, ExtractionCounters& counters) {
  for (std::size_t i = 0; i < counters.levels.size() && i < more.levels.size(); ++i) {
    ExtractionCounters::Level& level = counters.levels[i];
    const ExtractionCounters::Level& other = more.levels[i];
    level.visited += other.visited;
    level.kept += other.kept;
    level.contacts += other.contacts;
    level.found += other.found;
    level.lines += other.lines;
    level.triangle_tests += other.triangle_tests;
    level.cluster_tests += other.cluster_tests;
    level.node_tests += other.node_tests;
  }
  counters.found += more.found;
  counters.undecided += more.undecided;
  counters.proved_empty += more.proved_empty;
  counters.queries += more.queries;
  counters.retries += more.retries;
}

void add(const Sheets& more, Sheets& sheets) {
  const auto first = static_cast<std::int32_t>(sheets.sheets.size());
  for (const std::int32_t sheet : more.of_point) sheets.of_point.push_back(sheet + first);
  append(sheets.marks, more.marks);
  append(sheets.areas, more.areas);
  append(sheets.sheets, more.sheets);
  sheets.components += more.components;
  sheets.absorbed_components += more.absorbed_components;
  sheets.absorbed_points += more.absorbed_points;
  sheets.fragments += more.fragments;
  sheets.fragment_points += more.fragment_points;
  sheets.seam_points += more.seam_points;
  sheets.rim_points += more.rim_points;
}

}  // namespace

Analysis joined(Analysis inside, Analysis outside) {
  Analysis both = std::move(inside);
  append(both.spheres, outside.spheres);
  append(both.undecided, outside.undecided);
  both.certificate.passed += outside.certificate.passed;
  both.certificate.rejected += outside.certificate.rejected;
  both.simplified += outside.simplified;
  add(*outside.sheets, *both.sheets);
  for (std::size_t i = 0; i < both.spheres.size(); ++i) both.spheres[i].sheet = both.sheets->of_point[i];
  both.significance.reset();
  add(outside.measurements.counters, both.measurements.counters);
  add(outside.measurements.device_times, both.measurements.device_times);
  add(outside.measurements.host_times, both.measurements.host_times);
  return both;
}

SideRecord record_of(MeshSide side, const Analysis& analysis) {
  SideRecord record = {.side = side,
                       .points = analysis.spheres.size(),
                       .undecided = analysis.undecided.size(),
                       .sheets = analysis.sheets->sheets.size(),
                       .radii = range_of_radii(analysis.spheres),
                       .object_angles = range_of_object_angles(analysis.spheres)};
  for (const Sheet& sheet : analysis.sheets->sheets) record.area += sheet.area;
  if (analysis.significance) record.union_volume = analysis.significance->volume;
  return record;
}

}  // namespace medial_vk::cli
