#include "proximity/triangle_pair.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace medial_vk {
namespace {

constexpr double kLeastLength = 1e-150, kGreatestLength = 1e150;

const Point& corner(const Corners& triangle, std::size_t k) { return triangle[k % 3]; }

struct Candidate {
  Point on_a, on_b;
  double squared = std::numeric_limits<double>::infinity();
};

Candidate between(const Point& on_a, const Point& on_b) {
  const Point away = on_b - on_a;
  return {on_a, on_b, dot(away, away)};
}

double share(double of, double whole) { return whole > 0 ? std::clamp(of / whole, 0.0, 1.0) : 0.0; }

/// The nearest points p + s d and q + t e of two segments. Let f(s) be the squared distance of p + s d from the line
/// through q: a parabola whose curvature is the squared sine of the angle between the segments, so where an s that is
/// divided by that curvature is inexact, it matters little. t is then that of the point nearest to p + s d, and where
/// it is cut off, s that of the point nearest to q + t e.
Candidate nearest_on_segments(const Point& p, const Point& d, const Point& q, const Point& e) {
  const Point r = p - q;
  const double dd = dot(d, d), ee = dot(e, e), de = dot(d, e), dr = dot(d, r), er = dot(e, r);
  double s = share(de * er - dr * ee, dd * ee - de * de);
  const double t_on_line = s * de + er;
  const double t = share(t_on_line, ee);
  if (t_on_line <= 0 || t_on_line >= ee) s = share(t * de - dr, dd);  // also where rounding has left e no length
  return between(p + s * d, q + t * e);
}

/// True if the planes across the line between the points separate the triangles, so that no other points are nearer
/// (the condition of Kuhn and Tucker for two convex sets). Rounding leaves the ends of the nearest edges on either side
/// of their planes.
bool is_nearest(const Corners& a, const Corners& b, const Candidate& points, double error) {
  const Point away = points.on_b - points.on_a;
  const double slack = error * std::sqrt(points.squared);
  for (const Point& x : a) {
    if (dot(x - points.on_a, away) > slack) return false;
  }
  return std::ranges::all_of(b, [&](const Point& x) { return dot(x - points.on_b, away) >= -slack; });
}

/// The nearest points of two edges, for all nine pairs of edges, until `visit(points)` returns true; false if it never
/// does.
template <class Visit>
bool visit_edges(const Corners& a, const Corners& b, const Visit& visit) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Point d = corner(a, i + 1) - a[i];
    for (std::size_t j = 0; j < 3; ++j) {
      if (visit(nearest_on_segments(a[i], d, b[j], corner(b, j + 1) - b[j]))) return true;
    }
  }
  return false;
}

/// The nearest points of the edges; true if they are those of the triangles.
bool try_edges(const Corners& a, const Corners& b, double error, Candidate& best) {
  return visit_edges(a, b, [&](const Candidate& points) {
    if (points.squared >= best.squared) return false;
    best = points;
    return is_nearest(a, b, best, error);
  });
}

/// The foot of the perpendicular from `p`, if it lies in `face`: a convex combination of corners, whatever the rounding
/// of its weights, so it never leaves the triangle.
bool find_foot_of(const Corners& face, const Point& p, Point& foot) {
  const Point ab = face[1] - face[0], ac = face[2] - face[0], from = p - face[0];
  const Point normal = cross(ab, ac);
  const double area = dot(normal, normal);
  if (!(area > 0)) return false;
  const double v = dot(cross(from, ac), normal) / area, w = dot(cross(ab, from), normal) / area;
  if (!(v >= 0 && w >= 0 && v + w <= 1)) return false;
  foot = face[0] + v * ab + w * ac;
  return true;
}

/// The foot of the corner of `other` that is nearest to the plane of `face`, all corners being on one side of it, if it
/// lies in `face`: true, with `corner` and `foot`.
bool find_foot(const Corners& face, const Corners& other, Point& corner_of_other, Point& foot) {
  const Point ab = face[1] - face[0], ac = face[2] - face[0];
  const Point normal = cross(ab, ac);
  const double area = dot(normal, normal);
  if (!(area > 0)) return false;
  std::array<double, 3> height;
  for (std::size_t k = 0; k < 3; ++k) height[k] = dot(other[k] - face[0], normal);
  const bool is_above = std::ranges::all_of(height, [](double h) { return h > 0; });
  if (!is_above && !std::ranges::all_of(height, [](double h) { return h < 0; })) return false;
  std::size_t nearest = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (std::fabs(height[k]) < std::fabs(height[nearest])) nearest = k;
  }
  corner_of_other = other[nearest];
  return find_foot_of(face, corner_of_other, foot);
}

/// The better of the candidates at the corners of either triangle, over the face of the other one.
void try_corners(const Corners& a, const Corners& b, Candidate& best) {
  Point foot;
  const auto keep = [&](const Candidate& points) {
    if (points.squared < best.squared) best = points;
  };
  for (const Point& p : b) {
    if (find_foot_of(a, p, foot)) keep(between(foot, p));
  }
  for (const Point& p : a) {
    if (find_foot_of(b, p, foot)) keep(between(p, foot));
  }
}

/// Six times the volume of the tetrahedron over three edges, and a bound of its error where each edge has one of up to
/// `error`: |det(x + dx, y + dy, z + dz) - det(x, y, z)| is at most the sum of the products of one error and two
/// lengths, twice which also holds the terms of two and three errors for errors below a third of the lengths; otherwise
/// the bound exceeds the volume. Six products of three numbers and their sum have fewer than 16 roundings.
struct Volume {
  double value, error;

  Volume(const Point& x, const Point& y, const Point& z, double error_of_edge) {
    value = dot(x, cross(y, z));
    const double lx = length(x) + error_of_edge, ly = length(y) + error_of_edge, lz = length(z) + error_of_edge;
    error = 2 * error_of_edge * (lx * ly + ly * lz + lz * lx) + 16 * 0x1p-53 * lx * ly * lz;
  }
  bool is_positive() const { return value > error; }
  bool is_negative() const { return value < -error; }
};

/// True if the segment from p to q passes through the triangle, whatever the errors of all corners: its ends are on
/// both sides of the plane, and the line passes all edges on the same side.
bool passes_through(const Point& p, const Point& q, const Corners& triangle, double error) {
  const double of_edge = 2 * error;
  const Point ab = triangle[1] - triangle[0], ac = triangle[2] - triangle[0];
  const Volume from_p(ab, ac, p - triangle[0], of_edge), from_q(ab, ac, q - triangle[0], of_edge);
  if (!(from_p.is_positive() && from_q.is_negative()) && !(from_p.is_negative() && from_q.is_positive())) return false;
  const Point d = q - p;
  bool all_positive = true, all_negative = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const Volume beside(d, triangle[k] - p, corner(triangle, k + 1) - p, of_edge);
    all_positive = all_positive && beside.is_positive();
    all_negative = all_negative && beside.is_negative();
  }
  return all_positive || all_negative;
}

/// The point where the segment meets the plane of the triangle, which it passes through.
Point crossing_point(const Point& p, const Point& q, const Corners& triangle) {
  const Point normal = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
  const double from = dot(p - triangle[0], normal), to = dot(q - triangle[0], normal);
  return p + share(from, from - to) * (q - p);
}

bool find_crossing(const Corners& a, const Corners& b, double error, Point& at) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (passes_through(a[k], corner(a, k + 1), b, error)) {
      at = crossing_point(a[k], corner(a, k + 1), b);
      return true;
    }
    if (passes_through(b[k], corner(b, k + 1), a, error)) {
      at = crossing_point(b[k], corner(b, k + 1), a);
      return true;
    }
  }
  return false;
}

/// Keeps the direction of `across`, either way, if it is better.
void try_direction(const Corners& a, const Corners& b, const Point& across, TrianglePoints& points) {
  const double size = length(across);
  if (!(size > kLeastLength && size < kGreatestLength)) return;  // squares keep their digits
  for (const double scale : {1 / size, -1 / size}) {
    const Point direction = scale * across;
    const double apart = separation_along(a, b, direction, points.on_a);
    if (apart <= points.apart) continue;
    points.direction = direction;
    points.apart = apart;
  }
}

void try_normals(const Corners& a, const Corners& b, TrianglePoints& points) {
  std::array<Point, 3> of_a, of_b;
  for (std::size_t k = 0; k < 3; ++k) {
    of_a[k] = corner(a, k + 1) - a[k];
    of_b[k] = corner(b, k + 1) - b[k];
  }
  try_direction(a, b, cross(of_a[0], of_a[1]), points);
  try_direction(a, b, cross(of_b[0], of_b[1]), points);
  for (const Point& x : of_a) {
    for (const Point& y : of_b) try_direction(a, b, cross(x, y), points);
  }
}

TrianglePoints with_direction(const Corners& a, const Corners& b, const Candidate& nearest) {
  TrianglePoints points;
  points.on_a = nearest.on_a;
  points.on_b = nearest.on_b;
  points.distance = std::sqrt(nearest.squared);
  points.apart = -std::numeric_limits<double>::infinity();
  if (!(points.distance > kLeastLength)) return points;
  points.direction = (1 / points.distance) * (points.on_b - points.on_a);
  points.apart = separation_along(a, b, points.direction, points.on_a);
  return points;
}

/// Among all pairs of edges and all corners, since rounding may decide for the wrong ones where triangles are thin.
Candidate nearest_of_all(const Corners& a, const Corners& b, Candidate best) {
  visit_edges(a, b, [&](const Candidate& points) {
    if (points.squared < best.squared) best = points;
    return false;
  });
  try_corners(a, b, best);
  return best;
}

/// Tries edges, then a corner over a face, and ends where the nearest points are found up to rounding. False if the
/// triangles cross, at `crossing`.
bool find_nearest(const Corners& a, const Corners& b, double error, Candidate& best, Point& crossing) {
  if (try_edges(a, b, error, best)) return true;
  Point of_other, foot;
  if (find_foot(a, b, of_other, foot)) {
    best = between(foot, of_other);
  } else if (find_foot(b, a, of_other, foot)) {
    best = between(of_other, foot);
  } else if (find_crossing(a, b, error, crossing)) {
    return false;
  } else {
    try_corners(a, b, best);
  }
  return true;
}

}  // namespace

double separation_along(const Corners& a, const Corners& b, const Point& direction, const Point& origin) {
  double end_of_a = -std::numeric_limits<double>::infinity(), start_of_b = -end_of_a;
  for (const Point& x : a) end_of_a = std::max(end_of_a, dot(x - origin, direction));
  for (const Point& x : b) start_of_b = std::min(start_of_b, dot(x - origin, direction));
  return start_of_b - end_of_a;
}

TrianglePoints nearest_points(const Corners& a, const Corners& b, double error) {
  Candidate best;
  Point crossing;
  if (!find_nearest(a, b, error, best, crossing)) {
    TrianglePoints points;
    points.on_a = points.on_b = crossing;
    points.crosses = true;
    return points;
  }
  TrianglePoints points = with_direction(a, b, best);
  if (points.apart >= points.distance - error) return points;
  points = with_direction(a, b, nearest_of_all(a, b, best));
  if (points.apart < points.distance - error) try_normals(a, b, points);
  return points;
}

}  // namespace medial_vk
