// Clean, oriented, with a defined inside: the results of prepare_mesh() for meshes that enclose a solid, and its
// messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "prepared.h"

namespace medial_vk {
namespace {

using namespace test;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

/// Every triangle with its own three vertices, as STL and meshes with hard edges have them.
Mesh exploded(const Mesh& mesh) {
  Mesh soup;
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t v : t) soup.vertices.push_back(mesh.vertices[v]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

TEST(Prepare, GoodSolidsPassUnchanged) {
  for (Mesh mesh :
       {make_box({1, 2, 3}), make_sphere(1, 2000), make_capsule(1, 3, 30), make_ellipsoid({3, 2, 1}, 40),
        make_l_shape(4, 1, 2), make_cup(2, 0.1, 3, 40), make_torus(2, 0.7, 20, 50), make_plate_with_hole(4, 0.01, 1)}) {
    rotate(mesh, {1, 2, 3}, 0.4);
    const PreparedMesh prepared = prepare(mesh);
    const MeshReport& r = prepared.report;
    EXPECT_EQ(prepared.mesh.vertices, mesh.vertices);
    EXPECT_EQ(prepared.mesh.triangles, mesh.triangles);
    EXPECT_TRUE(r.closed);
    EXPECT_THAT(r.assumptions, IsEmpty());
    EXPECT_EQ(r.trusted_triangles, mesh.triangles.size());
    EXPECT_EQ(r.components, 1u);
    EXPECT_EQ(r.intersecting_faces, 0u);
    EXPECT_NEAR(r.signed_volume, signed_volume(mesh), 1e-12 * r.signed_volume);
    for (std::uint32_t i = 0; i < prepared.input_of_triangle.size(); ++i) EXPECT_EQ(prepared.input_of_triangle[i], i);
    EXPECT_TRUE(prepared.view().closed);
  }
}

TEST(Prepare, ScaleAndPlaceDoNotMatter) {
  for (const double factor : {1e-30, 1e-6, 1.0, 1e6, 1e30}) {
    for (const double offset : {0.0, 1e6}) {
      Mesh mesh = together(make_torus(2, 0.7, 20, 50), moved(make_sphere(0.3, 300), {5, 0, 0}));
      rotate(mesh, {1, 2, 3}, 0.4);
      translate(mesh, {offset, -offset, offset});
      scale(mesh, factor);
      const PreparedMesh prepared = prepare(mesh);
      EXPECT_EQ(prepared.mesh.vertices, mesh.vertices);  // bit by bit
      EXPECT_EQ(prepared.report.trusted_triangles, mesh.triangles.size());
      EXPECT_TRUE(prepared.report.closed);
    }
  }
  Mesh huge = make_box({1, 1, 1});
  scale(huge, 1e60);
  EXPECT_THAT(refusal(huge), HasSubstr("the mesh is 1e+60 units long"));
}

TEST(Prepare, FarFromTheOriginIsRefusedWhereDoublesEnd) {
  Mesh near = make_box({1, 1, 1}), far = near;
  translate(near, {0x1p30 - 1, 0, 0});
  EXPECT_TRUE(prepare(near).report.closed);
  translate(far, {0x1p30, 0, 0});
  EXPECT_THAT(refusal(far), HasSubstr("the mesh is 1 units long and lies 1.07374e+09 from the origin"));
}

TEST(Prepare, CoordinatesWhoseProductsOverflowAreRefused) {
  for (const double x : {1e71, -1e160, 1e300}) {
    Mesh mesh = make_box({1, 1, 1});
    mesh.vertices[3][1] = x;
    EXPECT_THAT(refusal(mesh), HasSubstr("vertex 3 has the coordinate"));
    mesh.vertices.push_back(mesh.vertices[3]);
    mesh.vertices[3] = make_box({1, 1, 1}).vertices[3];
    EXPECT_TRUE(prepare(mesh).report.closed);  // a vertex of no face does not matter
  }
  Mesh mesh = make_box({1, 1, 1});
  mesh.vertices[3][1] = 1e70;
  EXPECT_THAT(refusal(mesh), HasSubstr("the mesh is 1e+70 units long"));
}

TEST(Prepare, EqualVerticesBecomeOne) {
  const PreparedMesh prepared = prepare(exploded(make_box({1, 2, 3})));
  EXPECT_TRUE(prepared.report.closed);
  EXPECT_EQ(prepared.report.merged_vertices, 28u);
  EXPECT_EQ(prepared.mesh.vertices.size(), 8u);
  EXPECT_EQ(prepared.vertex_of_input.size(), 36u);
  EXPECT_THAT(prepared.report.assumptions, Contains("28 vertices at exactly the same place as another: taken as one."));
  // 0 and -0 are one coordinate; all other values differ.
  Mesh zero = exploded(make_box({1, 2, 3}));
  for (std::size_t i = 0; i < zero.vertices.size(); i += 2) {
    for (double& x : zero.vertices[i]) x = x == 0 ? -0.0 : x;
  }
  EXPECT_EQ(prepare(zero).mesh.vertices.size(), 8u);
}

TEST(Prepare, UnusedVerticesDoNotCount) {
  Mesh mesh = make_box({1, 1, 1});
  mesh.vertices.insert(mesh.vertices.begin(), {1e9, 1e9, 1e9});
  for (Triangle& t : mesh.triangles) t = {t[0] + 1, t[1] + 1, t[2] + 1};
  const PreparedMesh prepared = prepare(mesh);
  EXPECT_EQ(prepared.report.upper, (Point{1, 1, 1}));
  EXPECT_EQ(prepared.report.unused_vertices, 1u);
  EXPECT_EQ(prepared.vertex_of_input[0], PreparedMesh::kDropped);
  EXPECT_EQ(prepared.vertex_of_input[1], 0u);
}

TEST(Prepare, DegenerateFacesAreDroppedAndCounted) {
  Mesh mesh = make_box({1, 1, 1});
  mesh.triangles.insert(mesh.triangles.begin() + 3, {2, 2, 5});
  mesh.triangles.push_back({1, 4, 1});
  mesh.short_polygons = 2;
  const PreparedMesh prepared = prepare(mesh);
  EXPECT_EQ(prepared.report.degenerates_dropped, 4u);
  EXPECT_TRUE(prepared.report.closed);
  EXPECT_EQ(prepared.mesh.triangles, make_box({1, 1, 1}).triangles);
  EXPECT_EQ(prepared.input_of_triangle[3], 4u);
}

/// The unit box with a vertex 8 at `middle` on its side {0, 1}: both faces there cut in two, or only the first, and a
/// third face {0, 1, 8} or {1, 0, 8} closes the gap.
Mesh box_with_cut_side(const Point& middle, bool with_cap) {
  Mesh mesh = make_box({1, 1, 1});
  mesh.vertices.push_back(middle);
  std::vector<Triangle> triangles;
  bool has_cap = !with_cap;
  for (const Triangle& t : mesh.triangles) {
    int at = 0;
    while (at < 3 && (t[at] > 1 || t[(at + 1) % 3] > 1)) ++at;
    const std::uint32_t a = t[at % 3], b = t[(at + 1) % 3], apex = t[(at + 2) % 3];
    if (at == 3 || (has_cap && with_cap)) {
      triangles.push_back(t);
    } else {
      triangles.push_back({a, 8, apex});
      triangles.push_back({8, b, apex});
      if (!has_cap) triangles.push_back({a, b, 8});
      has_cap = true;
    }
  }
  mesh.triangles = triangles;
  return mesh;
}

TEST(Prepare, ACornerInsideASideLeavesNoCrack) {
  for (const double angle : {0.0, 0.7}) {
    Mesh mesh = box_with_cut_side({0.5, 0, 0}, true);
    ASSERT_EQ(mesh.triangles.size(), 14u);
    rotate(mesh, {1, 2, 3}, angle);  // then in the middle only up to rounding
    const PreparedMesh prepared = prepare(mesh);
    EXPECT_TRUE(prepared.report.closed);
    EXPECT_EQ(prepared.report.caps_repaired, 1u);
    EXPECT_EQ(prepared.report.degenerates_dropped, 1u);
    EXPECT_EQ(prepared.report.triangles, 14u);
    EXPECT_EQ(prepared.report.trusted_triangles, 14u);
    EXPECT_NEAR(prepared.report.signed_volume, 1, 1e-12);
  }
}

TEST(Prepare, NeedlesSurvive) {
  const PreparedMesh cap = prepare(box_with_cut_side({0.5, -1e-8, 0}, true));  // a face of aspect 1e8
  EXPECT_EQ(cap.report.triangles, 14u);
  EXPECT_EQ(cap.report.degenerates_dropped, 0u);
  EXPECT_EQ(prepare(box_with_cut_side({0.5, -1e-8, 0}, false)).report.trusted_triangles, 14u);
  Mesh needle;
  needle.vertices = {{0, 0, 0}, {1, 0, 0}, {0.5, 1e-8, 0}, {0.5, 0, 1e-8}};
  needle.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  for (const double offset : {0.0, 0.3}) {
    const PreparedMesh prepared = prepare(moved(needle, {offset, offset, 0}));
    EXPECT_EQ(prepared.report.triangles, 4u);
    EXPECT_EQ(prepared.report.degenerates_dropped, 0u);
    EXPECT_TRUE(prepared.report.closed);
  }
}

TEST(Prepare, DuplicatesKeepTheFirst) {
  Mesh mesh = make_box({1, 1, 1});
  mesh.triangles.push_back(mesh.triangles[5]);
  mesh.triangles.push_back({mesh.triangles[7][1], mesh.triangles[7][2], mesh.triangles[7][0]});
  mesh.triangles.push_back({mesh.triangles[2][1], mesh.triangles[2][0], mesh.triangles[2][2]});
  const PreparedMesh prepared = prepare(mesh);
  EXPECT_EQ(prepared.report.duplicates_dropped + prepared.report.inner_walls_dropped, 3u);
  EXPECT_EQ(prepared.mesh.triangles, make_box({1, 1, 1}).triangles);
}

TEST(Prepare, EverythingTwice) {
  Mesh mesh = make_sphere(1, 200);
  append(mesh, over(mesh));  // two-sided, as modellers export for display
  const PreparedMesh prepared = prepare(mesh);
  EXPECT_TRUE(prepared.report.closed);
  EXPECT_EQ(prepared.report.triangles, mesh.triangles.size() / 2);
  EXPECT_EQ(prepared.report.duplicates_dropped, mesh.triangles.size() / 2);
  EXPECT_EQ(prepared.report.inner_walls_dropped, 0u);
  EXPECT_GT(prepared.report.signed_volume, 0);
}

// Other triangles at the same position: they are no duplicates, and are kept.
TEST(Prepare, FacesThatOverlapAreNotTrusted) {
  const Mesh box = make_box({1, 1, 1});
  Mesh half = make_box({0.5, 0.5, 0.5});  // within the box, three of its sides on the box's
  const PreparedMesh prepared = prepare_mesh(together(box, half), {.keep_inner_faces = true}).value();
  EXPECT_EQ(prepared.report.duplicates_dropped, 0u);
  EXPECT_EQ(prepared.report.triangles, 24u);
  EXPECT_GE(prepared.report.intersecting_faces, 12u);
  EXPECT_LE(prepared.report.trusted_triangles, 12u);
  EXPECT_TRUE(prepared.report.closed);
}

TEST(Prepare, TouchingSolidsBecomeOne) {
  // 2 x 2 x 1 cubes, all side by side: the walls between them are there twice, back to back.
  Mesh mesh;
  for (const double x : {0.0, 1.0}) {
    for (const double y : {0.0, 1.0}) {
      Mesh cube = make_box({1, 1, 1});
      // The same diagonal on both sides of a wall.
      if (x == 1) {
        for (Point& p : cube.vertices) p[0] = 1 - p[0];
        turn_over(cube);
      }
      if (y == 1) {
        for (Point& p : cube.vertices) p[1] = 1 - p[1];
        turn_over(cube);
      }
      append(mesh, moved(cube, {x, y, 0}));
    }
  }
  const PreparedMesh prepared = prepare(mesh);
  EXPECT_EQ(prepared.report.inner_walls_dropped, 16u);
  EXPECT_EQ(prepared.report.triangles, 32u);
  EXPECT_TRUE(prepared.report.closed);
  EXPECT_EQ(prepared.report.trusted_triangles, 32u);
  EXPECT_NEAR(prepared.report.signed_volume, 4, 1e-12);
  EXPECT_THAT(prepared.report.assumptions, Contains(HasSubstr("16 faces between two solids that touch")));
}

TEST(Prepare, OrientationByMajority) {
  std::mt19937 random(3);
  for (const unsigned percent : {5u, 45u, 60u, 100u}) {
    Mesh mesh = make_torus(2, 0.7, 20, 50);
    std::uint64_t turned = 0;
    for (Triangle& t : mesh.triangles) {
      if (random() % 100 >= percent) continue;
      std::swap(t[0], t[1]);
      ++turned;
    }
    const PreparedMesh prepared = prepare(mesh);
    EXPECT_EQ(prepared.report.minority_faces, std::min<std::uint64_t>(turned, mesh.triangles.size() - turned));
    EXPECT_EQ(prepared.report.inside_out, percent > 50);
    EXPECT_TRUE(prepared.report.closed);
    EXPECT_EQ(prepared.report.inconsistent_edges, 0u);
    EXPECT_NEAR(prepared.report.signed_volume, signed_volume(make_torus(2, 0.7, 20, 50)), 1e-10);
    EXPECT_EQ(prepared.report.trusted_triangles, mesh.triangles.size());
  }
  const PreparedMesh turned = prepare(over(make_box({1, 1, 1})));
  EXPECT_EQ(turned.report.reoriented_faces, 12u);
  EXPECT_THAT(turned.report.assumptions, Contains("The mesh was inside out: all 12 faces were turned over."));
}

TEST(Prepare, CavitiesStay) {
  const Mesh mesh = together(make_sphere(2, 500), over(make_sphere(1, 500)));
  for (const Mesh& m : {mesh, over(mesh)}) {
    const PreparedMesh prepared = prepare(m);
    EXPECT_EQ(prepared.mesh.triangles, mesh.triangles);
    EXPECT_EQ(prepared.report.components, 2u);
    EXPECT_EQ(prepared.report.trusted_triangles, mesh.triangles.size());
    EXPECT_EQ(prepared.report.reoriented_components, 0u);
  }
}

TEST(Prepare, AnInsideOutNeighbourIsTurned) {
  // Two balls side by side, one of them inside out with a cavity that is inside out too; and a shell within a ball.
  Mesh mesh = together(make_sphere(2, 500), moved(over(make_sphere(1, 300)), {4, 0, 0}));
  append(mesh, moved(make_sphere(0.5, 100), {4, 0, 0}));
  append(mesh, moved(make_sphere(0.5, 100), {0, 0, 0}));
  const PreparedMesh prepared = prepare_mesh(mesh, {.keep_inner_faces = true}).value();
  EXPECT_EQ(prepared.report.reoriented_components, 2u);
  EXPECT_EQ(prepared.report.faces_within, make_sphere(0.5, 100).triangles.size());
  EXPECT_EQ(prepared.report.trusted_triangles, mesh.triangles.size() - prepared.report.faces_within);
  EXPECT_THAT(prepared.report.assumptions, Contains(HasSubstr("2 components that were inside out")));
  EXPECT_THAT(prepared.report.assumptions, Contains(HasSubstr("with the inside on both sides")));
}

}  // namespace
}  // namespace medial_vk
