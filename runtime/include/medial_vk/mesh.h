// A triangle mesh in memory, and its report. Readers fill the mesh; prepare_mesh() drops invalid triangles and reports
// the assumptions it had to make.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "medial_vk/mesh_view.h"

namespace medial_vk {

/// Vertices in input units, triangles by index, counter-clockwise seen from outside.
struct Mesh {
  std::vector<Point> vertices;
  std::vector<Triangle> triangles;

  // Counts of polygons that a reader could not triangulate as they are; copied to the report.
  std::uint64_t short_polygons = 0;     ///< Faces of fewer than three corners, left out.
  std::uint64_t fallback_polygons = 0;  ///< Faces that cross themselves or would take too long, cut into a fan.
};

/// The findings of prepare_mesh(), printed in the summary and written to the report.
struct MeshReport {
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;            ///< After cleaning.
  std::uint64_t merged_vertices = 0;      ///< Vertices at exactly the position of an earlier one.
  std::uint64_t unused_vertices = 0;      ///< Vertices of no triangle, left out.
  std::uint64_t fallback_polygons = 0;    ///< Polygons that cross themselves or would take too long, cut into a fan.
  std::uint64_t degenerates_dropped = 0;  ///< Zero area, a repeated corner, or fewer than three corners.
  /// Of these degenerate faces: caps, triangles with one corner on the opposite side; the neighbour across that side is
  /// divided at the corner, so that no crack remains.
  std::uint64_t caps_repaired = 0;
  std::uint64_t duplicates_dropped = 0;  ///< Same three corners as an earlier face, in any order.
  /// Of these duplicates: faces between two solids that touch; both copies are dropped.
  std::uint64_t inner_walls_dropped = 0;
  std::uint64_t open_edges = 0;          ///< Edges of one triangle.
  std::uint64_t non_manifold_edges = 0;  ///< Edges of three or more triangles.
  /// Edges of two triangles that traverse them in the same direction. Turning faces over cannot correct them.
  std::uint64_t inconsistent_edges = 0;
  std::uint64_t non_manifold_vertices = 0;  ///< Vertices whose triangles form more than one fan.
  std::uint64_t components = 0;             ///< Connected by shared edges.
  std::uint64_t reoriented_faces = 0;       ///< Faces turned over, counted once for each of the next three reasons.
  std::uint64_t minority_faces = 0;         ///< Turned over to agree with their neighbours.
  std::uint64_t reoriented_components = 0;  ///< Turned over as a whole, because they were inside out.
  bool inside_out = false;                  ///< All faces were turned over: the signed volume was negative.
  std::uint64_t intersecting_faces = 0;     ///< Triangles that meet another one outside their shared corners and edges.
  bool intersections_known = true;          ///< False if the test was cut short by its budget.
  std::uint64_t cut_faces = 0;              ///< Faces cut along their crossings with others.
  std::uint64_t inner_faces = 0;            ///< Faces left out, after the cut: the inside lies on both sides of them.
  std::uint64_t outer_faces = 0;            ///< Faces of membranes outside the solid that were left out.
  std::uint64_t hidden_open_edges = 0;      ///< Of the given mesh, at holes inside other parts, which were filled.
  bool closed = false;                      ///< No open edge, orientation cancels on every edge.
  std::uint64_t faces_within = 0;           ///< Faces with the inside on both sides.
  std::uint64_t faces_without = 0;          ///< Faces with the outside on both sides.
  bool sides_known = true;                  ///< False if only a part of the faces was tested for these two.
  std::uint64_t trusted_triangles = 0;      ///< With kTrustedNormal.
  double signed_volume = 0;  ///< Input units cubed; an open mesh counts as closed by cones to the centre of its box.
  Point lower = {0, 0, 0};
  Point upper = {0, 0, 0};
  std::vector<std::string> assumptions;  ///< Full sentences for people.

  /// The longest side of the bounding box, the unit of every fraction in ExtractionOptions.
  double longest_side() const { return std::max({upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]}); }
};

/// A mesh that is ready for use: clean triangles, flags for the proofs, and the report.
struct PreparedMesh {
  Mesh mesh;
  std::vector<std::uint8_t> flags;  ///< TriangleFlags, one per triangle.
  MeshReport report;

  // Maps of input indices, for callers that supply new positions or attributes for the same faces.
  std::vector<std::uint32_t> vertex_of_input;    ///< By input vertex: index into mesh.vertices, or kDropped.
  std::vector<std::uint32_t> input_of_triangle;  ///< By triangle: index into the triangles given to prepare_mesh().

  static constexpr std::uint32_t kDropped = 0xffffffffu;
  MeshView view() const { return {mesh.vertices, mesh.triangles, flags, report.closed}; }
};

}  // namespace medial_vk
