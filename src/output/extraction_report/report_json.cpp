#include "output/extraction_report/report_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

#include <nlohmann/json.hpp>

#include "medial_vk/version.h"
#include "output/extraction_report/boundary_json.h"

namespace medial_vk {
namespace {

using Json = nlohmann::ordered_json;  // Keys keep their order, which is chosen for readers.

/// The number of the layout, raised when a key changes its meaning.
constexpr int kReportFormat = 1;

const char* name_of_search(const SearchRecord& search) {
  if (!search.outside) return "inside";
  return search.inside ? "both" : "outside";
}

Json options_json(const RunRecord& record) {
  const ExtractionOptions& options = record.options;
  const bool thesis = options.mode == Mode::kThesis;
  Json json = {{"mode", thesis ? "thesis" : "certified"},
               {"backend", record.backend == Backend::kCpu ? "cpu" : "vulkan"},
               {"resolution", options.resolution},
               {"object_angle", options.object_angle},
               {"radius", options.radius},
               {"epsilon", options.epsilon},
               {"extra_levels", options.extra_levels},
               {"simplify", record.simplify},
               {"keep_inner_faces", record.keep_inner_faces},
               {"perturb", record.perturb},
               {"seed", record.seed},
               {"side", name_of_search(record.search)},
               {"memory_bytes", options.memory_budget}};
  if (thesis) {
    json["samples"] = options.thesis.samples;
    json["narrow_features"] = options.thesis.narrow_features;
  }
  return json;
}

Json mesh_json(const MeshReport& mesh, double longest_side) {
  return {{"vertices", mesh.vertices},
          {"triangles", mesh.triangles},
          {"components", mesh.components},
          {"closed", mesh.closed},
          {"merged_vertices", mesh.merged_vertices},
          {"unused_vertices", mesh.unused_vertices},
          {"fallback_polygons", mesh.fallback_polygons},
          {"degenerate_dropped", mesh.degenerates_dropped},
          {"caps_repaired", mesh.caps_repaired},
          {"duplicates_dropped", mesh.duplicates_dropped},
          {"inner_walls_dropped", mesh.inner_walls_dropped},
          {"cut_faces", mesh.cut_faces},
          {"inner_faces_left_out", mesh.inner_faces},
          {"outer_faces_left_out", mesh.outer_faces},
          {"hidden_open_edges", mesh.hidden_open_edges},
          {"open_edges", mesh.open_edges},
          {"non_manifold_edges", mesh.non_manifold_edges},
          {"inconsistent_edges", mesh.inconsistent_edges},
          {"non_manifold_vertices", mesh.non_manifold_vertices},
          {"reoriented_faces", mesh.reoriented_faces},
          {"minority_faces", mesh.minority_faces},
          {"reoriented_components", mesh.reoriented_components},
          {"inside_out", mesh.inside_out},
          {"intersecting_faces", mesh.intersecting_faces},
          {"intersections_known", mesh.intersections_known},
          {"faces_within", mesh.faces_within},
          {"faces_without", mesh.faces_without},
          {"sides_known", mesh.sides_known},
          {"trusted_triangles", mesh.trusted_triangles},
          {"signed_volume", mesh.signed_volume},
          {"lower", mesh.lower},
          {"upper", mesh.upper},
          {"longest_side", longest_side},
          {"assumptions", mesh.assumptions}};
}

Json range_json(const std::optional<Range>& range) {
  if (!range) return nullptr;
  return {{"least", range->least}, {"greatest", range->greatest}};
}

Json levels_json(const std::vector<ExtractionCounters::Level>& levels) {
  Json json = Json::array();
  for (const ExtractionCounters::Level& level : levels) {
    json.push_back({{"cell_size", level.cell_size},
                    {"visited", level.visited},
                    {"kept", level.kept},
                    {"contacts", level.contacts},
                    {"found", level.found},
                    {"lines", level.lines},
                    {"triangle_tests", level.triangle_tests},
                    {"cluster_tests", level.cluster_tests},
                    {"node_tests", level.node_tests}});
  }
  return json;
}

// The cost of a medial point, over all levels.
Json per_point_json(const ExtractionCounters& counters) {
  if (counters.found == 0) return nullptr;
  double triangle_tests = 0, cluster_tests = 0, node_tests = 0, lines = 0;
  for (const ExtractionCounters::Level& level : counters.levels) {
    triangle_tests += static_cast<double>(level.triangle_tests);
    cluster_tests += static_cast<double>(level.cluster_tests);
    node_tests += static_cast<double>(level.node_tests);
    lines += static_cast<double>(level.lines);
  }
  const auto points = static_cast<double>(counters.found);
  return {{"queries", static_cast<double>(counters.queries) / points},
          {"triangle_tests", triangle_tests / points},
          {"cluster_tests", cluster_tests / points},
          {"node_tests", node_tests / points},
          {"lines", lines / points},
          {"narrowing_steps", lines * counters.narrowing_steps / points}};
}

Json times_json(const std::vector<StageTime>& times) {
  Json json = Json::array();
  for (const StageTime& time : times) json.push_back({{"stage", time.stage}, {"seconds", time.seconds}});
  return json;
}

Json device_json(const std::optional<DeviceDescription>& device) {
  if (!device) return nullptr;
  return {{"index", device->index},
          {"name", device->name},
          {"type", device->type},
          {"driver", device->driver},
          {"api_version", device->api_version},
          {"memory_bytes", device->memory_bytes}};
}

/// Where the outside was searched.
Json region_json(const RunRecord& record) {
  const SearchRecord& search = record.search;
  if (!search.outside) return nullptr;
  return {{"margin", search.margin},
          {"lower", search.lower},
          {"upper", search.upper},
          {"longest_side", search.longest_side},
          {"inside_points", search.inside_points},
          {"outside_points", record.points - search.inside_points}};
}

/// The sums of each side; both are in the same grid.
Json sides_json(const SearchRecord& search) {
  if (search.sides.empty()) return nullptr;
  Json json = Json::array();
  for (const SideRecord& side : search.sides) {
    json.push_back({{"side", side.side == MeshSide::kInside ? "inside" : "outside"},
                    {"points", side.points},
                    {"sheets", side.sheets},
                    {"area", side.area},
                    {"union_volume", side.union_volume ? Json(*side.union_volume) : Json(nullptr)},
                    {"radius", range_json(side.radii)},
                    {"object_angle", range_json(side.object_angles)},
                    {"undecided", side.undecided}});
  }
  return json;
}

/// Ranks by sheet of one side: 1 for the most significant. Ties go to the smaller number.
std::vector<std::size_t> ranks_of(std::span<const Sheet> sheets) {
  std::vector<std::size_t> order(sheets.size()), ranks(sheets.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater<>(),
                           [&](std::size_t id) { return sheets[id].significance.value_or(0); });
  for (std::size_t n = 0; n < order.size(); ++n) ranks[order[n]] = n + 1;
  return ranks;
}

Json sheets_json(const Sheets& sheets, const SearchRecord& search) {
  Json json = Json::array();
  const std::span<const Sheet> all = sheets.sheets;
  std::vector<std::size_t> ranks = ranks_of(all.first(search.outside ? search.inside_sheets : all.size()));
  const std::vector<std::size_t> outside = ranks_of(all.subspan(ranks.size()));
  ranks.insert(ranks.end(), outside.begin(), outside.end());
  for (std::size_t id = 0; id < sheets.sheets.size(); ++id) {
    const Sheet& sheet = sheets.sheets[id];
    json.push_back({{"id", id},
                    {"points", sheet.points},
                    {"area", sheet.area},
                    {"mean_radius", sheet.mean_radius},
                    {"mean_object_angle", sheet.mean_object_angle},
                    {"significance", sheet.significance ? Json(*sheet.significance) : Json(nullptr)},
                    {"rank", sheet.significance ? Json(ranks[id]) : Json(nullptr)}});
    if (search.outside) json.back()["side"] = id < search.inside_sheets ? "inside" : "outside";
  }
  return json;
}

Json union_json(const std::optional<UnionRecord>& ball_union) {
  if (!ball_union) return nullptr;
  const BettiNumbers& topology = ball_union->topology;
  return {{"volume", ball_union->volume},      {"area", ball_union->area},
          {"components", topology.components}, {"leading_components", ball_union->leading_components},
          {"tunnels", topology.tunnels},       {"cavities", topology.cavities}};
}

Json removal_json(const RunRecord& record) {
  if (!record.removal) return nullptr;
  const SheetRemoval& removal = *record.removal;
  return {{"keep_volume", record.keep_volume},
          {"keep_topology", record.keep_topology},
          {"kept", removal.kept},
          {"removed", removal.sheets},
          {"volume_left", removal.volume_left}};
}

Json order_json(const std::optional<SheetRemoval>& removal) {
  if (!removal) return nullptr;
  return {{"kept", removal->kept}, {"removed", removal->sheets}, {"volume_left", removal->volume_left}};
}

Json orders_json(const RunRecord& record) {
  if (!record.by_significance && !record.keeping_topology) return nullptr;
  return {{"least_volume", record.orders_end_at},
          {"significance", order_json(record.by_significance)},
          {"topology", order_json(record.keeping_topology)}};
}

Json grouping_json(const SheetOptions& options, const Sheets& sheets) {
  return {{"sheet_angle", options.angle},
          {"sheet_crease", options.crease},
          {"sheet_border", options.border},
          {"sheet_width", options.width},
          {"absorb_fragments", options.absorb_fragments},
          {"pieces", sheets.components},
          {"absorbed", {{"pieces", sheets.absorbed_components}, {"points", sheets.absorbed_points}}},
          {"fragments",
           {{"points_below", kFragmentPoints}, {"sheets", sheets.fragments}, {"points", sheets.fragment_points}}},
          {"seam_points", sheets.seam_points},
          {"rim_points", sheets.rim_points}};
}

Json medial_mesh_json(const RunRecord& record) {
  if (!record.medial_mesh) return nullptr;
  const MedialTopology& topology = *record.medial_mesh;
  const Json solid_euler = record.euler_characteristic ? Json(*record.euler_characteristic) : Json(nullptr);
  return {{"components", topology.betti.components},
          {"tunnels", topology.betti.tunnels},
          {"cavities", topology.betti.cavities},
          {"euler_characteristic", topology.euler_characteristic},
          {"boundary_edges", topology.boundary_edges},
          {"non_manifold_edges", topology.non_manifold_edges},
          {"bare_edges", topology.bare_edges},
          {"hosted_points", topology.hosted_points},
          {"solid", {{"surface_components", record.mesh.components}, {"euler_characteristic", solid_euler}}}};
}

Json fatness_json(const RunRecord& record) {
  if (!record.fatness) return nullptr;
  Json angles = Json::array();
  for (const Fatness& fatness : record.fatness->of_angles) {
    const double resolution = std::ceil(record.longest_side / fatness.largest_voxel);
    angles.push_back({{"object_angle", fatness.object_angle},
                      {"points", fatness.spheres},
                      {"least_radius", fatness.least_radius},
                      {"largest_voxel", fatness.largest_voxel},
                      {"resolution", resolution < 1e15 ? Json(static_cast<std::uint64_t>(resolution)) : Json(nullptr)},
                      {"components", fatness.components},
                      {"proves_connected", fatness.proves_connected}});
  }
  Json proved = nullptr;
  if (const double radius = record.fatness->proved_radius; radius > 0) {
    // The factor is for the rounding of the product.
    proved = {{"object_angle", record.options.object_angle},
              {"least_radius", radius},
              {"largest_voxel", radius * std::numbers::inv_sqrt3 * (1 - 0x1p-50)}};
  }
  return {{"proved", proved}, {"angles", angles}};
}

Json check_json(const std::optional<CheckReport>& check) {
  if (!check) return nullptr;
  Json lines = Json::array();
  for (const CheckLine& line : check->lines) {
    lines.push_back({{"condition", line.condition},
                     {"tested", line.tested},
                     {"failed", line.failed},
                     {"worst", line.worst},
                     {"unit", line.unit},
                     {"first_failure", line.first_failure}});
  }
  return {{"passed", check->passed()}, {"conditions", lines}};
}

/// The number of undecided voxels of each kind, and the largest width that one may hide.
Json undecided_json(const std::vector<UndecidedVoxel>& undecided) {
  std::array<std::uint64_t, kUndecidedKinds> counts{};
  float width = 0;
  for (const UndecidedVoxel& voxel : undecided) {
    ++counts[static_cast<std::size_t>(voxel.kind)];
    width = std::max(width, voxel.width);
  }
  return {{"near_face", counts[static_cast<std::size_t>(UndecidedKind::kNearFace)]},
          {"near_angle", counts[static_cast<std::size_t>(UndecidedKind::kNearAngle)]},
          {"boundary", counts[static_cast<std::size_t>(UndecidedKind::kBoundary)]},
          {"other", counts[static_cast<std::size_t>(UndecidedKind::kOther)]},
          {"greatest_width", width}};
}

}  // namespace

std::string report_json(const RunRecord& record) {
  Json json = {
      {"format", kReportFormat},
      {"program", "medial-vk"},
      {"version", version()},
      {"input", record.input},
      {"output", record.output},
      {"parameters", options_json(record)},
      {"mesh", mesh_json(record.mesh, record.longest_side)},
      {"grid", {{"origin", record.grid.origin}, {"voxel_size", record.grid.voxel_size}, {"size", record.grid.size}}},
      {"region", region_json(record)},
      {"sides", sides_json(record.search)},
      {"voxels",
       {{"found", record.counters.found},
        {"undecided", record.counters.undecided},
        {"undecided_kinds", undecided_json(record.undecided)},
        {"proved_empty", record.counters.proved_empty},
        {"rejected", record.certify.rejected}}},
      {"levels", levels_json(record.counters.levels)},
      {"queries", record.counters.queries},
      {"narrowing_steps", record.counters.narrowing_steps},
      {"per_point", per_point_json(record.counters)},
      {"retries", record.counters.retries},
      {"points",
       {{"written", record.points},
        {"simplified_away", record.simplified},
        {"radius", range_json(record.radii)},
        {"object_angle", range_json(record.object_angles)}}},
      {"sheets", sheets_json(record.sheets, record.search)},
      {"union", union_json(record.ball_union)},
      {"outside_union", union_json(record.outside_union)},
      {"fatness", fatness_json(record)},
      {"removal", removal_json(record)},
      {"orders", orders_json(record)},
      {"grouping", grouping_json(record.sheet_options, record.sheets)},
      {"medial_mesh", medial_mesh_json(record)},
      {"boundary", boundary_json(record.boundary)},
      {"seconds", {{"host", times_json(record.host_times)}, {"device", times_json(record.device_times)}}},
      {"device", device_json(record.device)},
      {"certificate", check_json(record.check)}};
  if (!record.part.empty()) json["part"] = record.part;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace medial_vk
