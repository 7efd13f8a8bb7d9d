// Medial points joined to a surface with the topology of the union of their balls. docs/theory.md, "The medial mesh".
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/ball_union.h"
#include "medial_vk/medial_spheres.h"
#include "medial_vk/mesh_view.h"
#include "medial_vk/result.h"
#include "medial_vk/sheets.h"

namespace medial_vk {

using MeshEdge = std::array<std::uint32_t, 2>;  ///< Indices of points, ascending.

/// The topology of a medial mesh, for comparison with the solid: the Betti numbers and the Euler characteristic equal
/// those of the solid if the topology has been preserved.
struct MedialTopology {
  BettiNumbers betti;
  std::int64_t euler_characteristic = 0;  ///< Points - edges + triangles.
  std::uint64_t boundary_edges = 0;       ///< Edges of one triangle.
  std::uint64_t non_manifold_edges = 0;   ///< Edges of three triangles or more, where sheets meet.
  /// Edges of no triangle, where the medial surface is a curve; the edges of hosted_points do not count.
  std::uint64_t bare_edges = 0;
  std::uint64_t hosted_points = 0;  ///< Points that another point represents; each has one edge, to that point.
};

/// Its vertices are all medial points, by their indices.
struct MedialMesh {
  std::vector<Triangle> triangles;  ///< Indices of points, ascending.
  std::vector<MeshEdge> edges;      ///< Ascending: those of the triangles, and bare ones.
  /// By edge, PointMark: kSeam if it joins two sheets or has three triangles, kRim if it has one.
  std::vector<std::uint8_t> edge_marks;
  MedialTopology topology;
};

/// Lengths in the units of the spheres.
struct MedialMeshOptions {
  /// Balls are joined as if their radii r were sqrt(r^2 + growth^2), so that small balls a voxel apart overlap; large
  /// balls hardly change. Set it to the side of a voxel.
  double growth = 0;
  /// Greatest distance of a point from the medial surface. Of points within twice this distance of each other, the
  /// first represents the others.
  double epsilon = 0;
  unsigned threads = 0;  ///< 0: one per core. The mesh does not depend on it.
};

/// Collapses the dual complex of the union of the grown balls to a mesh, which has the homotopy type of that union.
/// Precondition: `sheets` are the sheets of the same spheres. The mesh does not depend on the order of the spheres.
/// Errors: kUsage (a length that is negative or not finite), and those of measure_ball_union().
Result<MedialMesh> make_medial_mesh(std::span<const MedialSphere> spheres, const Sheets& sheets,
                                    const MedialMeshOptions& options);

}  // namespace medial_vk
