// Thickness of a solid's walls, and width of the gaps outside it, at points of its boundary, as intervals
// (docs/theory.md, "Thickness").
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/progress.h"
#include "medial_vk/result.h"
#include "medial_vk/sphere_measures.h"

namespace medial_vk {

/// Balls lie inside the solid, and measure its walls, or outside it, and measure its gaps.
enum class ThicknessSide : std::uint8_t { kWalls, kGaps };

struct ThicknessOptions {
  ThicknessSide side = ThicknessSide::kWalls;
  /// delta, in mesh units: balls count at a point if they come within this distance of it. 0: a two-thousandth of the
  /// longest side, which is a twentieth of a voxel at resolution 100.
  double delta = 0;
  /// Of an interval, relative to its lower end: the search at a point ends when its interval is no wider, or no wider
  /// than a quarter of delta (a fifth if the diameter is 2 delta or less).
  /// Where the width is less than delta over the thickness, a point takes ten times the distances and more: contacts on
  /// both sides of the wall are then needed in each direction (docs/theory.md, "Thickness").
  double width = 0.02;
  /// In mesh units: balls are not searched for beyond this diameter. 0: the longest side, which no ball inside exceeds.
  double limit = 0;
  /// Distances for a point, after which an interval of four times the width is enough.
  std::uint32_t patience = 50;
  /// Distances that may be computed for a point, each with up to 64 cells of directions; then its interval stays wider.
  std::uint32_t queries = 1000;
  /// Object angles, in radians, that distinguish kinds (ThicknessKind): a wall has at least the first, and facets have
  /// less than the second, which is 0 or more and at most the first, up to pi / 2.
  double wall_angle = 1.2, crease_angle = 0.25;
  unsigned threads = 0;  ///< Of the host, 0: one per core. The result does not depend on it.
};

/// What limits the ball at a point, by the outward normals at its contacts (inward ones for gaps).
enum class ThicknessKind : std::uint8_t {
  kNone,    ///< No ball was found.
  kFacets,  ///< Facets of a smooth part, or of a flat one: the object angle is less than the crease angle.
  kCrease,  ///< Two faces that meet at an edge, or would: no normal is as far as the crease angle from the plane of the
            ///< two that are farthest apart.
  kCorner,  ///< Three faces or more, as at the corner of a box or in a cone: some normal is.
  kWall,    ///< Opposite sides: the object angle is at least the wall angle.
};

/// At a point p.
struct Thickness {
  /// Holds T(p, delta), the diameter of the largest ball that comes within delta of p; the limit, if that is less. In
  /// mesh units, rounded outwards.
  Bounds diameter;
  /// A ball of the lower diameter that comes within delta of p; radius 0: none was found.
  Ball ball;
  /// Radians: half the greatest angle between the normals at two contacts: points of the boundary that the search met,
  /// p among them, no farther from the ball than delta and the width of `diameter`. Near pi / 2 in a wall, half the
  /// turn of the normal at an edge.
  double object_angle = 0;
  std::array<Point, 2> contacts = {};  ///< These two; p twice if there are no others.
  ThicknessKind kind = ThicknessKind::kNone;
};

/// At each of `points`, usually on the boundary. The radius of a ball is at most the exact distance of its centre from
/// the boundary, in double precision rounded down, and an upper bound is proved for all centres. On an open mesh a ball
/// is inside if its centre is (winding number of at least 1/2), and intervals are wide where that may differ between
/// neighbouring centres. They are wide, too, where a wall is thinner than some two deltas, as balls beyond it
/// come within delta of the point, at edges and corners where the thickness is below two deltas, and for a delta that
/// is no more than the rounding of coordinates. Time: 20 to 100 distances a point, fewer where points are dense, and
/// hundreds where the thickness is less than delta over the width. `progress` may be called on any thread, on one at a
/// time. Errors: kUsage (a coordinate that is not finite or beyond 1e18, 2^31 points or more, an option out of range),
/// kOutOfMemory, kInterrupted.
Result<std::vector<Thickness>> measure_thickness(const IndexedMesh& mesh, std::span<const Point> points,
                                                 const ThicknessOptions& options = {},
                                                 const ProgressCallback& progress = {},
                                                 const std::stop_token& stop = {});

}  // namespace medial_vk
