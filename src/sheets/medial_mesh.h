// Medial points joined to a surface: the neighbours that an edge or a triangle joins. docs/theory.md, "The medial
// mesh".
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "medial_vk/extraction.h"
#include "sheets/sheets.h"

namespace medial_vk {

using MeshEdge = std::array<std::uint32_t, 2>;      ///< Indices of points, ascending.
using MeshTriangle = std::array<std::uint32_t, 3>;  ///< The same.

/// What a user compares with the solid: they are those of the solid if the mesh has kept its topology.
struct MedialTopology {
  std::uint64_t components = 0;
  std::int64_t euler_characteristic = 0;  ///< Points - edges + triangles.
  std::uint64_t boundary_edges = 0;       ///< Of one triangle.
  std::uint64_t non_manifold_edges = 0;   ///< Of three or more: where sheets meet.
  std::uint64_t bare_edges = 0;           ///< Of none: where the medial surface is a curve, or thinner than a voxel.
};

/// All vertices are the medial points, by their indices.
struct MedialMesh {
  std::vector<MeshTriangle> triangles;   ///< Ascending.
  std::vector<MeshEdge> edges;           ///< Ascending: those of the triangles, and bare ones.
  std::vector<std::uint8_t> edge_marks;  ///< By edge, PointMark: it joins two sheets or has three triangles; or one.
  MedialTopology topology;
};

/// Edges join points in voxels that touch, triangles three such points of one sheet or of two that meet there; a hole
/// of a sheet that these leave gets edges between voxels that are two apart. `sheets` are those of the same spheres;
/// `epsilon` is the length that points may be off: of those that are closer than twice that, one is joined to others,
/// and the rest to it. The mesh does not depend on the order of the spheres.
MedialMesh make_medial_mesh(std::span<const MedialSphere> spheres, const Sheets& sheets, double epsilon);

/// The part of a mesh whose edges and triangles (indices of points, ascending) are in a complex, such as the dual
/// complex of the union of the balls. A triangle goes with its edges; an edge whose triangle goes may stay.
MedialMesh restrict_medial_mesh(const MedialMesh& mesh, std::span<const MedialSphere> spheres, const Sheets& sheets,
                                const std::function<bool(std::span<const std::uint32_t>)>& in_complex);

}  // namespace medial_vk
