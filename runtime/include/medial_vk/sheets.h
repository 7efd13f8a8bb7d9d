// Medial points grouped into medial sheets (Section 2.5), with what each sheet is like. docs/theory.md, "Sheets".
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "medial_vk/ball_union.h"
#include "medial_vk/extraction.h"

namespace medial_vk {

struct SheetOptions {
  /// tau of Section 2.5, degrees: neighbours whose normals differ by no more are of one sheet.
  double angle = 5.7;
  /// Degrees: so are neighbours both of whose spokes turn by no more, as they do from facet to facet of a round shape.
  /// 0: only the published test, of neighbours and of pieces.
  double crease = 10;
  /// Degrees: two pieces are one if spokes turn by no more along their border, in the mean; no point of it counts as
  /// less than 30 below that, or as more than 4 above, as what a short border lacks does.
  double border = 77;
  /// Pieces narrower than this fraction of the mean diameter of their balls go to those around, point by point; 0:
  /// none. As wide as a strip is that fits between borders and rims, without the voxels of these.
  double width = 0.17;
  /// So do pieces of fewer points; 0: none.
  std::uint64_t absorb_fragments = 0;
  unsigned threads = 0;  ///< Of the host, 0: one per core. The sheets do not depend on it.

  bool operator==(const SheetOptions&) const = default;
};

/// Sheets of fewer points are counted as fragments.
inline constexpr std::uint64_t kFragmentPoints = 10;

struct Sheet {
  std::uint64_t points = 0;
  double area = 0;                     ///< Units of the mesh squared: the sum over its points.
  double mean_radius = 0;              ///< Of its points.
  double mean_object_angle = 0;        ///< Of its points, radians.
  std::optional<double> significance;  ///< lambda of equation 6.2; nothing until volumes have been measured.
};

/// What is special about a point; flags.
enum PointMark : std::uint8_t {
  kSeam = 1,   ///< Another sheet has a point in a voxel beside that of this one.
  kRim = 2,    ///< The sheet ends here: for a third of the way around, no voxel beside it has a point.
  kSmall = 4,  ///< Of a piece too small for a sheet of its own: which sheet it is in says little.
};

struct Sheets {
  std::vector<std::int32_t> of_point;  ///< By point: its sheet.
  std::vector<std::uint8_t> marks;     ///< By point: PointMark.
  /// By point, units of the mesh squared: of the plane through it within its voxel, half of that at a rim, where the
  /// sheet ends somewhere in the voxel. Empty if left out.
  std::vector<double> areas;
  std::vector<Sheet> sheets;  ///< By decreasing number of points; of equals, that of the first voxel first.

  std::uint64_t pieces = 0;           ///< Before any were absorbed.
  std::uint64_t absorbed_pieces = 0;  ///< Too narrow, or of too few points.
  std::uint64_t absorbed_points = 0;
  std::uint64_t fragments = 0;  ///< Sheets of fewer than kFragmentPoints.
  std::uint64_t fragment_points = 0;
  std::uint64_t seam_points = 0;
  std::uint64_t rim_points = 0;
};

/// The grouping does not need areas, volumes do; kLeftOut: those of sheets stay 0.
enum class SheetAreas { kMeasured, kLeftOut };

/// Groups the points. The sheet of a point depends on neither the order of the points nor the number of threads.
/// `extraction` is what the points were found with: its object angle and epsilon. Precondition: at most one point per
/// voxel of `grid`.
Sheets find_sheets(std::span<const MedialSphere> spheres, const VoxelGrid& grid, const ExtractionOptions& extraction,
                   const SheetOptions& options, SheetAreas areas = SheetAreas::kMeasured);

// What share of the volume each sheet accounts for, and the order in which sheets are removed (Chapter 6).
// docs/theory.md, "Significance".

/// Of the radius of a ball: how far from its centre a sheet is one of those that it is of.
inline constexpr double kSeamReach = 0.7;

struct Significance {
  double volume = 0;            ///< Of the union of the balls.
  double area = 0;              ///< Of its surface.
  BettiNumbers topology;        ///< Of the union.
  std::vector<double> of_ball;  ///< lambda(b), equation 6.1; sums to 1.
  /// lambda(T), equation 6.2; sums to 1. A ball at a seam is of all sheets there: it counts for each by the
  /// weights of its points within kSeamReach of its radius, or two voxels, the nearer the more.
  std::vector<double> of_sheet;
  std::vector<double> areas;  ///< Per ball: of its sphere on the surface of the union.
};

/// The order in which sheets go.
struct SheetRemoval {
  std::vector<std::uint32_t> sheets;  ///< The first to go first.
  std::vector<double> volume_left;    ///< After each: share of the volume of the whole union.
  std::vector<std::uint32_t> kept;    ///< Those that stay, by decreasing significance.
};

enum class RemovalRule {
  kSignificance,  ///< The least significant goes first (Section 6.3).
  /// The least significant goes first of those without which the union has as many components, tunnels and cavities as
  /// the whole (Section 6.4.1).
  kTopology,
};

}  // namespace medial_vk
