// Medial points grouped into medial sheets (Section 2.5), and the properties of each sheet. docs/theory.md, "Sheets".
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "medial_vk/medial_spheres.h"
#include "medial_vk/result.h"

namespace medial_vk {

struct SheetOptions {
  /// tau of Section 2.5, degrees, 0 to 90: neighbours are linked if their normals differ by at most this angle.
  double angle = 5.7;
  /// Degrees, 0 to 180: neighbours are also linked if both spokes turn by at most this angle, as from facet to facet of
  /// a round shape. 0: only the published test of normals applies, and components are not joined across borders.
  double crease = 10;
  /// Degrees, 0 to 180: two components are joined if the mean turn of the spokes at the points of their border is at
  /// most this limit, where each turn is clamped to [limit - 30, limit + 4]. A border that is short for the smaller
  /// component is extended by points whose turn is limit + 4.
  double border = 77;
  /// 0 to 1: components narrower than this fraction of the mean diameter of their balls are absorbed by their
  /// neighbours, point by point; 0: none. The width of a component is twice the greatest distance of one of its points
  /// from a border or a rim.
  double width = 0.17;
  /// Components of fewer points than this are absorbed too; 0: none.
  std::uint64_t absorb_fragments = 0;
  bool areas = true;     ///< Measure the areas of points and sheets, which volumes require.
  unsigned threads = 0;  ///< Of the host, 0: one per core. The sheets do not depend on it.

  bool operator==(const SheetOptions&) const = default;
};

/// Sheets of fewer points are counted as fragments.
inline constexpr std::uint64_t kFragmentPoints = 10;

struct Sheet {
  std::uint64_t points = 0;
  double area = 0;                     ///< Sum of the areas of its points, in units of the mesh squared.
  double mean_radius = 0;              ///< Of its points.
  double mean_object_angle = 0;        ///< Of its points, radians.
  std::optional<double> significance;  ///< lambda of equation 6.2; no value until volumes have been measured.
};

/// Flags of a point.
enum PointMark : std::uint8_t {
  kSeam = 1,   ///< Another sheet has a point in a voxel beside that of this point.
  kRim = 2,    ///< The sheet ends here: over a third of a turn, no voxel beside it has a point.
  kSmall = 4,  ///< The component is too small for a sheet of its own: its sheet is unreliable.
};

struct Sheets {
  std::vector<std::int32_t> of_point;  ///< By point: its sheet.
  std::vector<std::uint8_t> marks;     ///< By point: PointMark.
  /// By point, units of the mesh squared: the area of the tangent plane within the point's voxel, or half of it at a
  /// rim, where the sheet ends somewhere in the voxel. Empty without SheetOptions::areas.
  std::vector<double> areas;
  std::vector<Sheet> sheets;  ///< By decreasing number of points; sheets of equal size by their first voxels.

  std::uint64_t components = 0;           ///< Components before any was absorbed.
  std::uint64_t absorbed_components = 0;  ///< Components that were too narrow or had too few points.
  std::uint64_t absorbed_points = 0;
  std::uint64_t fragments = 0;  ///< Sheets of fewer than kFragmentPoints.
  std::uint64_t fragment_points = 0;
  std::uint64_t seam_points = 0;
  std::uint64_t rim_points = 0;
};

/// Groups the points. The sheet of a point depends neither on the order of the points nor on the number of threads.
/// `extraction` gives the object angle and epsilon of the points. Precondition: at most one point per voxel of `grid`.
/// Errors: kUsage (an option out of range), kOutOfMemory.
Result<Sheets> find_sheets(std::span<const MedialSphere> spheres, const VoxelGrid& grid,
                           const ExtractionOptions& extraction, const SheetOptions& options);

}  // namespace medial_vk
