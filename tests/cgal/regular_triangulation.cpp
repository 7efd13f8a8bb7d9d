#include "cgal/regular_triangulation.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "ball_unions/unions/simplex_lists.h"

namespace medial_vk::test {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Regular_triangulation_vertex_base_3<Kernel>;
using Vertex = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel, VertexBase>;
using Cell = CGAL::Regular_triangulation_cell_base_3<Kernel>;
using Triangulation = CGAL::Regular_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<Vertex, Cell>>;
using NamedBall = std::pair<Kernel::Weighted_point_3, std::uint32_t>;

std::vector<NamedBall> named(std::span<const Ball> balls) {
  std::vector<NamedBall> result;
  for (std::uint32_t i = 0; i < balls.size(); ++i) {
    const auto& [c, r] = balls[i];
    result.push_back({{{c[0], c[1], c[2]}, r * r}, i});
  }
  return result;
}

/// Points far from all balls, so that the triangulation has tetrahedra even if all centres are in a plane. In the union
/// none of them is nearest, so the only simplices with one of them in the dual complex are these points themselves.
void add_far_points(std::span<const Ball> balls, std::vector<NamedBall>& points) {
  double reach = 1;
  for (const auto& [c, r] : balls) {
    reach = std::max({reach, std::fabs(c[0]) + r, std::fabs(c[1]) + r, std::fabs(c[2]) + r});
  }
  const auto first = static_cast<std::uint32_t>(balls.size());
  for (std::uint32_t k = 0; k < 4; ++k) {
    const double far = 16 * reach;
    const double x = k == 1 || k == 2 ? far : -far, y = k == 1 || k == 3 ? far : -far, z = k > 1 ? far : -far;
    points.push_back({{{x, y, z}, 0.0}, first + k});
  }
}

/// Determines the simplices of the triangulation that are in the complex: those whose smallest orthogonal sphere has no
/// real radius above 0 and holds no neighbour, and the faces of these (H. Edelsbrunner, E. P. Muecke,
/// "Three-Dimensional Alpha Shapes", 1994).
class Classifier {
 public:
  Classifier(const Triangulation& triangulation, std::uint32_t count)
      : triangulation_(triangulation),
        count_(count),
        compare_(triangulation.geom_traits().compare_weighted_squared_radius_3_object()) {}

  DualComplex run() {
    for (const auto c : triangulation_.finite_cell_handles()) consider_cell(c);
    for (const auto& facet : triangulation_.finite_facets()) consider_facet(facet);
    for (const auto& edge : triangulation_.finite_edges()) consider_edge(edge);
    for (const auto v : triangulation_.finite_vertex_handles()) {
      if (v->info() < count_ && triangulation_.is_Gabriel(v)) complex_.vertices.push_back(v->info());
    }
    std::vector<EnvelopeVertex> none;
    make_complete(complex_, none);
    return std::move(complex_);
  }

 private:
  using Handle = Triangulation::Vertex_handle;

  /// Gives the sorted names of the vertices; returns false if one of them is not a ball.
  template <std::size_t N>
  bool name(const std::array<Handle, N>& vertices, std::array<std::uint32_t, N>& names) const {
    for (std::size_t k = 0; k < N; ++k) names[k] = vertices[k]->info();
    std::sort(names.begin(), names.end());
    return names.back() < count_;
  }

  void consider_cell(const Triangulation::Cell_handle& c) {
    const std::array<Handle, 4> v = {c->vertex(0), c->vertex(1), c->vertex(2), c->vertex(3)};
    std::array<std::uint32_t, 4> names;
    if (!name(v, names)) return;
    if (compare_(v[0]->point(), v[1]->point(), v[2]->point(), v[3]->point(), 0) == CGAL::LARGER) return;
    complex_.tetrahedra.push_back(names);
  }

  void consider_facet(const Triangulation::Facet& facet) {
    std::array<Handle, 3> v;
    for (int k = 0; k < 3; ++k) v[k] = facet.first->vertex(Triangulation::vertex_triple_index(facet.second, k));
    std::array<std::uint32_t, 3> names;
    if (!name(v, names)) return;
    if (compare_(v[0]->point(), v[1]->point(), v[2]->point(), 0) == CGAL::LARGER) return;
    if (triangulation_.is_Gabriel(facet)) complex_.triangles.push_back(names);
  }

  void consider_edge(const Triangulation::Edge& edge) {
    const std::array<Handle, 2> v = {edge.first->vertex(edge.second), edge.first->vertex(edge.third)};
    std::array<std::uint32_t, 2> names;
    if (!name(v, names)) return;
    if (compare_(v[0]->point(), v[1]->point(), 0) == CGAL::LARGER) return;
    if (triangulation_.is_Gabriel(edge)) complex_.edges.push_back(names);
  }

  const Triangulation& triangulation_;
  std::uint32_t count_;
  Kernel::Compare_weighted_squared_radius_3 compare_;
  DualComplex complex_;
};

}  // namespace

DualComplex dual_complex_by_cgal(std::span<const Ball> balls) {
  std::vector<NamedBall> points = named(balls);
  add_far_points(balls, points);
  const Triangulation triangulation(points.begin(), points.end());
  return Classifier(triangulation, static_cast<std::uint32_t>(balls.size())).run();
}

std::size_t triangulate_by_cgal(std::span<const Ball> balls) {
  const std::vector<NamedBall> points = named(balls);
  return Triangulation(points.begin(), points.end()).number_of_vertices();
}

}  // namespace medial_vk::test
