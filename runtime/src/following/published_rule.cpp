#include "following/published_rule.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace medial_vk {
namespace {

double distance(const MovingSurface& surface, const Point& p) {
  return std::sqrt(surface.closest(p, std::numeric_limits<double>::infinity()).squared_distance);
}

Point interpolated_normal(const MovingSurface& surface, std::span<const Point> normals, const SurfacePoint& point) {
  const Triangle& t = surface.triangles()[point.triangle];
  const Point normal = point_at(point, {normals[t[0]], normals[t[1]], normals[t[2]]});
  const double size = length(normal);
  return size > 0 ? (1 / size) * normal : Point{0, 0, 0};
}

}  // namespace

void find_vertex_normals(const MovingSurface& surface, std::vector<Point>& normals) {
  std::ranges::fill(normals, Point{0, 0, 0});
  for (const Triangle& t : surface.triangles()) {
    const std::span<const Point> v = surface.vertices();
    const Point area = -surface.front() * cross(v[t[1]] - v[t[0]], v[t[2]] - v[t[0]]);
    for (const std::uint32_t corner : t) normals[corner] = normals[corner] + area;
  }
  for (Point& normal : normals) {
    const double size = length(normal);
    if (size > 0) normal = (1 / size) * normal;
  }
}

double shrink(const MovingSurface& surface, const Point& at, const Point& towards_centre, double radius,
              double protrusion) {
  double nearest = distance(surface, at + radius * towards_centre);
  while (radius - nearest >= protrusion) {
    const double next = (radius + nearest) / 2;
    if (!(next < radius)) break;  // no number is between them
    radius = next;
    nearest = distance(surface, at + radius * towards_centre);
  }
  return nearest;
}

TrackedBall follow_published(const MovingSurface& surface, std::span<const Point> vertex_normals,
                             const TrackedBall& rest, double protrusion) {
  TrackedBall now = rest;
  const Point at = surface.at(rest.a.on);
  now.a.towards_centre = interpolated_normal(surface, vertex_normals, rest.a.on);
  const double radius = shrink(surface, at, now.a.towards_centre, rest.ball.radius, protrusion);
  now.ball = {at + radius * now.a.towards_centre, radius};
  // Lemma 7.3 is about balls whose centres are inside.
  if (!(radius > 0) || !surface.contains(now.ball.centre)) now.ball.radius = 0;
  return now;
}

}  // namespace medial_vk
