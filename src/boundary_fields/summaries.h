// Measures of a whole boundary: how thick its walls are by area, and how it is curved.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "boundary_fields/boundary_fields.h"
#include "boundary_fields/thin_places.h"
#include "medial_vk/mesh.h"
#include "medial_vk/thickness.h"

namespace medial_vk {

/// Of all triangles.
double area_of(const Mesh& mesh);

/// Thickness at points that stand for equal parts of the area.
struct ThicknessRecord {
  double delta = 0;               ///< In mesh units.
  double width = 0;               ///< Of an interval, relative to its lower end, at which the search ended.
  double wall_angle = 0;          ///< Object angle of walls, at least, in radians.
  double crease_angle = 0;        ///< The same of creases and corners.
  std::vector<Bounds> intervals;  ///< By point.
  Bounds median;                  ///< Of lower and of upper ends: holds the median over these points.
  std::uint64_t wide = 0;         ///< Points whose interval is wider than kWideInterval of its lower end.
  std::optional<Bounds> least;    ///< The interval of the least lower end in a wall; none: no point is in a wall.
  Point least_at = {0, 0, 0};     ///< Its point.
  double greatest = 0;            ///< The greatest upper end.
  std::array<std::uint64_t, kThicknessKinds.size()> of_kind = {};  ///< Points, by kind.

  /// Of the area; 0 without points.
  double share(ThicknessKind kind) const;
};

/// An interval that is no wider tells one wall from another.
inline constexpr double kWideInterval = 0.1;
/// The least wall that is met has a diameter of at least this many deltas: at edges so sharp that they are walls of no
/// thickness, the ball within delta of the edge is smaller.
inline constexpr double kWallDeltas = 10;

/// `how`: with delta and the angles that were used.
ThicknessRecord summarise_thickness(std::span<const Point> points, std::span<const Thickness> at_points,
                                    const ThicknessOptions& how);

/// By vertices, each with a third of the area of its triangles.
struct CurvatureRecord {
  struct Range {
    double least = 0, greatest = 0;
  };
  std::optional<Range> kappa_1, kappa_2;                   ///< None: unknown at all vertices.
  double unknown_share = 0;                                ///< Of the area: where a curvature is not known.
  double none_share = 0;                                   ///< Of the area: where neither is.
  std::optional<double> median_error;                      ///< Over vertices with an estimate; none: there are none.
  std::array<double, kCurvatureStates> state_shares = {};  ///< Of the area, by state.
};

/// `fields` hold curvatures.
CurvatureRecord summarise_curvature(const Mesh& mesh, const BoundaryFields& fields);

struct BoundaryRecord {
  std::optional<ThicknessRecord> thickness;
  std::optional<CurvatureRecord> curvature;
  std::vector<WallRecord> walls;  ///< Of --least-wall, --least-gap, --min-wall and --min-gap.
};

}  // namespace medial_vk
