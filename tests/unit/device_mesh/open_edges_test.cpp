// The open edges of a mesh: with the triangles to their apexes the mesh is closed, so its winding numbers are whole.
#include "device_mesh/open_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "base/point_ops.h"
#include "support/solids/solids.h"
#include "unit/device_mesh/xyz.h"

namespace medial_vk {
namespace {

std::vector<gpu::OpenEdge> open_edges_of(const Mesh& mesh) {
  return find_open_edges(test::view_of(mesh, false), {{0, 0, 0}, 1}, 1000).listed;
}

double solid_angle(const Point& p, const Point& a, const Point& b, const Point& c) {
  const Point x = a - p, y = b - p, z = c - p;
  const double lx = length(x), ly = length(y), lz = length(z);
  return 2 * std::atan2(dot(x, cross(y, z)), lx * ly * lz + dot(x, y) * lz + dot(y, z) * lx + dot(z, x) * ly);
}

double closed_winding_number(const Mesh& mesh, const std::vector<gpu::OpenEdge>& edges, const Point& p) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles)
    sum += solid_angle(p, mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
  for (const gpu::OpenEdge& e : edges) sum += double{e.from.w} * solid_angle(p, xyz(e.from), xyz(e.to), xyz(e.apex));
  return sum / (4 * std::numbers::pi);
}

// Vertices on a grid that float represents exactly, so that the mesh and its closing triangles fit without a gap.
Mesh box() { return test::make_box({1, 0.5, 0.25}); }

void expect_whole(const Mesh& mesh) {
  const std::vector<gpu::OpenEdge> edges = open_edges_of(mesh);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(-0.3, 1.3);
  for (int i = 0; i < 200; ++i) {
    const double w = closed_winding_number(mesh, edges, {coordinate(random), coordinate(random), coordinate(random)});
    EXPECT_NEAR(w, std::round(w), 1e-6);
  }
}

TEST(OpenEdges, AClosedMeshHasNone) {
  EXPECT_TRUE(open_edges_of(box()).empty());
  EXPECT_TRUE(open_edges_of(test::make_torus(1, 0.4, 20, 10)).empty());
}

TEST(OpenEdges, AHoleIsClosedByAFan) {
  Mesh mesh = box();
  mesh.triangles.pop_back();
  EXPECT_EQ(open_edges_of(mesh).size(), 3u);
  expect_whole(mesh);
  mesh.triangles.erase(mesh.triangles.begin());
  expect_whole(mesh);
}

TEST(OpenEdges, ATurnedTriangleCountsTwice) {
  Mesh mesh = box();
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  const auto edges = open_edges_of(mesh);
  ASSERT_EQ(edges.size(), 3u);
  for (const gpu::OpenEdge& e : edges) EXPECT_EQ(e.from.w, 2);
  expect_whole(mesh);
}

TEST(OpenEdges, AFinOnANonManifoldEdge) {
  Mesh mesh = box();
  mesh.vertices.push_back({2, 2, 2});
  mesh.triangles.push_back({mesh.triangles[0][0], mesh.triangles[0][1], static_cast<std::uint32_t>(8)});
  expect_whole(mesh);
}

TEST(OpenEdges, EveryHoleHasItsApex) {
  Mesh mesh = box();
  Mesh other = box();
  test::translate(other, {2, 0, 0});
  mesh.triangles.pop_back();
  other.triangles.pop_back();
  test::append(mesh, other);
  const auto edges = open_edges_of(mesh);
  ASSERT_EQ(edges.size(), 6u);
  std::set<float> apexes;
  for (const gpu::OpenEdge& e : edges) apexes.insert(e.apex.x);
  EXPECT_EQ(apexes.size(), 2u);
  EXPECT_LE(*apexes.begin(), 1);
  EXPECT_GE(*apexes.rbegin(), 2);
  expect_whole(mesh);
}

TEST(OpenEdges, AreCountedWhereTheyAreTooManyToList) {
  Mesh mesh = box();
  mesh.triangles.pop_back();
  const OpenEdges edges = find_open_edges(test::view_of(mesh, false), {}, 2);
  EXPECT_EQ(edges.count, 3u);
  EXPECT_TRUE(edges.listed.empty());
}

TEST(OpenEdges, AnEdgeFromAVertexToItselfIsNone) {
  Mesh mesh = box();
  mesh.triangles.push_back({1, 1, 2});
  EXPECT_TRUE(open_edges_of(mesh).empty());
}

TEST(OpenEdges, LieInTheUnitBox) {
  Mesh mesh = box();
  mesh.triangles.pop_back();
  for (const gpu::OpenEdge& e : find_open_edges(test::view_of(mesh, false), {{-1, -1, -1}, 4}, 1000).listed) {
    EXPECT_GE(e.from.x, 0.25f);
    EXPECT_LE(e.from.x, 0.5f);
  }
}

}  // namespace
}  // namespace medial_vk
