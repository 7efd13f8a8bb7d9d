// From any triangles to a mesh with a defined inside, and a report of the changes.
#include <algorithm>
#include <cmath>
#include <new>
#include <optional>

#include "base/format_text.h"
#include "base/host_memory.h"
#include "base/point_ops.h"
#include "medial_vk/prepare.h"
#include "mesh/clean_mesh.h"
#include "mesh/crossings/self_intersections.h"
#include "mesh/inspect_mesh.h"
#include "mesh/outer_boundary.h"
#include "mesh/sidedness.h"

namespace medial_vk {
namespace {

Error invalid(std::string message) { return {ErrorCode::kInvalidMesh, std::move(message)}; }

/// Limit of a coordinate: areas, and the test for zero area, use products of two lengths, and their squares.
constexpr double kLargest = 1e70;
/// Limit of a coordinate, over the longest side: rounding a centre to a double then moves it by 2e-7 of that side at
/// most, a tenth of the allowance of the certificate.
constexpr double kFarthest = 0x1p30;

Status check_input(const Mesh& mesh) {
  constexpr std::size_t kMostTriangles = 0xffffffffu / 3;  // corners are numbered with 32 bits
  if (mesh.triangles.empty()) return invalid("the mesh has no triangles");
  if (mesh.triangles.size() > kMostTriangles || mesh.vertices.size() >= 0xffffffffu) {
    return invalid(format_text("the mesh has {} vertices and {} triangles, more than 32-bit indices reach",
                               mesh.vertices.size(), mesh.triangles.size()));
  }
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    for (const double x : mesh.vertices[i]) {
      if (!std::isfinite(x)) return invalid(format_text("vertex {} has the coordinate {}", i, x));
    }
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (const std::uint32_t v : mesh.triangles[i]) {
      if (v >= mesh.vertices.size()) {
        return invalid(format_text("face {} uses vertex {} of {}", i, v, mesh.vertices.size()));
      }
      for (const double x : mesh.vertices[v]) {
        if (!(std::fabs(x) <= kLargest)) {
          return invalid(format_text("vertex {} has the coordinate {:g}; up to {:g} can be handled", v, x, kLargest));
        }
      }
    }
  }
  return {};
}

/// The longest term that is computed is of the fifth power of a length (the moments of WindingTree); with the extent in
/// this range, and features down to 1e-11 of it, none over- or underflows.
Status check_extent(const MeshReport& report) {
  double longest = 0;
  for (int k = 0; k < 3; ++k) longest = std::max(longest, report.upper[k] - report.lower[k]);
  if (!(longest >= 1e-50 && longest <= 1e50)) {
    return invalid(format_text("the mesh is {:g} units long; 1e-50 to 1e50 can be handled", longest));
  }
  double farthest = 0;
  for (int k = 0; k < 3; ++k) farthest = std::max({farthest, std::fabs(report.lower[k]), std::fabs(report.upper[k])});
  if (farthest <= kFarthest * longest) return {};
  return invalid(
      format_text("the mesh is {:g} units long and lies {:g} from the origin, where its points can hardly be "
                  "distinguished (double precision); move it closer",
                  longest, farthest));
}

/// Greatest error in radians of a trusted normal: far below the relevant angles, far above the rounding of a triangle
/// of ordinary shape.
constexpr double kNormalAccuracy = 1e-7;

bool has_accurate_normal(const Mesh& mesh, const Triangle& t) {
  double shorter = 0;
  const Point area = double_area(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], shorter);
  return length(area) * kNormalAccuracy > kAreaRounding * shorter;
}

void set_flags(PreparedMesh& prepared, const std::vector<bool>& regular, const SelfIntersections& intersections,
               const Sidedness& sides) {
  MeshReport& report = prepared.report;
  // Where the sides are not certain, no normal is trusted.
  const float margin = report.closed ? 0.0f : kSideError;
  prepared.flags.assign(prepared.mesh.triangles.size(), 0);
  for (std::size_t i = 0; i < prepared.flags.size(); ++i) {
    const float beside = sides.beside[i];
    if (beside >= 1) ++report.faces_within;
    if (beside < -margin) ++report.faces_without;
    const Triangle& t = prepared.mesh.triangles[i];
    if (!intersections.known || intersections.crossed[i]) continue;
    prepared.flags[i] = kUncrossed;
    if (!regular[t[0]] || !regular[t[1]] || !regular[t[2]]) continue;
    if (!(beside >= margin && beside < 1 - margin) || !has_accurate_normal(prepared.mesh, t)) continue;
    prepared.flags[i] |= kTrustedNormal;
    ++report.trusted_triangles;
  }
}

/// Refuses only a mesh that certainly encloses nothing.
Status check_enclosure(const MeshReport& report, const Volumes& volumes, const Sidedness& sides) {
  if (report.closed) {
    if (volumes.parts > volumes.parts_rounding) return {};
    return invalid("the mesh encloses nothing: it is closed, but its volume is 0");
  }
  if (!sides.known) return {};
  for (const float beside : sides.beside) {
    if (beside > kEncloses) return {};
  }
  return invalid(format_text(
      "the mesh encloses nothing: with {} open edges, the winding number reaches 1/2 behind none of its {} triangles",
      report.open_edges, report.triangles));
}

/// The report of a mesh and of its boundary: counts of the file are those of the mesh, all others of the boundary.
void carry_over(const MeshReport& before, const OuterBoundary& boundary, MeshReport& report) {
  report.cut_faces = boundary.cut_triangles;
  report.inner_faces = boundary.inner_triangles;
  report.outer_faces = boundary.outer_triangles;
  report.hidden_open_edges = boundary.hidden_open_edges;
  report.merged_vertices = before.merged_vertices;
  report.unused_vertices = before.unused_vertices;
  report.fallback_polygons = before.fallback_polygons;
  report.degenerates_dropped = before.degenerates_dropped;
  report.caps_repaired = before.caps_repaired;
  report.duplicates_dropped = before.duplicates_dropped;
  report.inner_walls_dropped = before.inner_walls_dropped;
  report.reoriented_faces += before.reoriented_faces;
  report.minority_faces += before.minority_faces;
  report.reoriented_components += before.reoriented_components;
  report.inside_out = report.inside_out || before.inside_out;
  report.assumptions.clear();
  write_assumptions(report);
}

/// Maps of input indices through the boundary.
void join_maps(const PreparedMesh& before, const OuterBoundary& boundary, PreparedMesh& prepared) {
  std::vector<std::uint32_t> vertex_of_input = before.vertex_of_input;
  for (std::uint32_t& v : vertex_of_input) {
    if (v != PreparedMesh::kDropped) v = prepared.vertex_of_input[v];
  }
  prepared.vertex_of_input = std::move(vertex_of_input);
  for (std::uint32_t& t : prepared.input_of_triangle) t = before.input_of_triangle[boundary.source[t]];
}

Result<PreparedMesh> prepare(Mesh mesh, const PrepareOptions& options);

/// Prepares the boundary of a prepared mesh, if it has triangles that do not bound the solid. No value: it has none.
std::optional<Result<PreparedMesh>> prepare_boundary(const PreparedMesh& whole, const SurfaceParts& parts,
                                                     const TriangleTree& tree, const SelfIntersections& intersections,
                                                     const PrepareOptions& options) {
  OuterBoundary boundary = find_outer_boundary(whole.mesh, parts.component_of, tree, intersections, options);
  if (boundary.inner_triangles + boundary.outer_triangles == 0 || boundary.mesh.triangles.empty()) return std::nullopt;
  Result<PreparedMesh> prepared =
      prepare(std::move(boundary.mesh), {.keep_inner_faces = true, .threads = options.threads});
  if (!prepared) return std::nullopt;
  carry_over(whole.report, boundary, prepared.value().report);
  join_maps(whole, boundary, prepared.value());
  return prepared;
}

Result<PreparedMesh> prepare(Mesh mesh, const PrepareOptions& options) {
  const unsigned threads = options.threads;
  if (const Status status = check_input(mesh); !status) return status.error();
  PreparedMesh prepared;
  const std::size_t given = mesh.triangles.size();
  prepared.mesh = std::move(mesh);
  clean_mesh(prepared);
  Mesh& clean = prepared.mesh;
  MeshReport& report = prepared.report;
  if (clean.triangles.empty()) return invalid(format_text("no triangle has an area (of {})", given));
  report.vertices = clean.vertices.size();
  report.triangles = clean.triangles.size();
  measure_box(clean, report);
  if (const Status status = check_extent(report); !status) return status.error();

  MeshTopology topology(clean);
  const SurfaceParts parts = find_parts(clean, topology);
  report.components = parts.components;
  report.minority_faces = make_patches_consistent(clean, topology);
  std::vector<bool> regular = inspect_topology(clean, topology, report);
  Point centre;
  for (int k = 0; k < 3; ++k) centre[k] = report.lower[k] + (report.upper[k] - report.lower[k]) / 2;
  Volumes volumes = measure_volumes(clean, parts, centre);
  if (report.closed && volumes.whole < 0) {
    for (std::uint32_t t = 0; t < clean.triangles.size(); ++t) turn_triangle(clean, topology, t);
    report.inside_out = true;
  }

  TriangleTree tree(clean);
  const SelfIntersections intersections = find_self_intersections(clean, tree, threads);
  report.intersecting_faces = intersections.count;
  report.intersections_known = intersections.known;
  const Sidedness sides = decide_sides(clean, topology, tree, parts, report.closed, intersections, threads);
  report.sides_known = sides.known;
  report.reoriented_components = sides.turned_components;
  report.reoriented_faces =
      report.minority_faces + sides.turned_faces + (report.inside_out ? report.triangles : std::uint64_t{0});

  if (sides.turned_faces > 0) regular = inspect_topology(clean, topology, report);
  if (sides.turned_faces > 0 || report.inside_out) volumes = measure_volumes(clean, parts, centre);
  report.signed_volume = volumes.whole;
  if (const Status status = check_enclosure(report, volumes, sides); !status) return status.error();
  set_flags(prepared, regular, intersections, sides);
  write_assumptions(report);
  const bool may_overlap = intersections.known && (intersections.count > 0 || report.faces_within > 0);
  if (may_overlap && !options.keep_inner_faces) {
    if (auto boundary = prepare_boundary(prepared, parts, tree, intersections, options)) return std::move(*boundary);
  }
  return prepared;
}

}  // namespace

Result<PreparedMesh> prepare_mesh(Mesh mesh, const PrepareOptions& options) {
  try {
    return prepare(std::move(mesh), options);
  } catch (const std::bad_alloc&) {
    return out_of_memory("preparing the mesh");
  }
}

}  // namespace medial_vk
