#include "output/medial_formats/icosphere.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numbers>
#include <utility>

namespace medial_vk {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

Eigen::Map<const Eigen::Vector3d> vector_of(const Point& p) { return Eigen::Map<const Eigen::Vector3d>(p.data()); }

void add_on_sphere(Icosphere& sphere, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d v = direction.normalized();
  sphere.vertices.push_back({v.x(), v.y(), v.z()});
}

Icosphere make_icosahedron() {
  constexpr double t = std::numbers::phi;
  Icosphere sphere;
  for (const auto& [x, y, z] : {std::array{-1., t, 0.},
                                {1., t, 0.},
                                {-1., -t, 0.},
                                {1., -t, 0.},
                                {0., -1., t},
                                {0., 1., t},
                                {0., -1., -t},
                                {0., 1., -t},
                                {t, 0., -1.},
                                {t, 0., 1.},
                                {-t, 0., -1.},
                                {-t, 0., 1.}}) {
    add_on_sphere(sphere, {x, y, z});
  }
  sphere.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return sphere;
}

/// The vertex in the middle of an edge, created at the first request.
std::uint32_t middle_of(Icosphere& sphere, std::map<Edge, std::uint32_t>& middles, std::uint32_t a, std::uint32_t b) {
  const auto [entry, is_new] =
      middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(sphere.vertices.size()));
  if (is_new) add_on_sphere(sphere, vector_of(sphere.vertices[a]) + vector_of(sphere.vertices[b]));
  return entry->second;
}

void cut_in_four(Icosphere& sphere) {
  std::map<Edge, std::uint32_t> middles;
  for (const auto& [a, b, c] : std::exchange(sphere.triangles, {})) {
    const std::uint32_t ab = middle_of(sphere, middles, a, b);
    const std::uint32_t bc = middle_of(sphere, middles, b, c);
    const std::uint32_t ca = middle_of(sphere, middles, c, a);
    for (const std::array<std::uint32_t, 3>& part : {std::array{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}}) {
      sphere.triangles.push_back(part);
    }
  }
}

}  // namespace

Icosphere make_icosphere(std::uint32_t detail) {
  Icosphere sphere = make_icosahedron();
  for (std::uint32_t i = 0; i < detail; ++i) cut_in_four(sphere);
  return sphere;
}

// The triangles are acute: the foot of the origin on the plane of each is its circumcentre, which is in it.
double facet_depth(const Icosphere& sphere) {
  double least = 1;
  for (const auto& [a, b, c] : sphere.triangles) {
    const Eigen::Vector3d corner = vector_of(sphere.vertices[a]);
    const Eigen::Vector3d normal =
        (vector_of(sphere.vertices[b]) - corner).cross(vector_of(sphere.vertices[c]) - corner).normalized();
    least = std::min(least, normal.dot(corner));
  }
  return 1 - least;
}

}  // namespace medial_vk
