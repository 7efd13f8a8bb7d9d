// The graph of paths along a mesh.
#include "vertex_curvature/surface_graph.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/solids/solids.h"

namespace medial_vk {
namespace {

MeshView graphed(const Mesh& mesh) { return {mesh.vertices, mesh.triangles, {}, true}; }

double straight_line(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

TEST(SurfaceGraph, HasEveryVertexWhereEdgesAreLong) {
  const Mesh mesh = test::make_box({1, 1, 1});
  const SurfaceGraph graph(graphed(mesh), 0.5);
  ASSERT_EQ(graph.size(), 8u);
  std::size_t links = 0;
  for (std::uint32_t v = 0; v < 8; ++v) {
    EXPECT_EQ(graph.vertex(graph.node_of(v)), v);
    EXPECT_EQ(graph.path_to_node(v), 0);
    links += graph.links(graph.node_of(v)).size();
    for (const SurfaceGraph::Link& link : graph.links(graph.node_of(v))) {
      EXPECT_DOUBLE_EQ(link.length, straight_line(mesh.vertices[v], mesh.vertices[graph.vertex(link.node)]));
    }
  }
  EXPECT_EQ(links, 2u * 18);  // 12 edges of the box, and a diagonal of each face
}

/// Discs of half the distance around nodes of the unit sphere do not overlap by much, as paths are somewhat longer than
/// straight lines, and those of twice that radius cover it: some 4 / d^2 to 16 / d^2 nodes, however fine the mesh is.
TEST(SurfaceGraph, HasNoMoreNodesWhereEdgesAreShorter) {
  constexpr double kApart = 0.3;
  for (const std::uint32_t triangles : {8000u, 32000u}) {
    const Mesh mesh = test::make_sphere(1, triangles);
    const SurfaceGraph graph(graphed(mesh), kApart);
    EXPECT_GT(static_cast<double>(graph.size()), 4 / (kApart * kApart));
    EXPECT_LT(static_cast<double>(graph.size()), 1.5 * 16 / (kApart * kApart));
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
      EXPECT_LT(graph.path_to_node(v), kApart);
      const Point& node = mesh.vertices[graph.vertex(graph.node_of(v))];
      EXPECT_GE(graph.path_to_node(v), straight_line(mesh.vertices[v], node) - 1e-12);  // sums of edges are rounded
    }
    for (std::uint32_t node = 0; node < graph.size(); ++node) {
      EXPECT_GE(graph.links(node).size(), 3u);
      for (const SurfaceGraph::Link& link : graph.links(node)) {
        const Point &here = mesh.vertices[graph.vertex(node)], &there = mesh.vertices[graph.vertex(link.node)];
        EXPECT_GE(link.length, straight_line(here, there) - 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace medial_vk
