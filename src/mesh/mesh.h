// A triangle mesh in memory, and what is known of it. Readers fill it, clean_mesh() drops what is no triangle,
// inspect_mesh() says what had to be assumed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "medial_vk/mesh_view.h"

namespace medial_vk {

/// Vertices in input units, triangles by index, counter-clockwise seen from outside.
struct Mesh {
  std::vector<Point> vertices;
  std::vector<Triangle> triangles;
};

/// What inspect_mesh() found; printed in the summary, written to the report.
struct MeshReport {
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;              ///< After cleaning.
  std::uint64_t degenerate_dropped = 0;     ///< Zero area or a repeated corner.
  std::uint64_t duplicates_dropped = 0;     ///< Same three corners as an earlier face, in any order.
  std::uint64_t open_edges = 0;             ///< Edges of one triangle.
  std::uint64_t non_manifold_edges = 0;     ///< Edges of three or more triangles.
  std::uint64_t inconsistent_edges = 0;     ///< Edges of two triangles that run through it in the same direction.
  std::uint64_t non_manifold_vertices = 0;  ///< Vertices whose triangles form more than one fan.
  std::uint64_t components = 0;             ///< Connected by shared edges.
  std::uint64_t reoriented_faces = 0;       ///< Faces turned over to agree with their component, or all of them.
  std::uint64_t intersecting_faces = 0;     ///< Triangles crossed by another one that is no neighbour.
  bool intersections_known = true;          ///< False if the test was cut short by its budget.
  bool closed = false;                      ///< No open edge, orientation cancels on every edge.
  double signed_volume = 0;                 ///< Input units cubed.
  Point lower = {0, 0, 0};
  Point upper = {0, 0, 0};
  std::vector<std::string> assumptions;     ///< Full sentences for people.
};

/// A mesh that is ready to be used: clean triangles, flags for the proofs, and the report.
struct PreparedMesh {
  Mesh mesh;
  std::vector<std::uint8_t> flags;  ///< TriangleFlags, one per triangle.
  MeshReport report;

  MeshView view() const { return {mesh.vertices, mesh.triangles, flags, report.closed}; }
};

}  // namespace medial_vk
