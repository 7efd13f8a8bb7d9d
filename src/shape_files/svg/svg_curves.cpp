#include "shape_files/svg/svg_curves.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace medial_vk {
namespace {

constexpr double kPi = std::numbers::pi;

double length(double x, double y) { return std::hypot(x, y); }

/// |a - 2 b + c|
double second_difference(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return length(a[0] - 2 * b[0] + c[0], a[1] - 2 * b[1] + c[1]);
}

/// The most by which the map with these columns lengthens a vector: its greater singular value.
double stretch_of(const PlanePoint& x, const PlanePoint& y) {
  return (length(x[0] + y[1], x[1] - y[0]) + length(x[0] - y[1], x[1] + y[0])) / 2;
}

/// Parts of an arc: a chord of the unit circle over the angle h is 1 - cos(h/2) = 2 sin^2(h/4) from its arc at most,
/// and the map to the ellipse lengthens that by its stretch at most. A quarter turn at most, so that ellipses have an
/// inside.
double parts_of_arc(const PlaneCurve& arc, double flatness) {
  const double sine = std::sqrt(flatness / (2 * stretch_of(arc.first, arc.second)));
  const double step = sine >= 1 ? kPi / 2 : std::min(kPi / 2, 4 * std::asin(sine));
  return std::ceil(std::fabs(arc.sweep) / step * (1 - 1e-15));  // a whole turn is exactly four quarters
}

PlanePoint mixed(const PlanePoint& a, const PlanePoint& b, double t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
}

PlanePoint point_of(const PlaneCurve& curve, const PlanePoint& start, double t) {
  if (curve.kind == CurveKind::kArc) {
    const double angle = curve.begin + t * curve.sweep, cosine = std::cos(angle), sine = std::sin(angle);
    return {curve.centre[0] + curve.first[0] * cosine + curve.second[0] * sine,
            curve.centre[1] + curve.first[1] * cosine + curve.second[1] * sine};
  }
  const PlanePoint a = mixed(start, curve.first, t);
  if (curve.kind == CurveKind::kQuadratic) return mixed(a, mixed(curve.first, curve.end, t), t);
  const PlanePoint b = mixed(curve.first, curve.second, t), c = mixed(curve.second, curve.end, t);
  return mixed(mixed(a, b, t), mixed(b, c, t), t);
}

/// A box around an arc that begins at `start`: the points where a coordinate is greatest or least.
void add_arc_to(CurveBox& box, const PlaneCurve& arc, const PlanePoint& start) {
  constexpr double kNearlyStraight = 0.01;
  if (std::fabs(arc.sweep) < kNearlyStraight) {
    // The centre may be so far away that points by it are rounded more than the arc bends. It is within so much of its
    // chord.
    const double sine = std::sin(arc.sweep / 4), bend = 2 * stretch_of(arc.first, arc.second) * sine * sine;
    for (const PlanePoint& p : {start, arc.end}) {
      box.add(PlanePoint{p[0] - bend, p[1] - bend});
      box.add(PlanePoint{p[0] + bend, p[1] + bend});
    }
    return;
  }
  for (std::size_t k = 0; k < 2; ++k) {
    const double turning = std::atan2(arc.second[k], arc.first[k]);
    for (const double angle : {turning, turning + kPi}) {
      double from_begin = std::fmod(angle - arc.begin, 2 * kPi);
      if (from_begin < 0 && arc.sweep > 0) from_begin += 2 * kPi;
      if (from_begin > 0 && arc.sweep < 0) from_begin -= 2 * kPi;
      if (std::fabs(from_begin) <= std::fabs(arc.sweep)) box.add(point_of(arc, {}, from_begin / arc.sweep));
    }
  }
}

}  // namespace

CurveBox::CurveBox() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  lower = {kInfinity, kInfinity};
  upper = {-kInfinity, -kInfinity};
}

void CurveBox::add(const PlanePoint& p) {
  for (std::size_t k = 0; k < 2; ++k) {
    lower[k] = std::min(lower[k], p[k]);
    upper[k] = std::max(upper[k], p[k]);
  }
}

void CurveBox::add(const Outline& outline) {
  add(outline.start);
  PlanePoint at = outline.start;
  for (const PlaneCurve& curve : outline.curves) {
    add(curve.end);
    if (curve.kind == CurveKind::kArc) {
      add_arc_to(*this, curve, at);
    } else if (curve.kind != CurveKind::kLine) {
      add(curve.first);
      if (curve.kind == CurveKind::kCubic) add(curve.second);
    }
    at = curve.end;
  }
}

double CurveBox::longest_side() const { return std::max(upper[0] - lower[0], upper[1] - lower[1]); }

void add_arc(Outline& outline, const SvgMatrix& matrix, const PlanePoint& from, const PlanePoint& to, double rx,
             double ry, double degrees, bool large, bool positive) {
  if (from == to) return;
  PlaneCurve curve;
  curve.end = matrix * to;
  rx = std::fabs(rx);
  ry = std::fabs(ry);
  const double turn = std::fmod(degrees, 360) * kPi / 180, cosine = std::cos(turn), sine = std::sin(turn);
  const double x = (from[0] - to[0]) / 2, y = (from[1] - to[1]) / 2;
  // Where the ellipse is the unit circle, the arc goes from (u, v) to (-u, -v) about a centre across their chord.
  double u = (cosine * x + sine * y) / rx, v = (cosine * y - sine * x) / ry;
  const double half_chord = length(u, v);
  const double square = std::min(1.0, half_chord * half_chord);
  // An arc bends by a quarter of its chord times half_chord, and its points by the centre are rounded by some 1e-16 of
  // the radius, 1e-16 / half_chord of the chord, which is more where half_chord is less than this.
  constexpr double kStraight = 2e-8;
  const bool is_arc = rx > 0 && ry > 0 && square > 0 && std::isfinite(half_chord) && (large || half_chord > kStraight);
  if (!is_arc) {
    outline.curves.push_back(curve);  // a line
    return;
  }
  if (half_chord > 1) {
    rx *= half_chord;
    ry *= half_chord;
    u /= half_chord;
    v /= half_chord;
  }
  const double shift = (large != positive ? 1 : -1) * std::sqrt(1 / square - 1);
  const double centre_u = shift * v, centre_v = -shift * u;
  curve.kind = CurveKind::kArc;
  curve.begin = std::atan2(v - centre_v, u - centre_u);
  // By the chord, which is exact where the centre is far away.
  const double lesser = 2 * std::asin(std::min(1.0, half_chord));
  curve.sweep = large ? 2 * kPi - lesser : lesser;
  if (!positive) curve.sweep = -curve.sweep;
  const PlanePoint first = {rx * cosine, rx * sine}, second = {-ry * sine, ry * cosine};
  curve.centre = matrix * PlanePoint{(from[0] + to[0]) / 2 + centre_u * first[0] + centre_v * second[0],
                                     (from[1] + to[1]) / 2 + centre_u * first[1] + centre_v * second[1]};
  curve.first = matrix.turn(first);
  curve.second = matrix.turn(second);
  outline.curves.push_back(curve);
}

Outline ellipse_outline(const SvgMatrix& matrix, const PlanePoint& centre, double rx, double ry) {
  Outline outline;
  PlaneCurve curve;
  curve.kind = CurveKind::kArc;
  curve.centre = matrix * centre;
  curve.first = matrix.turn({rx, 0});
  curve.second = matrix.turn({0, ry});
  curve.sweep = 2 * kPi;
  curve.end = matrix * PlanePoint{centre[0] + rx, centre[1]};
  outline.start = curve.end;
  outline.curves.push_back(curve);
  outline.closed = true;
  return outline;
}

double parts_of(const PlaneCurve& curve, const PlanePoint& start, double flatness) {
  // A chord over a part h of the parameter is |B''| h^2 / 8 from the curve at most, and |B''| is twice the second
  // difference of a quadratic curve, and six times the greater one of a cubic curve at most.
  switch (curve.kind) {
    case CurveKind::kLine:
      return 1;
    case CurveKind::kQuadratic:
      return std::max(1.0, std::ceil(std::sqrt(second_difference(start, curve.first, curve.end) / (4 * flatness))));
    case CurveKind::kCubic: {
      const double most = std::max(second_difference(start, curve.first, curve.second),
                                   second_difference(curve.first, curve.second, curve.end));
      return std::max(1.0, std::ceil(std::sqrt(3 * most / (4 * flatness))));
    }
    case CurveKind::kArc:
      return std::max(1.0, parts_of_arc(curve, flatness));
  }
  return 1;
}

PlaneRing flatten(const Outline& outline, double flatness) {
  PlaneRing ring = {outline.start};
  for (const PlaneCurve& curve : outline.curves) {
    const PlanePoint start = ring.back();
    const auto parts = static_cast<std::uint64_t>(parts_of(curve, start, flatness));
    for (std::uint64_t i = 1; i < parts; ++i) {
      ring.push_back(point_of(curve, start, static_cast<double>(i) / static_cast<double>(parts)));
    }
    ring.push_back(curve.end);
  }
  if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  return ring;
}

}  // namespace medial_vk
