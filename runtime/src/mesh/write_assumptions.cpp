#include "base/format_text.h"
#include "mesh/inspect_mesh.h"

namespace medial_vk {
namespace {

/// "1 edge", "2 edges".
std::string count_of(std::uint64_t n, const char* one, const char* many) {
  return format_text("{} {}", n, n == 1 ? one : many);
}

std::string faces(std::uint64_t n) { return count_of(n, "face", "faces"); }
std::string edges(std::uint64_t n, const std::string& kind) {
  return format_text("{} {} {}", n, kind, n == 1 ? "edge" : "edges");
}

/// About parts that overlap.
void add_changes_of_boundary(MeshReport& r) {
  const auto add = [&](std::string sentence) { r.assumptions.push_back(std::move(sentence)); };
  if (r.hidden_open_edges > 0) {
    add(format_text("{} inside other parts: filled there.", edges(r.hidden_open_edges, "open")));
  }
  if (r.cut_faces > 0) {
    add(format_text("{} that cross others: cut along the crossings.", faces(r.cut_faces)));
  }
  if (r.inner_faces > 0) {
    add(format_text("{} with the inside on both sides: left out, as they do not bound the solid.",
                    faces(r.inner_faces)));
  }
  if (r.outer_faces > 0) {
    add(format_text("{} outside the solid, of open parts that enclose nothing: left out.", faces(r.outer_faces)));
  }
}

}  // namespace

void write_assumptions(MeshReport& r) {
  const auto add = [&](std::string sentence) { r.assumptions.push_back(std::move(sentence)); };
  if (r.merged_vertices > 0) {
    add(format_text("{} at exactly the same place as another: taken as one.",
                    count_of(r.merged_vertices, "vertex", "vertices")));
  }
  if (r.degenerates_dropped > r.caps_repaired) {
    add(format_text("{} without area: left out.", faces(r.degenerates_dropped - r.caps_repaired)));
  }
  if (r.caps_repaired > 0) {
    add(format_text("{} without area, one corner inside the opposite side: the neighbour there was cut in two instead.",
                    faces(r.caps_repaired)));
  }
  if (r.duplicates_dropped > r.inner_walls_dropped) {
    add(format_text("{} with the same corners as an earlier one: left out.",
                    faces(r.duplicates_dropped - r.inner_walls_dropped)));
  }
  if (r.inner_walls_dropped > 0) {
    add(format_text("{} between two solids that touch: left out, the solids are one.", faces(r.inner_walls_dropped)));
  }
  if (r.fallback_polygons > 0) {
    add(format_text(
        "{} with sides that cross, or too tangled to be cut in time: made a fan of triangles from the first corner.",
        count_of(r.fallback_polygons, "polygon", "polygons")));
  }
  if (r.open_edges > 0) {
    add(format_text("{}: inside is where the winding number is at least 1/2.", edges(r.open_edges, "open")));
  }
  if (r.non_manifold_edges > 0) {
    add(format_text("{} of three or more triangles: normals beside them are not relied on.",
                    edges(r.non_manifold_edges, "non-manifold")));
  }
  if (r.non_manifold_vertices > 0) {
    add(format_text("{} where the surface touches itself: normals around them are not relied on.",
                    count_of(r.non_manifold_vertices, "vertex", "vertices")));
  }
  if (r.inconsistent_edges > 0) {
    add(
        format_text("{} where the two triangles disagree on the outside and turning could not help: inside is where "
                    "the winding number is at least 1/2.",
                    count_of(r.inconsistent_edges, "edge", "edges")));
  }
  if (r.inside_out) {
    add(format_text("The mesh was inside out: all {} were turned over.", faces(r.triangles)));
  }
  if (r.reoriented_components > 0) {
    add(format_text("{} inside out: turned over as a whole.",
                    count_of(r.reoriented_components, "component that was", "components that were")));
  }
  if (r.minority_faces > 0) {
    add(format_text("{} turned over to agree with {} neighbours.", count_of(r.minority_faces, "face was", "faces were"),
                    r.minority_faces == 1 ? "its" : "their"));
  }
  if (r.components > 1) {
    add(format_text("{} components: a point is inside if their winding numbers add up to at least 1/2.", r.components));
  }
  add_changes_of_boundary(r);
  if (r.intersecting_faces > 0) {
    add(format_text("{} that cross or touch others: normals there are not relied on.", faces(r.intersecting_faces)));
  }
  if (!r.intersections_known) {
    add("Too many triangles lie close together to look for all crossings: no normal is relied on.");
  }
  if (!r.sides_known) {
    add("Too many triangles lie close together to examine both sides of each: normals of those left out are not "
        "relied on.");
  }
  if (r.faces_within > 0) {
    add(format_text("{} with the inside on both sides: still counted as surface.", faces(r.faces_within)));
  }
  if (r.faces_without > 0) {
    add(format_text("{} with the outside on both sides: still counted as surface.", faces(r.faces_without)));
  }
}

}  // namespace medial_vk
