#include "hull_fits/search/hull_chords.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

constexpr Chord kNoChord = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

void extend(Chord& chord, double at) {
  chord.begin = std::min(chord.begin, at);
  chord.end = std::max(chord.end, at);
}

}  // namespace

HullChords::HullChords(const BallHull& hull, std::size_t axis)
    : order_{(axis + 1) % 3, (axis + 2) % 3, axis}, rows_(kNoChord) {
  for (const Ball& ball : hull.balls()) {
    const Point& c = ball.centre;
    spheres_[sphere_count_++] = {c[order_[0]], c[order_[1]], c[order_[2]], ball.radius * ball.radius, ball.radius};
    extend(rows_, c[order_[1]] - ball.radius);
    extend(rows_, c[order_[1]] + ball.radius);
  }
  if (hull.count >= 2) add_cone(hull, 0, 1);
  if (hull.count < 3) return;
  add_cone(hull, 1, 2);
  add_cone(hull, 2, 0);
  add_faces(hull);
}

void HullChords::add_cone(const BallHull& hull, std::uint32_t from, std::uint32_t to) {
  const Ball &a = hull.corners[from], &b = hull.corners[to];
  const Point along = b.centre - a.centre;
  Cone cone;
  cone.from = from;
  cone.extent = length(along);
  cone.radius = a.radius;
  const double growth = b.radius - a.radius;
  if (!(std::fabs(growth) < cone.extent)) return;
  cone.slope = growth / cone.extent;
  cone.squared_cosine = (1 - cone.slope) * (1 + cone.slope);
  for (std::size_t k = 0; k < 3; ++k) cone.direction[k] = along[order_[k]] / cone.extent;
  const double dz = cone.direction[2];
  cone.quadratic = cone.squared_cosine * (1 - dz * dz) - cone.slope * cone.slope * dz * dz;
  // Seen along the lines: two tangents of two discs, unless one disc holds the other.
  const double du = along[order_[0]], dv = along[order_[1]], seen = std::hypot(du, dv);
  cone.silhouettes = {};
  if (std::fabs(growth) < seen) {
    const double s = growth / seen, cosine = std::sqrt((1 - s) * (1 + s));
    const double eu = du / seen, ev = dv / seen;
    for (std::size_t side = 0; side < 2; ++side) {
      const double sign = side == 0 ? 1 : -1;
      const double nu = -s * eu - sign * cosine * ev, nv = -s * ev + sign * cosine * eu;
      cone.silhouettes[side] = {a.centre[order_[0]] + a.radius * nu, a.centre[order_[1]] + a.radius * nv,
                                b.centre[order_[0]] + b.radius * nu, b.centre[order_[1]] + b.radius * nv};
    }
  } else {
    cone.silhouettes[0][1] = cone.silhouettes[0][3] = std::numeric_limits<double>::quiet_NaN();
    cone.silhouettes[1] = cone.silhouettes[0];
  }
  cones_[cone_count_++] = cone;
}

void HullChords::add_faces(const BallHull& hull) {
  const auto& [a, b, c] = hull.corners;
  const Point ab = b.centre - a.centre, ac = c.centre - a.centre;
  const Point normal = cross(ab, ac);
  const double area = dot(normal, normal);
  if (!(area > 0)) return;
  const Point to_b = (1 / area) * cross(ac, normal), to_c = (1 / area) * cross(normal, ab);
  const Point gradient = (b.radius - a.radius) * to_b + (c.radius - a.radius) * to_c;
  const double squared = dot(gradient, gradient);
  if (!(squared < 1)) return;
  const Point across = std::sqrt((1 - squared) / area) * normal;
  for (const double sign : {1.0, -1.0}) {
    const Point n = sign * across - gradient;
    const Point pa = a.centre + a.radius * n, pb = b.centre + b.radius * n - pa, pc = c.centre + c.radius * n - pa;
    const double bu = pb[order_[0]], bv = pb[order_[1]], cu = pc[order_[0]], cv = pc[order_[1]];
    const double determinant = bu * cv - bv * cu;
    if (!(std::fabs(determinant) > 1e-12 * std::sqrt(dot(pb, pb) * dot(pc, pc)))) continue;  // seen from the side
    faces_[face_count_++] = {pa[order_[0]],     pa[order_[1]],    pa[order_[2]], cv / determinant, -cu / determinant,
                             -bv / determinant, bu / determinant, pb[order_[2]], pc[order_[2]]};
  }
}

Chord HullChords::row(double v) const {
  Chord range = kNoChord;
  for (std::uint32_t i = 0; i < sphere_count_; ++i) {
    const Sphere& sphere = spheres_[i];
    const double squared = sphere.squared_radius - (v - sphere.v) * (v - sphere.v);
    if (!(squared >= 0)) continue;
    const double half = std::sqrt(squared);
    extend(range, sphere.u - half);
    extend(range, sphere.u + half);
  }
  for (std::uint32_t i = 0; i < cone_count_; ++i) {
    for (const auto& [u0, v0, u1, v1] : cones_[i].silhouettes) {
      if ((v - v0) * (v - v1) < 0) extend(range, u0 + (v - v0) / (v1 - v0) * (u1 - u0));
    }
  }
  return range;
}

Chord HullChords::at(double u, double v) const {
  Chord chord = kNoChord;
  for (std::uint32_t i = 0; i < sphere_count_; ++i) {
    const Sphere& sphere = spheres_[i];
    const double du = u - sphere.u, dv = v - sphere.v;
    const double squared = sphere.squared_radius - du * du - dv * dv;
    if (!(squared >= 0)) continue;
    const double half = std::sqrt(squared);
    extend(chord, sphere.z - half);
    extend(chord, sphere.z + half);
  }
  for (std::uint32_t i = 0; i < cone_count_; ++i) {
    const Cone& cone = cones_[i];
    const Sphere& sphere = spheres_[cone.from];
    const double du = u - sphere.u, dv = v - sphere.v, dz = cone.direction[2];
    // On the cone the distance from its axis times its cosine is m = radius + slope y, y along the axis.
    const double y0 = du * cone.direction[0] + dv * cone.direction[1];
    const double m0 = cone.radius + cone.slope * y0;
    const double linear = -cone.squared_cosine * y0 * dz - cone.slope * dz * m0;
    const double constant = cone.squared_cosine * (du * du + dv * dv - y0 * y0) - m0 * m0;
    const double discriminant = linear * linear - cone.quadratic * constant;
    if (!(discriminant >= 0)) continue;
    // Along a line of the cone one of the solutions is at infinity: neither is a difference of numbers nearly equal.
    const double sum = -(linear + std::copysign(std::sqrt(discriminant), linear));
    for (const double z : {sum / cone.quadratic, constant / sum}) {
      const double y = y0 + dz * z, m = cone.radius + cone.slope * y;
      const double share = y + cone.slope * m / cone.squared_cosine;
      if (m >= 0 && share >= 0 && share <= cone.extent) extend(chord, sphere.z + z);
    }
  }
  for (std::uint32_t i = 0; i < face_count_; ++i) {
    const Face& face = faces_[i];
    const double du = u - face.u, dv = v - face.v;
    const double b = face.b_u * du + face.b_v * dv, c = face.c_u * du + face.c_v * dv;
    if (b >= 0 && c >= 0 && b + c <= 1) extend(chord, face.z + b * face.z_b + c * face.z_c);
  }
  return chord;
}

}  // namespace medial_vk
