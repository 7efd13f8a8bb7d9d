#include "thickness_peers.h"

#ifdef MEDIAL_VK_HAVE_CGAL
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/mesh_segmentation.h>
#endif

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "base/point_ops.h"
#include "medial_vk/bvh.h"

namespace medial_vk::bench {
namespace {

/// Of each vertex, into the solid, weighted by area.
std::vector<Point> inward_normals(const Mesh& mesh) {
  std::vector<Point> normals(mesh.vertices.size(), Point{0, 0, 0});
  for (const Triangle& t : mesh.triangles) {
    const Point &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const Point area = cross(c - a, b - a);
    for (const std::uint32_t corner : t) normals[corner] = normals[corner] + area;
  }
  for (Point& normal : normals) {
    const double size = length(normal);
    if (size > 0) normal = (1 / size) * normal;
  }
  return normals;
}

double shrunk_radius(const Bvh& bvh, const Point& p, const Point& inward, double radius) {
  constexpr int kMostSteps = 50;
  constexpr double kEnough = 1e-6;  // of the radius
  for (int step = 0; step < kMostSteps; ++step) {
    const BvhHit hit = bvh.closest(p + radius * inward);
    const double distance = std::sqrt(hit.squared_distance);
    if (distance >= radius * (1 - kEnough)) break;
    const Point to_hit = hit.point - p;
    const double along = dot(to_hit, inward), next = dot(to_hit, to_hit) / (2 * along);
    if (!(along > 0) || !(next < radius)) break;
    radius = next;
  }
  return radius;
}

}  // namespace

std::vector<double> shrinking_balls(const IndexedMesh& mesh) {
  const Mesh& triangles = mesh.prepared().mesh;
  const std::vector<Point> inward = inward_normals(triangles);
  std::vector<double> diameters;
  diameters.reserve(inward.size());
  for (std::size_t i = 0; i < inward.size(); ++i) {
    diameters.push_back(2 * shrunk_radius(mesh.bvh(), triangles.vertices[i], inward[i], 0.5 * mesh.longest_side()));
  }
  return diameters;
}

#ifdef MEDIAL_VK_HAVE_CGAL
std::vector<double> shape_diameters(const IndexedMesh& mesh) {
  using Position = CGAL::Simple_cartesian<double>::Point_3;
  using Surface = CGAL::Surface_mesh<Position>;
  constexpr std::size_t kRays = 25;
  constexpr double kCone = 2.0 / 3.0 * std::numbers::pi;
  Surface surface;
  std::vector<Surface::Vertex_index> vertices;
  vertices.reserve(mesh.prepared().mesh.vertices.size());
  for (const Point& v : mesh.prepared().mesh.vertices) vertices.push_back(surface.add_vertex({v[0], v[1], v[2]}));
  for (const Triangle& t : mesh.prepared().mesh.triangles) {
    surface.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]);  // refused where the mesh is not a manifold
  }
  const auto values = surface.add_property_map<Surface::Face_index, double>("f:sdf", 0).first;
  CGAL::sdf_values(surface, values, kCone, kRays, false);
  std::vector<double> diameters;
  diameters.reserve(surface.number_of_faces());
  for (const Surface::Face_index face : surface.faces()) diameters.push_back(values[face]);
  return diameters;
}
#else
std::vector<double> shape_diameters(const IndexedMesh&) { return {}; }
#endif

}  // namespace medial_vk::bench
