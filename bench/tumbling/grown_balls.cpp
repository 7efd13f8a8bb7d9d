#include "grown_balls.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "base/point_ops.h"
#include "medial_vk/ball_union.h"
#include "solid/solid.h"

namespace medial_vk::bench {
namespace {

/// Grows the balls of a vertex.
template <class Balls>
void reach_boundary(const Solid& solid, const Point& vertex, const Balls& balls, std::vector<Ball>& grown) {
  const Point nearest = solid.closest(vertex).point;
  for (const std::uint32_t i : balls) grown[i].radius = std::max(grown[i].radius, length(nearest - grown[i].centre));
}

/// Two opposite points of the circle in which two spheres meet.
std::array<Point, 2> points_of_circle(const Ball& a, const Ball& b, double turn) {
  const Point between = b.centre - a.centre;
  const double distance = length(between);
  const Point axis = (1 / distance) * between;
  const double along = (distance * distance + a.radius * a.radius - b.radius * b.radius) / (2 * distance);
  const double radius = std::sqrt(std::max(0.0, a.radius * a.radius - along * along));
  const Point u = perpendicular_to(axis), v = cross(axis, u);
  const Point out = radius * (std::cos(turn) * u + std::sin(turn) * v), middle = a.centre + along * axis;
  return {middle + out, middle - out};
}

}  // namespace

Result<std::vector<Ball>> grown_balls(const IndexedMesh& mesh, std::span<const Ball> balls) {
  BallUnionOptions options;
  options.complex = true;
  const auto measured = measure_ball_union(balls, options);
  if (!measured) return measured.error();
  const auto solid = Solid::build(mesh);
  if (!solid) return solid.error();
  std::vector<Ball> grown(balls.begin(), balls.end());
  for (const EnvelopeVertex& vertex : measured.value().vertices) {
    reach_boundary(solid.value(), vertex.at, vertex.balls, grown);
  }
  std::set<std::array<std::uint32_t, 2>> of_triangles;
  for (const auto& [i, j, k] : measured.value().complex.triangles) {
    of_triangles.insert({i, j});
    of_triangles.insert({i, k});
    of_triangles.insert({j, k});
  }
  std::mt19937_64 random(1);
  std::uniform_real_distribution<> turn(0, 3.14159265358979);
  for (const auto& edge : measured.value().complex.edges) {
    if (of_triangles.contains(edge)) continue;
    for (const Point& p : points_of_circle(balls[edge[0]], balls[edge[1]], turn(random))) {
      reach_boundary(solid.value(), p, edge, grown);
    }
  }
  return grown;
}

}  // namespace medial_vk::bench
