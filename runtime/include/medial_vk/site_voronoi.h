// The surface between sites in space: the points at equal distance from two different sites at least, and from no site
// less, the generalised Voronoi diagram of Section 2.6 and Figure 2-14 (docs/theory.md, "Between sites").
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "medial_vk/indexed_mesh.h"
#include "medial_vk/mesh_view.h"
#include "medial_vk/progress.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// A set of points of space: the union of its elements. A closed mesh is a solid, and the points inside belong to it;
/// an open one, and single triangles, are surfaces.
struct VoronoiSite {
  std::optional<IndexedMesh> mesh;
  std::vector<std::array<Point, 3>> triangles;
  std::vector<std::array<Point, 2>> segments;
  std::vector<Point> points;
};

struct SiteVoronoiOptions {
  std::uint32_t resolution = 160;  ///< Voxels along the longest side of the box, 1 to 2048.
  /// In input units: the surface is searched for in the box around all sites, grown by this on every side. 0: a quarter
  /// of the longest side of that box. The grid begins up to a voxel before it, so that planes of symmetry are no faces
  /// of voxels, and ends up to two behind it.
  double margin = 0;
  unsigned threads = 0;  ///< Of the host, 0: one per core. The result does not depend on it.
};

/// A point at equal distance from `count` sites, and from no site less.
struct SitePoint {
  static constexpr std::uint32_t kNoSite = 0xffffffffu;

  Point point = {0, 0, 0};
  double distance = 0;  ///< The clearance, to the nearest site.
  /// The exact distances of the listed sites differ by no more than this, and no site is nearer by more; input units.
  double error = 0;
  double object_angle = 0;  ///< Half the greatest angle between the directions to contacts, radians.
  std::uint32_t count =
      2;  ///< Sites, 2 to 4. At 3 the point is on a curve of three sites, at 4 where such curves meet.
  std::array<std::uint32_t, 4> sites = {kNoSite, kNoSite, kNoSite, kNoSite};  ///< Ascending, `count` of them.
  std::array<Point, 4> contacts = {};                                         ///< The nearest points of these sites.
  std::array<std::uint32_t, 3> voxel = {0, 0, 0};
};

/// Four points around an edge of the grid whose ends have different nearest sites, in a ring.
struct SiteFace {
  std::array<std::uint32_t, 4> corners = {};  ///< Points.
  std::array<std::uint32_t, 2> sites = {};    ///< Ascending; the ring turns left around the way from first to second.
  std::uint32_t piece = 0;
};

/// Faces of one pair of sites that are connected by common points.
struct SitePiece {
  std::array<std::uint32_t, 2> sites = {};
  std::uint64_t faces = 0;
  double area = 0;             ///< Of the faces as two triangles each, in squared input units.
  double least_clearance = 0;  ///< At its points, in input units.
  double greatest_clearance = 0;
};

/// Voxels (x, y, z) are cubes of `side` from `origin` on.
struct SiteGrid {
  Point origin = {0, 0, 0};
  double side = 0;
  std::array<std::uint32_t, 3> size = {0, 0, 0};

  Point corner(const std::array<std::uint32_t, 3>& at) const {
    return {origin[0] + at[0] * side, origin[1] + at[1] * side, origin[2] + at[2] * side};
  }
};

struct SiteVoronoi {
  SiteGrid grid;
  std::vector<SitePoint> points;  ///< At most one a voxel, in the order of voxels: z slowest, then y, then x.
  std::vector<SiteFace> faces;    ///< In the order of edges.
  std::vector<SitePiece> pieces;  ///< In the order of their first faces.
  /// In the order of voxels: neither a point was found, nor a proof that there is none.
  std::vector<std::array<std::uint32_t, 3>> undecided;
  /// Voxels, in that order, where only points were found whose contacts on both sites are the same, as where sites
  /// share a point, or that are on a site up to rounding.
  std::vector<std::array<std::uint32_t, 3>> tied;
  /// Voxels, in that order, where only points were found that are inside of a solid, and those near such points that
  /// are wholly inside: sites overlap, or have faces in common.
  std::vector<std::array<std::uint32_t, 3>> overlapping;
  std::vector<std::array<std::uint32_t, 2>> overlaps;  ///< Pairs of such points, ascending, in order.
  std::uint64_t cells = 0;                             ///< Examined, voxels and smaller ones included.
};

/// A voxel has a point, or is undecided, tied or overlapping, or it is proved that no point of it is equally far from
/// its two nearest sites. Points inside of solids and those whose contacts are seen at an object angle of less than
/// 2^-13 are no points of the surface. Runs on the host. `progress` gets the finished share, from any thread. Errors:
/// kInvalidMesh (fewer than two sites, a site without elements, a coordinate that is not finite or beyond 1e75, two
/// sites with the same elements, a box around all sites with a longest side below 1e-70), kUsage (an option out of
/// range), kOutOfMemory, kInterrupted. Time: proportional to the voxels that may have a point by the proofs, as a rule
/// those that the surface meets, and all around sites that nearly coincide; for each of them, some ten cells on
/// average, at most 72, and 4,000 more for each tile of 16^3 voxels. Source: Section 2.6; cells are dismissed by proof.
Result<SiteVoronoi> find_site_voronoi(std::span<const VoronoiSite> sites, const SiteVoronoiOptions& options = {},
                                      const ProgressCallback& progress = {}, const std::stop_token& stop = {});

}  // namespace medial_vk
