#include "jet_curvature.h"

#ifdef MEDIAL_VK_HAVE_CGAL
#include <CGAL/Monge_via_jet_fitting.h>
#include <CGAL/Simple_cartesian.h>
#endif

#include <algorithm>
#include <cstdint>

namespace medial_vk::bench {

#ifdef MEDIAL_VK_HAVE_CGAL
namespace {

using Kernel = CGAL::Simple_cartesian<double>;

constexpr std::size_t kDegree = 4, kLeastPoints = (kDegree + 1) * (kDegree + 2);

std::vector<std::vector<std::uint32_t>> neighbours_of(const Mesh& mesh) {
  std::vector<std::vector<std::uint32_t>> out(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      out[t[k]].push_back(t[(k + 1) % 3]);
      out[t[k]].push_back(t[(k + 2) % 3]);
    }
  }
  return out;
}

/// The vertex first, then ring by ring.
std::vector<std::uint32_t> rings_about(std::uint32_t vertex, const std::vector<std::vector<std::uint32_t>>& neighbours,
                                       std::vector<std::uint32_t>& visited_by) {
  std::vector<std::uint32_t> out = {vertex};
  visited_by[vertex] = vertex;
  std::size_t begin = 0;
  while (out.size() < kLeastPoints && begin < out.size()) {
    const std::size_t end = out.size();
    for (; begin < end; ++begin) {
      for (const std::uint32_t next : neighbours[out[begin]]) {
        if (visited_by[next] == vertex) continue;
        visited_by[next] = vertex;
        out.push_back(next);
      }
    }
  }
  return out;
}

Point to_point(const Kernel::Vector_3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

bool have_jets() { return true; }

std::vector<MeshCurvature> jet_curvature(const Mesh& mesh) {
  const auto neighbours = neighbours_of(mesh);
  const std::vector<MeshCurvature> normals = mesh_curvature(mesh);  // only say which side is outside
  std::vector<std::uint32_t> visited_by(mesh.vertices.size(), ~std::uint32_t{0});
  std::vector<MeshCurvature> out(mesh.vertices.size());
  std::vector<Kernel::Point_3> points;
  for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i) {
    points.clear();
    for (const std::uint32_t at : rings_about(i, neighbours, visited_by)) {
      const Point& p = mesh.vertices[at];
      points.emplace_back(p[0], p[1], p[2]);
    }
    CGAL::Monge_via_jet_fitting<Kernel> fitting;
    auto form = fitting(points.begin(), points.end(), kDegree, kDegree);
    const Point& outside = normals[i].normal;
    form.comply_wrt_given_normal(Kernel::Vector_3(outside[0], outside[1], outside[2]));
    // CGAL's curvatures are those of the height along the normal, negative where the boundary is convex.
    out[i].normal = to_point(form.normal_direction());
    out[i].kappa = {-form.principal_curvatures(1), -form.principal_curvatures(0)};
    out[i].directions = {to_point(form.minimal_principal_direction()), to_point(form.maximal_principal_direction())};
  }
  return out;
}
#else
bool have_jets() { return false; }

std::vector<MeshCurvature> jet_curvature(const Mesh&) { return {}; }
#endif

}  // namespace medial_vk::bench
