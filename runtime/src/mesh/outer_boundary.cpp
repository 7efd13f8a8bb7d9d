// Holes that lie inside are filled, crossings are cut, inner patches and membranes are left out, and short edges are
// merged.
#include "mesh/outer_boundary.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/point_ops.h"
#include "mesh/crossings/cut_crossings.h"
#include "mesh/holes.h"
#include "mesh/inspect_mesh.h"
#include "mesh/membranes.h"
#include "mesh/merge_short_edges.h"
#include "mesh/winding/winding_number.h"

namespace medial_vk {
namespace {

/// Triangles of the mesh that have several parts.
std::uint64_t count_cut(const CutMesh& cut, std::size_t triangles) {
  std::uint64_t count = 0;
  for (std::size_t i = 1; i < cut.source.size(); ++i) {
    const bool is_second = cut.source[i] == cut.source[i - 1] && (i == 1 || cut.source[i] != cut.source[i - 2]);
    count += is_second && cut.source[i] < triangles;
  }
  return count;
}

/// The mesh with the fillings of some holes, cut.
struct FilledMesh {
  Holes::Filled whole;
  CutMesh cut;
  bool is_known = false;  // which triangles cross

  FilledMesh(const Mesh& mesh, const CutComponents& components, const Holes& holes, const std::vector<char>& filled,
             unsigned threads)
      : whole(holes.fill(mesh, components.of_triangle, filled)) {
    const TriangleTree tree(whole.mesh);
    const SelfIntersections intersections = find_self_intersections(whole.mesh, tree, threads);
    is_known = intersections.known;
    cut = cut_crossings(whole.mesh, tree, intersections, threads);
  }

  std::size_t first_filling() const { return whole.mesh.triangles.size() - whole.hole_of.size(); }
  CutComponents components(const CutComponents& of_mesh) const {
    return {whole.component_of, of_mesh.is_membrane, of_mesh.keep_outer};
  }
};

/// Opens the holes again whose fillings do not lie inside.
void open_again(const FilledMesh& mesh, const CutComponents& components, std::vector<char>& filled, unsigned threads) {
  const std::vector<char> inside = lie_inside(mesh.cut, mesh.components(components), mesh.first_filling(), threads);
  for (std::size_t t = 0; t < inside.size(); ++t) {
    const std::size_t source = mesh.cut.source[t];
    if (source >= mesh.first_filling() && inside[t] == 0) filled[mesh.whole.hole_of[source - mesh.first_filling()]] = 0;
  }
  if (!mesh.is_known) filled.assign(filled.size(), 0);
}

/// The boundary, if no filling is a part of it.
std::optional<OuterBoundary> boundary_without_fillings(FilledMesh mesh, const CutComponents& components,
                                                       unsigned threads) {
  const std::size_t first = mesh.first_filling();
  const auto of_mesh = [&](std::uint32_t source) { return source < first; };
  const auto parts = std::ranges::count_if(mesh.cut.source, of_mesh);
  const std::uint64_t cut_triangles = count_cut(mesh.cut, first);
  OuterBoundary boundary = leave_out_inner_patches(std::move(mesh.cut), mesh.components(components), threads);
  if (!std::ranges::all_of(boundary.source, of_mesh)) return std::nullopt;
  boundary.cut_triangles = cut_triangles;
  boundary.inner_triangles = static_cast<std::uint64_t>(parts) - boundary.source.size() - boundary.outer_triangles;
  return boundary;
}

/// By hole: whether the winding number is at least kNearlyInside at the middles of its filling. In the plane of a hole
/// that lies inside one other part it is 3/2, and 1/2 outside all parts: such holes are not filled in the first place.
std::vector<char> may_be_hidden(const Mesh& mesh, const Holes& holes, const std::vector<std::uint32_t>& component_of,
                                const TriangleTree& tree) {
  constexpr double kNearlyInside = 0.8;
  std::vector<char> wanted;
  for (std::uint32_t hole = 0; hole < holes.count(); ++hole) wanted.push_back(holes.can_be_filled(hole) ? 1 : 0);
  if (std::ranges::count(wanted, 1) == 0) return wanted;
  const WindingTree winding(tree);
  const Holes::Filled all = holes.fill(mesh, component_of, wanted);
  for (std::size_t i = 0; i < all.hole_of.size(); ++i) {
    Point middle = {0, 0, 0};
    for (const std::uint32_t v : all.mesh.triangles[mesh.triangles.size() + i])
      middle = middle + (1.0 / 3) * all.mesh.vertices[v];
    char& is_wanted = wanted[all.hole_of[i]];
    if (is_wanted != 0 && winding.at(middle) < kNearlyInside) is_wanted = 0;
  }
  return wanted;
}

/// With the fillings of all holes whose fillings then lie inside. No value: there are none. Where one filling stays,
/// others may have been inside only because of it.
std::optional<OuterBoundary> find_boundary_with_fillings(const Mesh& mesh, const CutComponents& components,
                                                         const TriangleTree& tree, unsigned threads) {
  const Holes holes(mesh, components.of_triangle);
  std::vector<char> filled = may_be_hidden(mesh, holes, components.of_triangle, tree);
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds && std::ranges::count(filled, 1) > 0; ++round) {
    const std::vector<char> before = filled;
    FilledMesh whole(mesh, components, holes, filled, threads);
    open_again(whole, components, filled, threads);
    if (filled != before) continue;
    std::optional<OuterBoundary> boundary = boundary_without_fillings(std::move(whole), components, threads);
    for (std::uint32_t hole = 0; boundary && hole < holes.count(); ++hole) {
      if (filled[hole] != 0) boundary->hidden_open_edges += holes.open_edges(hole);
    }
    return boundary;
  }
  return std::nullopt;
}

}  // namespace

OuterBoundary find_outer_boundary(const Mesh& mesh, const std::vector<std::uint32_t>& component_of,
                                  const TriangleTree& tree, const SelfIntersections& intersections,
                                  const PrepareOptions& options) {
  const unsigned threads = options.threads;
  const CutComponents components{component_of, find_membranes(mesh, component_of, intersections.crossed, threads),
                                 options.keep_outer_faces};
  std::optional<OuterBoundary> filled = find_boundary_with_fillings(mesh, components, tree, threads);
  OuterBoundary boundary =
      filled ? std::move(*filled)
             : leave_out_inner_patches(cut_crossings(mesh, tree, intersections, threads), components, threads);
  MeshReport box;
  measure_box(mesh, box);
  merge_short_edges(boundary.mesh, boundary.source, mesh.vertices.size(), kMergedLength * box.longest_side());
  return boundary;
}

}  // namespace medial_vk
