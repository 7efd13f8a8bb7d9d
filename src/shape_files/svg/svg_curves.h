// Outlines of lines and curves, after all transformations, and their flattening.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/plane_shape.h"
#include "shape_files/svg/svg_matrix.h"

namespace medial_vk {

enum class CurveKind : std::uint8_t { kLine, kQuadratic, kCubic, kArc };

/// A curve that begins where the one before it ends.
struct PlaneCurve {
  CurveKind kind = CurveKind::kLine;
  PlanePoint end = {};
  /// Control points; of an arc the half-axes: it is centre + first cos(t) + second sin(t), for t from `begin` to
  /// `begin + sweep`.
  PlanePoint first = {}, second = {};
  PlanePoint centre = {};
  double begin = 0, sweep = 0;
};

struct Outline {
  PlanePoint start = {};
  std::vector<PlaneCurve> curves;
  bool closed = false;
};

/// Corners of a box around points; empty at first.
struct CurveBox {
  PlanePoint lower, upper;
  CurveBox();

  void add(const PlanePoint& p);
  /// The ends and control points of the curves, and arcs: a box around the outline.
  void add(const Outline& outline);
  double longest_side() const;
};

/// The arc of an ellipse with half-axes `rx` and `ry`, the first turned by `degrees`, between points, as SVG defines
/// it: radii that are too small are enlarged together. Where they are 0 it is a line; nothing is added between equal
/// points. Points are those before `matrix`.
void add_arc(Outline& outline, const SvgMatrix& matrix, const PlanePoint& from, const PlanePoint& to, double rx,
             double ry, double degrees, bool large, bool positive);

/// A whole ellipse with half-axes along the axes, before `matrix`.
Outline ellipse_outline(const SvgMatrix& matrix, const PlanePoint& centre, double rx, double ry);

/// The number of equal parts, in its parameter, whose chords are nowhere farther than `flatness` from the curve that
/// begins at `start`, by bounds that docs/formats.md derives. At least 1; may be infinite.
double parts_of(const PlaneCurve& curve, const PlanePoint& start, double flatness);

/// The points of the outline, with curves divided as parts_of() says; `parts` were tested for their sum.
PlaneRing flatten(const Outline& outline, double flatness);

}  // namespace medial_vk
