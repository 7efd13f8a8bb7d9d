#include "mesh/crossings/exact_points.h"

#include <cmath>

#include "base/determinant_sign.h"
#include "base/point_ops.h"

namespace medial_vk {
namespace {

constexpr double kNear = 0x1p-50;  // the greatest error of a coordinate of ExactPoint::near

int sign_of(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// The numerator of a quotient may have the other sign in all four terms.
Expansion negated(Expansion e, ExpansionMath& math) { return math.difference(Expansion(), e); }

}  // namespace

int projection_axis(const GridTriangle& t) {
  const Point normal = cross(t[1] - t[0], t[2] - t[0]);
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::fabs(normal[static_cast<std::size_t>(k)]) > std::fabs(normal[static_cast<std::size_t>(axis)])) axis = k;
  }
  return axis;
}

Point snap_to_grid(const Point& p) {
  Point out;
  for (std::size_t k = 0; k < 3; ++k) out[k] = std::nearbyint(p[k] * 0x1p49) * 0x1p-49;
  return out;
}

ExactGeometry::Vector ExactGeometry::difference(const Point& a, const Point& b) {
  return {math_.difference(a[0], b[0]), math_.difference(a[1], b[1]), math_.difference(a[2], b[2])};
}

ExactGeometry::Vector ExactGeometry::cross(const Vector& a, const Vector& b) {
  Vector out;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    out[k] = difference(product(a[i], b[j]), product(a[j], b[i]));
  }
  return out;
}

Expansion ExactGeometry::dot(const Vector& a, const Vector& b) {
  return sum(sum(product(a[0], b[0]), product(a[1], b[1])), product(a[2], b[2]));
}

ExactPoint ExactGeometry::finish(std::array<Expansion, 4> terms) {
  if (sign(terms[3]) < 0) {
    for (Expansion& term : terms) term = negated(term, math_);
  }
  ExactPoint out;
  for (std::size_t k = 0; k < 4; ++k) out.terms[k].assign(terms[k].begin(), terms[k].end());
  for (std::size_t k = 0; k < 3; ++k) out.near[k] = value(terms[k]) / value(terms[3]);
  return out;
}

ExactPoint ExactGeometry::vertex(const Point& p) {
  arena_.reset();
  return finish({math_.number(p[0]), math_.number(p[1]), math_.number(p[2]), math_.number(1)});
}

/// With the heights h_u and h_v of the ends above the plane, the point is (h_u v - h_v u) / (h_u - h_v).
ExactPoint ExactGeometry::on_line(const Point& u, const Point& v, const GridTriangle& t) {
  arena_.reset();
  const Vector normal = cross(difference(t[1], t[0]), difference(t[2], t[0]));
  const Expansion of_u = dot(normal, difference(u, t[0])), of_v = dot(normal, difference(v, t[0]));
  std::array<Expansion, 4> terms;
  for (std::size_t k = 0; k < 3; ++k)
    terms[k] = difference(product(of_u, math_.number(v[k])), product(of_v, math_.number(u[k])));
  terms[3] = difference(of_u, of_v);
  return finish(terms);
}

/// Cramer's rule for normal_i . x = normal_i . corner_i.
bool ExactGeometry::on_planes(const std::array<GridTriangle, 3>& triangles, ExactPoint& point) {
  arena_.reset();
  std::array<Vector, 3> normals;
  std::array<Expansion, 3> offsets;
  for (std::size_t i = 0; i < 3; ++i) {
    const GridTriangle& t = triangles[i];
    normals[i] = cross(difference(t[1], t[0]), difference(t[2], t[0]));
    offsets[i] = dot(normals[i], difference(t[0], Point{0, 0, 0}));
  }
  std::array<Vector, 3> crosses;
  for (std::size_t i = 0; i < 3; ++i) crosses[i] = cross(normals[(i + 1) % 3], normals[(i + 2) % 3]);
  std::array<Expansion, 4> terms;
  terms[3] = dot(normals[0], crosses[0]);
  if (sign(terms[3]) == 0) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    terms[k] = sum(sum(product(offsets[0], crosses[0][k]), product(offsets[1], crosses[1][k])),
                   product(offsets[2], crosses[2][k]));
  }
  point = finish(terms);
  return true;
}

int ExactGeometry::side(const Point& a, const Point& b, const Point& c, const Point& d) {
  if (const int certain = sign_of_determinant(d - a, b - a, c - a); certain != 0) return certain;
  arena_.reset();
  return sign(dot(cross(difference(b, a), difference(c, a)), difference(d, a)));
}

/// The filter: with an error of 2 kNear and the rounding in each of the four differences, of magnitudes that sum up to
/// S, the determinant has an error below 4 kNear S + 20 kNear^2.
int ExactGeometry::orientation(const ExactPoint& p, const ExactPoint& q, const ExactPoint& r, int axis) {
  const auto i = static_cast<std::size_t>((axis + 1) % 3), j = static_cast<std::size_t>((axis + 2) % 3);
  const double ux = q.near[i] - p.near[i], uy = q.near[j] - p.near[j];
  const double vx = r.near[i] - p.near[i], vy = r.near[j] - p.near[j];
  const double determinant = ux * vy - uy * vx;
  const double sizes = std::fabs(ux) + std::fabs(uy) + std::fabs(vx) + std::fabs(vy);
  if (std::fabs(determinant) > 8 * kNear * (sizes + 4 * kNear)) return sign_of(determinant);
  arena_.reset();
  const std::array<const ExactPoint*, 3> rows = {&p, &q, &r};
  Expansion exact;
  for (std::size_t row = 0; row < 3; ++row) {
    const ExactPoint &a = *rows[(row + 1) % 3], &b = *rows[(row + 2) % 3];
    const Expansion minor = difference(product(a.terms[i], b.terms[j]), product(a.terms[j], b.terms[i]));
    exact = sum(exact, product(minor, rows[row]->terms[3]));
  }
  return sign(exact);
}

int ExactGeometry::normal_sign(const GridTriangle& t, int axis) {
  arena_.reset();
  return sign(cross(difference(t[1], t[0]), difference(t[2], t[0]))[static_cast<std::size_t>(axis)]);
}

}  // namespace medial_vk
