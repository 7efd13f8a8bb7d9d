// Curvature at the vertices of a mesh, from that at the spoke tips of medial balls (S. Stolpner, "Medial Spheres for
// Shape Representation", 2011, Section 5.4.3; docs/theory.md, "Curvature at vertices").
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/curvature.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/progress.h"
#include "medial_vk/result.h"

namespace medial_vk {

enum class CurvatureAssignment : std::uint32_t {
  kAlongSurface,  ///< Shape operators of the tips near a vertex along the surface, and those of rims, curves and
                  ///< points.
  kVoronoi,       ///< Means over the Voronoi cells of the vertices, propagated to their neighbours, as published.
};

struct VertexCurvatureOptions {
  CurvatureAssignment assignment = CurvatureAssignment::kAlongSurface;
  /// kAlongSurface: the least object angle of the search that found the balls, in radians. Where a sheet ends with a
  /// much greater one, the boundary beyond is taken for the sphere of the last ball; where it ends with about this one,
  /// the sheet goes on. 0: the least object angle of the balls, as measured.
  double object_angle = 0;
  unsigned threads = 0;  ///< Of the host, 0: one per core. The result does not depend on it.

  bool operator==(const VertexCurvatureOptions&) const = default;
};

/// The boundary at a vertex. Numbers that are not known are NaN.
struct VertexCurvature {
  static constexpr std::uint32_t kNoBall = 0xffffffffu;
  static constexpr std::uint8_t kCap = 2;  ///< The vertex is where the ball touches between or beyond its tips.

  /// kKnown: both curvatures, from tips on all sides. kCut: both, from tips on one side, or from the ball at a rim or
  /// at the end of a curve; kVoronoi: by propagation. kCurve, kPoint: as for tips, from the ball that touches here.
  /// Unknown: kUncertain, where `error` would be above a quarter of the greater curvature, and of 0.1 / r of the ball;
  /// kEdge, at an edge of the mesh: the fitted normal is more than 0.35 radians off that of the mesh, or tips are on
  /// one side only and do not go on towards the vertex, and a triangle at the vertex is as far off. Where none is, or
  /// no tip is in reach, what is not known of the nearest ball: kSeam, kFew, kNested, kFocal, kUncertain or kExposed;
  /// kEdge, if its curvatures are known. kFew, if there are no balls; kVoronoi: where no tip is on the component of the
  /// mesh.
  CurvatureState state = CurvatureState::kFew;
  /// The outward unit normal of the smooth boundary; known wherever a curvature is. kVoronoi: that of the mesh.
  Point normal = {TipCurvature::kUnknown, TipCurvature::kUnknown, TipCurvature::kUnknown};
  std::array<double, 2> kappa = {TipCurvature::kUnknown, TipCurvature::kUnknown};  ///< As of TipCurvature.
  /// Unit vectors, perpendicular to the normal; signs are arbitrary. kVoronoi: of the vertices whose cells have tips.
  std::array<Point, 2> directions = {Point{TipCurvature::kUnknown, TipCurvature::kUnknown, TipCurvature::kUnknown},
                                     Point{TipCurvature::kUnknown, TipCurvature::kUnknown, TipCurvature::kUnknown}};
  /// An estimate of the error of both curvatures, in the same units, which includes the spread of the tips that count.
  /// It is no bound. kVoronoi: of the vertices whose cells have tips.
  double error = TipCurvature::kUnknown;
  std::uint32_t ball = kNoBall;  ///< The one whose tip weighs most, or that touches here; kNoBall: none.
  std::uint8_t tip = 0;          ///< Of `ball`: 0, 1 or kCap.
};

/// At each vertex of the mesh, from the balls and what measure_curvature() found of them, by either method. The mesh
/// and the balls are in the same units. A tip counts for a vertex only if a path along the surface joins them, and if
/// their normals differ by less than 66 degrees: what lies on the other side of a wall never does. (kVoronoi: if they
/// differ by less than 90 degrees.) Time: some 0.05 ms of one core
/// for a vertex, however dense vertices are. `progress` may be called on any thread, on one at a time, with the stages
/// "tips on the mesh" and "vertices". Does not throw. Errors: kUsage (the mesh is that of the outside; a ball or a
/// vertex with a number that is not finite or beyond 1e18, a radius that is not positive, numbers of balls that differ,
/// 2^31 balls or more, an option out of range), kInterrupted, kOutOfMemory.
Result<std::vector<VertexCurvature>> curvature_at_vertices(const IndexedMesh& mesh, std::span<const Ball> balls,
                                                           const BoundaryCurvature& curvature,
                                                           const VertexCurvatureOptions& options = {},
                                                           const StageProgress& progress = {},
                                                           const std::stop_token& stop = {});

}  // namespace medial_vk
