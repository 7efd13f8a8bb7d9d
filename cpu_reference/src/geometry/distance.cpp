#include "cpu_reference/distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "cpu_reference/distance_mesh.h"
#include "geometry/corner_volume.h"

namespace medial_vk::reference {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void take(const Vector3d& on_a, const Vector3d& on_b, NearestPair& best) {
  const double distance = (on_a - on_b).norm();
  if (distance < best.distance) best = {on_a, on_b, distance};
}

Vector3d nearest_on_segment(const Vector3d& p, const Vector3d& from, const Vector3d& to) {
  const Vector3d edge = to - from;
  const double squared = edge.squaredNorm();
  return squared > 0 ? Vector3d(from + std::clamp((p - from).dot(edge) / squared, 0.0, 1.0) * edge) : from;
}

/// The nearest points of two segments are an end and the point nearest to it, or both feet of the common perpendicular
/// of the lines. These follow from two linear equations.
void take_segments(const Vector3d& p, const Vector3d& p2, const Vector3d& q, const Vector3d& q2, NearestPair& best) {
  take(p, nearest_on_segment(p, q, q2), best);
  take(p2, nearest_on_segment(p2, q, q2), best);
  take(nearest_on_segment(q, p, p2), q, best);
  take(nearest_on_segment(q2, p, p2), q2, best);
  const Vector3d d = p2 - p, e = q2 - q, n = d.cross(e);
  const double n2 = n.squaredNorm();
  if (!(n2 > 0)) return;
  const double s = (q - p).cross(e).dot(n) / n2, t = (q - p).cross(d).dot(n) / n2;
  if (s >= 0 && s <= 1 && t >= 0 && t <= 1) take(p + s * d, q + t * e, best);
}

/// True if the segment passes through the triangle or ends on it, by the signs of five volumes: of the corners as they
/// are, without a tolerance. False if it lies in the plane of the triangle: then corners or edges have a common point.
bool meets(const Vector3d& p, const Vector3d& q, const Corners& triangle, Vector3d& at) {
  const auto& [a, b, c] = triangle;
  const double of_p = corner_volume(a, b, c, p), of_q = corner_volume(a, b, c, q);
  if ((of_p > 0 && of_q > 0) || (of_p < 0 && of_q < 0) || (of_p == 0 && of_q == 0)) return false;
  const double x = corner_volume(p, q, a, b), y = corner_volume(p, q, b, c), z = corner_volume(p, q, c, a);
  if (!(x >= 0 && y >= 0 && z >= 0) && !(x <= 0 && y <= 0 && z <= 0)) return false;
  at = p + of_p / (of_p - of_q) * (q - p);
  return true;
}

Corners corners_of(const Mesh& mesh, std::size_t t) {
  const Eigen::Vector3i& triangle = mesh.triangles[t];
  return {mesh.vertices[static_cast<std::size_t>(triangle[0])], mesh.vertices[static_cast<std::size_t>(triangle[1])],
          mesh.vertices[static_cast<std::size_t>(triangle[2])]};
}

/// A ball around the centroid that holds the triangle.
struct Around {
  Corners corners;
  Vector3d centre;
  double radius;

  explicit Around(const Corners& of) : corners(of), centre((of[0] + of[1] + of[2]) / 3), radius(0) {
    for (const Vector3d& corner : corners) radius = std::max(radius, (corner - centre).norm());
  }
};

std::vector<Around> all_triangles(const Mesh& mesh, const Motion& motion) {
  std::vector<Around> all;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Corners corners = corners_of(mesh, t);
    for (Vector3d& corner : corners) corner = motion.rotation * corner + motion.shift;
    all.emplace_back(corners);
  }
  return all;
}

}  // namespace

NearestPair nearest_of_triangles(const Corners& a, const Corners& b) {
  NearestPair best = {a[0], b[0], kInfinity};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d &p = a[i], &p2 = a[(i + 1) % 3], &q = b[i], &q2 = b[(i + 1) % 3];
    Vector3d at;
    if (meets(p, p2, b, at) || meets(q, q2, a, at)) return {at, at, 0};
    take(p, closest_point_on_triangle(p, b[0], b[1], b[2]).point, best);
    take(closest_point_on_triangle(q, a[0], a[1], a[2]).point, q, best);
    for (std::size_t j = 0; j < 3; ++j) take_segments(p, p2, b[j], b[(j + 1) % 3], best);
  }
  return best;
}

NearestPair nearest_of_meshes(const Mesh& a, const Mesh& b, const Motion& motion) {
  const std::vector<Around> of_a = all_triangles(a, {Eigen::Matrix3d::Identity(), Vector3d::Zero()}),
                            of_b = all_triangles(b, motion);
  NearestPair best = {of_a[0].corners[0], of_b[0].corners[0], kInfinity};
  for (const Around& x : of_a) {
    for (const Around& y : of_b) {
      // No points of the two are closer than their balls; a share of 1e-12 is more than all rounding.
      const double reach = best.distance + x.radius + y.radius;
      if ((x.centre - y.centre).squaredNorm() > reach * reach * (1 + 1e-12)) continue;
      const NearestPair pair = nearest_of_triangles(x.corners, y.corners);
      if (pair.distance < best.distance) best = pair;
    }
  }
  return best;
}

bool one_holds_the_other(const Mesh& a, const Mesh& b, const Motion& motion) {
  return one_holds_the_other(DistanceMesh(a), DistanceMesh(b), motion);
}

}  // namespace medial_vk::reference
