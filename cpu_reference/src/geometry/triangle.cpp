// The nearest point of a triangle.
#include <Eigen/Geometry>
#include <limits>

#include "cpu_reference/queries.h"

namespace medial_vk::reference {
namespace {

using Eigen::Vector3d;

void try_edge(const Vector3d& p, const Vector3d& a, const Vector3d& b, TrianglePoint& best) {
  const Vector3d edge = b - a;
  const double length2 = edge.squaredNorm();
  const double t = length2 > 0 ? (p - a).dot(edge) / length2 : 0.0;
  TrianglePoint here;
  if (t <= 0) {
    here.point = a;
  } else if (t >= 1) {
    here.point = b;
  } else {
    here.point = t < 0.5 ? Vector3d(a + t * edge) : Vector3d(b - (1 - t) * edge);  // from the nearer end: less rounding
  }
  here.feature = t > 0 && t < 1 ? Feature::kEdge : Feature::kVertex;
  here.squared_distance = (p - here.point).squaredNorm();
  if (here.squared_distance < best.squared_distance) best = here;
}

}  // namespace

TrianglePoint closest_point_on_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  // Barycentric weights of the projection. Their error is |p - a| u / (|edge| sin(angle at a)), u the unit roundoff,
  // which moves the face point, inside the triangle and in its plane, by at most |p - a| u / sin: invisible in the
  // distance unless the triangle is a needle at a.
  const Vector3d ab = b - a, ac = c - a, ap = p - a;
  const Vector3d n = ab.cross(ac);
  const double n2 = n.squaredNorm();
  const bool needle = n2 <= 1e-10 * ab.squaredNorm() * ac.squaredNorm();  // sin <= 1e-5; also no area at all
  double wa = 0, wb = 0, wc = 0;
  if (n2 > 0) {
    wb = n.dot(ap.cross(ac)) / n2;
    wc = n.dot(ab.cross(ap)) / n2;
    wa = 1 - wb - wc;
  }
  TrianglePoint best;
  best.squared_distance = std::numeric_limits<double>::infinity();
  best.point = a;
  best.feature = Feature::kVertex;
  const bool over_face = wa > 0 && wb > 0 && wc > 0;
  if (over_face) {
    best = {a + wb * ab + wc * ac, 0, Feature::kFace};
    best.squared_distance = (p - best.point).squaredNorm();
    if (!needle) return best;
  }
  // A point nearest to the inside of an edge lies beyond that edge; one nearest to a corner lies beyond an edge of it.
  const double slack = 1e-6;  // generous against rounding of the weights; rarely costs an edge test
  if (needle || wc <= slack) try_edge(p, a, b, best);
  if (needle || wa <= slack) try_edge(p, b, c, best);
  if (needle || wb <= slack) try_edge(p, c, a, best);
  return best;
}

}  // namespace medial_vk::reference
