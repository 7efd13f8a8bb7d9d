// Medial points joined to a surface with the topology of the union of their balls. docs/theory.md, "The medial mesh".
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/ball_union.h"
#include "medial_vk/extraction.h"
#include "medial_vk/result.h"
#include "medial_vk/sheets.h"

namespace medial_vk {

using MeshEdge = std::array<std::uint32_t, 2>;  ///< Indices of points, ascending.

/// What a user compares with the solid: they are those of the solid if the mesh has kept its topology.
struct MedialTopology {
  BettiNumbers betti;
  std::int64_t euler_characteristic = 0;  ///< Points - edges + triangles.
  std::uint64_t boundary_edges = 0;       ///< Of one triangle.
  std::uint64_t non_manifold_edges = 0;   ///< Of three or more: where sheets meet.
  std::uint64_t bare_edges = 0;     ///< Of none, where the medial surface is a curve; without those of hosted_points.
  std::uint64_t hosted_points = 0;  ///< Those that others stand for: each has one edge, to the one that does.
};

/// All vertices are the medial points, by their indices.
struct MedialMesh {
  std::vector<Triangle> triangles;       ///< Indices of points, ascending.
  std::vector<MeshEdge> edges;           ///< Ascending: those of the triangles, and bare ones.
  std::vector<std::uint8_t> edge_marks;  ///< By edge, PointMark: it joins two sheets or has three triangles; or one.
  MedialTopology topology;
};

/// Lengths in the units of the spheres.
struct MedialMeshOptions {
  /// Balls are joined as if their radii r were sqrt(r^2 + growth^2): so small balls overlap that are a voxel apart.
  /// Large balls hardly change. The side of a voxel.
  double growth = 0;
  double epsilon = 0;  ///< How far points may be off: of those closer than twice that, the first stands for the others.
  unsigned threads = 0;  ///< 0: one per core. The mesh does not depend on it.
};

/// What the dual complex of the union of the grown balls collapses to: the mesh has the homotopy type of that union.
/// `sheets` are those of the same spheres. The mesh does not depend on the order of the spheres. Errors: those of
/// measure_ball_union().
Result<MedialMesh> make_medial_mesh(std::span<const MedialSphere> spheres, const Sheets& sheets,
                                    const MedialMeshOptions& options);

}  // namespace medial_vk
