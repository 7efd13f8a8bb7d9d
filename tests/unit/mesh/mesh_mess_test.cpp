// The results of prepare_mesh() for open and faulty meshes, and the meshes that it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "prepared.h"

namespace medial_vk {
namespace {

using namespace test;
using testing::Contains;
using testing::HasSubstr;

TEST(Prepare, OpenMeshesHaveAnInside) {
  Mesh mesh = make_sphere(1, 2000);
  mesh.triangles.erase(mesh.triangles.begin() + 100);
  mesh.triangles.erase(mesh.triangles.begin() + 700, mesh.triangles.begin() + 705);
  const std::size_t all = mesh.triangles.size();
  for (const Mesh& m : {mesh, over(mesh)}) {
    const PreparedMesh prepared = prepare(m);
    EXPECT_FALSE(prepared.report.closed);
    EXPECT_GT(prepared.report.signed_volume, 4);
    EXPECT_GT(prepared.report.trusted_triangles, all - 60);
    EXPECT_LT(prepared.report.trusted_triangles, all - 10);  // none at the holes' rims
    const std::uint64_t open = prepared.report.open_edges;
    EXPECT_THAT(prepared.report.assumptions,
                Contains(std::to_string(open) + " open edges: inside is where the winding number is at least 1/2."));
  }
  EXPECT_EQ(prepare(over(mesh)).report.reoriented_components, 1u);
}

TEST(Prepare, MessIsNeverTrusted) {
  // Two boxes that share an edge, two that share a corner, two that cross.
  const Mesh box = make_box({1, 1, 1});
  const PreparedMesh edge = prepare(together(box, moved(box, {1, 1, 0})));
  EXPECT_EQ(edge.report.non_manifold_edges, 1u);
  EXPECT_TRUE(edge.report.closed);
  EXPECT_EQ(edge.report.components, 1u);
  EXPECT_LT(edge.report.trusted_triangles, 24u);
  const PreparedMesh corner = prepare(together(box, moved(box, {1, 1, 1})));
  EXPECT_EQ(corner.report.non_manifold_vertices, 1u);
  EXPECT_EQ(corner.report.non_manifold_edges, 0u);
  EXPECT_EQ(corner.report.components, 2u);
  for (std::size_t i = 0; i < corner.flags.size(); ++i) {
    const Triangle& t = corner.mesh.triangles[i];
    const bool at_corner = std::any_of(t.begin(), t.end(), [&](std::uint32_t v) {
      return corner.mesh.vertices[v] == Point{1, 1, 1};
    });
    EXPECT_EQ(corner.flags[i], at_corner ? kUncrossed : kUncrossed | kTrustedNormal);
  }
  const Mesh spheres = together(make_sphere(1, 500), moved(make_sphere(1, 500), {1.03, 0.02, 0.01}));
  const PreparedMesh cross = prepare_mesh(spheres, {.keep_inner_faces = true}).value();
  EXPECT_GT(cross.report.intersecting_faces, 40u);
  EXPECT_GT(cross.report.faces_within, 50u);
  EXPECT_LE(cross.report.trusted_triangles, cross.report.triangles - cross.report.intersecting_faces - 50);
  EXPECT_GT(cross.report.trusted_triangles, cross.report.triangles / 2);
}

TEST(Prepare, MoebiusStripIsReported) {
  Mesh mesh;
  const std::uint32_t n = 40;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double u = 2 * std::numbers::pi * i / n;
    for (const double s : {-0.3, 0.3}) {
      const double r = 1 + s * std::cos(u / 2);
      mesh.vertices.push_back({r * std::cos(u), r * std::sin(u), s * std::sin(u / 2)});
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * i + 1, c = i + 1 < n ? a + 2 : 1, d = i + 1 < n ? b + 2 : 0;
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({c, d, b});
  }
  append(mesh, moved(make_box({1, 1, 1}), {5, 0, 0}));
  const PreparedMesh prepared = prepare(mesh);
  EXPECT_EQ(prepared.report.inconsistent_edges, 1u);
  EXPECT_EQ(prepared.report.minority_faces, 0u);
  EXPECT_GE(prepared.report.trusted_triangles, 12u);
}

TEST(Prepare, NothingEnclosedIsRefused) {
  Mesh sheet;
  sheet.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_THAT(refusal(sheet), HasSubstr("encloses nothing: with 4 open edges"));
  EXPECT_THAT(refusal(together(sheet, over(sheet))), HasSubstr("encloses nothing"));
  Mesh single = sheet;
  single.triangles.resize(1);
  EXPECT_THAT(refusal(single), HasSubstr("encloses nothing: with 3 open edges"));
  Mesh flat = sheet;  // a tetrahedron pressed flat: closed, every face has an area
  flat.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  EXPECT_EQ(refusal(flat), "the mesh encloses nothing: it is closed, but its volume is 0");
  rotate(flat, {1, 2, 3}, 0.5);
  EXPECT_THAT(refusal(flat), HasSubstr("encloses nothing"));
  // A thin solid, in contrast, is accepted.
  EXPECT_TRUE(prepare_mesh(make_box({1, 1, 1e-9})).ok());
}

TEST(Prepare, BadInputIsRefused) {
  EXPECT_THAT(refusal(Mesh()), HasSubstr("no triangles"));
  Mesh mesh = make_box({1, 1, 1});
  mesh.triangles[4][1] = 99;
  EXPECT_EQ(refusal(mesh), "face 4 uses vertex 99 of 8");
  mesh = make_box({1, 1, 1});
  mesh.vertices[3][1] = std::nan("");
  EXPECT_EQ(refusal(mesh), "vertex 3 has the coordinate nan");
  mesh = make_box({1, 0, 0});
  EXPECT_EQ(refusal(mesh), "no triangle has an area (of 12)");
}

TEST(Prepare, SameInputSameOutput) {
  Mesh mesh = together(make_sphere(1, 3000), moved(over(make_torus(1, 0.3, 20, 40)), {0.4, 0.1, 0.2}));
  mesh.triangles.resize(mesh.triangles.size() - 30);
  const PreparedMesh a = prepare(mesh), b = prepare(mesh);
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  EXPECT_EQ(a.flags, b.flags);
  EXPECT_EQ(a.report.assumptions, b.report.assumptions);
}

}  // namespace
}  // namespace medial_vk
