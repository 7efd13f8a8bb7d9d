// The medial axis of a shape in the plane as a graph of exact lines and parabolas, and the Voronoi diagram of sites
// there (Chapter 4; docs/theory.md, "In the plane").
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "medial_vk/plane_shape.h"
#include "medial_vk/progress.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// What a point of the axis touches: a point, or a segment between its ends; an index into those of the shape or sites.
struct PlaneContact {
  bool is_point = false;
  std::uint32_t index = 0;
};

/// A line or parabola of points at equal distance from two contacts, with a parameter t in input units: the distance
/// from its apex along a straight line.
struct PlaneCurve {
  enum class Kind : std::uint8_t { kOfPoints, kOfPointAndSegment, kOfSegments };
  Kind kind = Kind::kOfPoints;
  PlanePoint origin = {};
  PlanePoint along = {};  ///< Unit.
  PlanePoint up = {};     ///< Unit, from the segment to the point, of a parabola.
  /// Half the distance of two points; the distance of a point from the line of a segment; 0 of two segments.
  double focus = 0;
  double radius = 0, slope = 0;  ///< Of two segments: the radius at t is radius + slope t.
  double angle = 0;              ///< Of two segments: the object angle, radians.

  PlanePoint point_at(double t) const;
  double radius_at(double t) const;
  /// Half the angle between the directions to both contacts (Definition 2.1), radians.
  double object_angle_at(double t) const;
  /// Of the curve from one parameter to another.
  double length(double from, double to) const;
};

enum class AxisNodeKind : std::uint8_t {
  kMeeting,    ///< Equally far from three contacts or more.
  kCorner,     ///< A corner of the boundary, with radius 0.
  kThreshold,  ///< Beyond it the branch does not pass the thresholds.
  kBorder      ///< The branch leaves the box that was searched.
};

struct AxisNode {
  PlanePoint point = {};
  double radius = 0;
  double object_angle = 0;  ///< The greatest between two of its contacts, radians.
  AxisNodeKind kind = AxisNodeKind::kMeeting;
  std::uint32_t degree = 0;  ///< Arcs that end here.
};

/// A part of one curve, from nodes[0] at t[0] to nodes[1] at t[1], where t[0] < t[1].
struct AxisArc {
  PlaneCurve curve;
  std::array<std::uint32_t, 2> nodes = {};
  std::array<double, 2> t = {};
  std::array<PlaneContact, 2> contacts = {};
};

/// Arcs in a row between two junctions or ends; its inner nodes have degree 2. A loop without a junction begins and
/// ends in the same node.
struct AxisBranch {
  std::array<std::uint32_t, 2> ends = {};  ///< Nodes.
  std::vector<std::uint32_t> arcs;
  std::vector<bool> reversed;  ///< By arc: passed from nodes[1] to nodes[0].
  double length = 0;
};

struct PlaneAxis {
  std::vector<AxisNode> nodes;
  std::vector<AxisArc> arcs;
  std::vector<AxisBranch> branches;
  /// Every point of these arcs is within this distance of the exact axis, and every point of the exact axis of them,
  /// but for a share of the threshold, 2^-40; in input units. Nodes may be farther from theirs, along the axis, where
  /// contacts differ by no more than rounding: at joints of segments that are nearly in line.
  double epsilon = 0;
  std::uint64_t cells = 0;  ///< Of the partition of the plane, divided ones included.

  /// Nodes of a degree of at least 3.
  std::uint64_t junctions() const;
};

enum class PlaneSide : std::uint8_t { kInside, kOutside, kBoth };

struct PlaneAxisOptions {
  PlaneSide side = PlaneSide::kInside;
  /// Radians: points have at least this object angle; 0 to pi / 2. Below 2^-13 it counts as that.
  double object_angle = 0.6;
  /// In input units: points of at least this radius need an object angle of 0.15 only (Section 2.4.2). 0: off.
  double radius = 0;
  /// In input units: outside of the shape, the square around the middle of its box is searched that reaches this far
  /// beyond the box. 0: half the longest side.
  double margin = 0;
  unsigned threads = 0;  ///< Of the host, 0: one per core. The result does not depend on it.
};

/// Errors: kUsage (an option out of range), kOutOfMemory, kInterrupted. Time: proportional to n log n for n segments.
Result<PlaneAxis> find_plane_axis(const PreparedShape& shape, const PlaneAxisOptions& options = {},
                                  const ProgressCallback& progress = {}, const std::stop_token& stop = {});

/// Points and segments, each with the number of the site that it belongs to. Segments may share ends, by index. Those
/// of different sites do not meet otherwise.
struct PlaneSites {
  std::vector<PlanePoint> points;
  std::vector<std::array<std::uint32_t, 2>> segments;
  std::vector<std::uint32_t> site_of_point;    ///< By point.
  std::vector<std::uint32_t> site_of_segment;  ///< By segment.
};

struct PlaneVoronoiOptions {
  double object_angle = 0;  ///< Radians, as above.
  double margin = 0;        ///< In input units, as above.
  unsigned threads = 0;
};

/// The points at equal distance from two different sites at least, and from no site less (Section 2.6). Errors as
/// above, and kInvalidMesh (an index out of range, a segment without length, a coordinate that is not finite, fewer
/// than two sites; two sites that cross or touch, or come as close as 2^-43 of the side of the square that is
/// searched).
Result<PlaneAxis> find_plane_voronoi(const PlaneSites& sites, const PlaneVoronoiOptions& options = {},
                                     const ProgressCallback& progress = {}, const std::stop_token& stop = {});

}  // namespace medial_vk
