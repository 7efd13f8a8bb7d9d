#include "cli/voronoi/plane_sites.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/stopwatch.h"
#include "cli/terminal/numbers.h"
#include "cli/terminal/tables.h"
#include "medial_vk/plane_centre_line.h"
#include "medial_vk/version.h"
#include "platform/paths.h"
#include "shape_files/read_shape_file.h"

namespace medial_vk::cli {
namespace {

constexpr double kStepOfCurves = 1e-4;  // of the longest side, as of the axis of a shape

std::vector<PlaneRing> rings_as_points(const PreparedShape& shape) {
  std::vector<PlaneRing> rings;
  for (const std::vector<std::uint32_t>& ring : rings_of(shape)) {
    PlaneRing& points = rings.emplace_back();
    for (const std::uint32_t i : ring) points.push_back(shape.points[i]);
  }
  return rings;
}

/// What two boundaries in one arrangement have in common.
std::uint64_t contacts_in(const ShapeReport& report) {
  return report.crossings + report.touching_points + report.inner_segments + report.merged_points;
}

/// The boundaries together must have no more contacts than each has with itself. Equal vertices and equal segments of
/// two shapes are no contacts, but become one: then points or segments are fewer than those of the shapes.
Status check_apart(const std::vector<PreparedShape>& shapes, unsigned threads) {
  std::vector<PlaneRing> all;
  std::uint64_t own = 0;
  std::size_t points = 0, segments = 0;
  for (const PreparedShape& shape : shapes) {
    const std::vector<PlaneRing> rings = rings_as_points(shape);
    const Result<PreparedShape> again = prepare_shape(rings, FillRule::kNonZero, threads);
    if (!again) return again.error();
    own += contacts_in(again.value().report);
    points += again.value().points.size();
    segments += again.value().segments.size();
    all.insert(all.end(), rings.begin(), rings.end());
  }
  const Result<PreparedShape> together = prepare_shape(all, FillRule::kNonZero, threads);
  if (!together) return together.error();
  const bool are_apart = contacts_in(together.value().report) == own && together.value().points.size() == points &&
                         together.value().segments.size() == segments;
  if (are_apart) return {};
  return Error{ErrorCode::kInvalidMesh, "the shapes cross, touch or overlap; sites in the plane must be apart"};
}

void append_shape(const PreparedShape& shape, std::uint32_t site, PlaneSites& sites, ShapeReport& sum) {
  const auto first = static_cast<std::uint32_t>(sites.points.size());
  sites.points.insert(sites.points.end(), shape.points.begin(), shape.points.end());
  sites.site_of_point.resize(sites.points.size(), site);
  for (const auto& [a, b] : shape.segments) sites.segments.push_back({first + a, first + b});
  sites.site_of_segment.resize(sites.segments.size(), site);
  const ShapeReport& report = shape.report;
  if (site == 0) sum.lower = report.lower, sum.upper = report.upper;
  for (std::size_t k = 0; k < 2; ++k) {
    sum.lower[k] = std::min(sum.lower[k], report.lower[k]);
    sum.upper[k] = std::max(sum.upper[k], report.upper[k]);
  }
  sum.rings += report.rings;
  sum.segments += report.segments;
  sum.area += report.area;
  sum.perimeter += report.perimeter;
  sum.tolerance = std::max(sum.tolerance, report.tolerance);
}

/// By the boundary that a ray along x crosses: shapes are apart, but may lie in holes of others. Places at the
/// boundary, up to rounding, are found by their distance.
bool is_in_a_shape(const PlanePoint& p, const PreparedShape& shapes) {
  bool is_inside = false;
  for (const auto& [i, k] : shapes.segments) {
    const PlanePoint &a = shapes.points[i], &b = shapes.points[k];
    if ((a[1] > p[1]) == (b[1] > p[1])) continue;
    const double side = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
    if ((side > 0) == (b[1] > a[1])) is_inside = !is_inside;
  }
  return is_inside;
}

std::string path_words(const PlaneRecord& record) {
  if (!record.path) {
    return fmt::format("none found from {:.6g} to {:.6g} by the links of the roadmap",
                       fmt::join(record.path_ends[0], ","), fmt::join(record.path_ends[1], ","));
  }
  return fmt::format("width {:.6g}, length {:.6g}, {}", record.path->width, record.path->length,
                     counted(record.path->line.size(), "point", "points"));
}

}  // namespace

Result<PlaneSites> load_plane_sites(const VoronoiCommandOptions& options, PlaneRecord& record,
                                    std::vector<StageTime>& times) {
  Stopwatch stopwatch;
  std::vector<PreparedShape> shapes;
  ShapeFileOptions reading;
  reading.threads = options.threads;
  for (const std::string& file : options.files) {
    Result<ShapeFile> read = read_shape_file(file, reading);
    if (!read) return read.error();
    const bool is_first = shapes.empty();
    if (!is_first && read.value().y_is_down != record.y_is_down) {
      return Error{ErrorCode::kInvalidMesh, file + ": its y axis points the other way than that of the first file"};
    }
    record.y_is_down = read.value().y_is_down;
    if (is_first) record.format = name_of_format(read.value().format);
    Result<PreparedShape> shape = prepare_shape(read.value().rings, read.value().fill_rule, options.threads);
    if (!shape) return Error{shape.error().code, fmt::format("{}: {}", file, shape.error().message)};
    for (const auto* const assumptions : {&read.value().assumptions, &shape.value().report.assumptions}) {
      for (const std::string& text : *assumptions) record.assumptions.push_back(fmt::format("{}: {}", file, text));
    }
    record.sites.push_back(platform::stem_of(file));
    record.input += (is_first ? "" : ", ") + file;
    shapes.push_back(std::move(shape).value());
  }
  if (Status status = check_apart(shapes, options.threads); !status) return status.error();
  PlaneSites sites;
  for (std::uint32_t s = 0; s < shapes.size(); ++s) append_shape(shapes[s], s, sites, record.shape.report);
  record.shape.points = sites.points;
  record.shape.segments = sites.segments;
  record.site_of_point = sites.site_of_point;
  record.site_of_segment = sites.site_of_segment;
  times.push_back({"read", stopwatch.lap()});
  return sites;
}

Status find_plane_curves(const PlaneSites& sites, const VoronoiCommandOptions& options,
                         const ProgressCallback& progress, const std::stop_token& stop, PlaneRecord& record) {
  PlaneVoronoiOptions how;
  how.margin = options.margin;
  how.threads = options.threads;
  Result<PlaneAxis> found = find_plane_voronoi(sites, how, progress, stop);
  if (!found) return found.error();
  record.axis = std::move(found).value();
  record.branches_found = record.axis.branches.size();
  record.options.side = PlaneSide::kOutside;
  record.options.object_angle = 0;
  record.options.margin = options.margin;
  record.step = kStepOfCurves * record.shape.report.longest_side();
  record.lines.reserve(record.axis.branches.size());
  for (const AxisBranch& branch : record.axis.branches) {
    record.lines.push_back(sample_branch(record.axis, branch, record.step));
  }
  return {};
}

Status check_plane_ends(const VoronoiCommandOptions& options, const PreparedShape& shapes) {
  if (!options.from) return {};
  for (const auto& [name, end] : {std::pair("`from`", &*options.from), std::pair("`to`", &*options.to)}) {
    if (!is_in_a_shape({(*end)[0], (*end)[1]}, shapes)) continue;
    return Error{ErrorCode::kUsage, std::string(name) + " must be outside of all sites"};
  }
  return {};
}

Status make_plane_roadmap(const PlaneSites& sites, const VoronoiCommandOptions& options, PlaneRecord& record) {
  Result<PlaneRoadmap> roadmap = PlaneRoadmap::build(sites, record.axis, {.threads = options.threads});
  if (!roadmap) return roadmap.error();
  record.roadmap = std::move(roadmap).value();
  if (!options.from) return {};
  record.path_was_sought = true;
  record.path_ends = {PlanePoint{(*options.from)[0], (*options.from)[1]}, {(*options.to)[0], (*options.to)[1]}};
  Result<std::optional<PlanePath>> path = record.roadmap->widest_path(record.path_ends[0], record.path_ends[1]);
  if (!path) return path.error();
  record.path = std::move(path).value();
  return {};
}

std::string plane_sites_summary(const PlaneRecord& record, const std::vector<StageTime>& times, bool verbose) {
  const PlaneCounts counts = counts_of(record);
  std::string text = fmt::format("{}, {}\n", counted(record.sites.size(), "site", "sites"),
                                 counted(record.shape.segments.size(), "segment", "segments"));
  for (const std::string& assumption : record.assumptions) text += labelled("note", assumption);
  text += labelled(
      "curves", fmt::format("{}, {}, {}", counted(counts.branches, "branch", "branches"),
                            counted(counts.junctions, "junction", "junctions"), counted(counts.ends, "end", "ends")));
  text += labelled("length", fmt::format("{:.6g}", counts.length));
  text += labelled("clearance", fmt::format("{:.6g} to {:.6g}", counts.least_radius, counts.greatest_radius));
  text += labelled("epsilon", fmt::format("{:.3g}", record.axis.epsilon));
  if (record.roadmap) {
    text += labelled("roadmap", fmt::format("{}, {}", counted(record.roadmap->links().size(), "link", "links"),
                                            counted(record.roadmap->components(), "component", "components")));
  }
  if (record.path_was_sought) text += labelled("path", path_words(record));
  return text + labelled("time", times_text(times, verbose));
}

std::string plane_sites_report(const PlaneRecord& record, const std::vector<StageTime>& times) {
  const PlaneCounts counts = counts_of(record);
  nlohmann::ordered_json report = {{"version", version()},
                                   {"sites", record.sites},
                                   {"assumptions", record.assumptions},
                                   {"options", {{"margin", record.options.margin}}},
                                   {"segments", record.shape.segments.size()},
                                   {"curves",
                                    {{"branches", counts.branches},
                                     {"junctions", counts.junctions},
                                     {"ends", counts.ends},
                                     {"length", counts.length},
                                     {"least_clearance", counts.least_radius},
                                     {"greatest_clearance", counts.greatest_radius},
                                     {"epsilon", record.axis.epsilon},
                                     {"cells", record.axis.cells}}}};
  if (record.roadmap) {
    report["roadmap"] = {{"links", record.roadmap->links().size()}, {"components", record.roadmap->components()}};
  }
  if (record.path_was_sought) {
    report["path"] = nullptr;
    if (record.path) report["path"] = {{"width", record.path->width}, {"length", record.path->length}};
  }
  for (const StageTime& time : times) report["seconds"][time.stage] = time.seconds;
  return report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace medial_vk::cli
