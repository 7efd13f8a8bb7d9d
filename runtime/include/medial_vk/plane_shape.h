// Shapes in the plane: polygons with holes, of any number of parts, made ready for their medial axis.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "medial_vk/progress.h"
#include "medial_vk/result.h"

namespace medial_vk {

using PlanePoint = std::array<double, 2>;
/// A closed polygon: its last point is joined to the first, whichever way round it goes.
using PlaneRing = std::vector<PlanePoint>;

/// Which points are inside of rings, by how often the rings wind around them.
enum class FillRule : std::uint8_t {
  kNonZero,  ///< A winding number other than 0.
  kEvenOdd   ///< An odd winding number.
};

/// The findings of prepare_shape().
struct ShapeReport {
  std::uint64_t rings = 0;             ///< Given, those of fewer than three different points not counted.
  std::uint64_t segments = 0;          ///< Of the boundary, after all changes.
  std::uint64_t merged_points = 0;     ///< At the position of another one, or within the tolerance of it.
  std::uint64_t degenerate_rings = 0;  ///< Of fewer than three different points, left out.
  std::uint64_t crossings = 0;         ///< Points at which segments crossed, and are cut.
  std::uint64_t touching_points = 0;   ///< Points of one segment on another one, which is cut there.
  std::uint64_t inner_segments = 0;    ///< Left out, since the inside, or the outside, lies on both sides of them.
  double tolerance = 0;                ///< No point was moved farther, in input units: 2^-44 of the longest side.
  double area = 0;                     ///< In squared input units.
  double perimeter = 0;
  PlanePoint lower = {};
  PlanePoint upper = {};
  std::vector<std::string> assumptions;  ///< Full sentences for people.

  double longest_side() const;
};

/// The boundary of a shape as segments that meet in common points only; the inside is on the left of each one.
struct PreparedShape {
  std::vector<PlanePoint> points;
  std::vector<std::array<std::uint32_t, 2>> segments;
  ShapeReport report;
};

/// Cuts segments at crossings, leaves out those within the shape, and orients the others. Rings may cross, touch and
/// cover each other and themselves. Errors: kInvalidMesh (a coordinate that is not finite or beyond 1e150, no ring that
/// encloses anything), kUsage (2^30 points or more), kOutOfMemory, kInterrupted. Source: chapter 4, which presumes such
/// a boundary.
Result<PreparedShape> prepare_shape(std::span<const PlaneRing> rings, FillRule rule = FillRule::kNonZero,
                                    unsigned threads = 0, const std::stop_token& stop = {});

}  // namespace medial_vk
