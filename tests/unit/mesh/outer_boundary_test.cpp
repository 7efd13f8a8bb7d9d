// Meshes of overlapping parts become the boundary of their union: volumes are exact, sides stay, walls inside go.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/point_ops.h"
#include "mesh/outer_boundary.h"
#include "mesh/winding/winding_number.h"
#include "unit/mesh/prepared.h"

namespace medial_vk {
namespace {

using namespace test;

/// A box whose corner is at `at`.
struct Box {
  Point at, size;
};

Mesh mesh_of(const std::vector<Box>& boxes) {
  Mesh mesh;
  for (const Box& box : boxes) append(mesh, moved(make_box(box.size), box.at));
  return mesh;
}

/// The volume of a union of boxes, by the cells between all their sides.
double union_volume(const std::vector<Box>& boxes) {
  std::array<std::vector<double>, 3> cuts;
  for (const Box& box : boxes) {
    for (std::size_t k = 0; k < 3; ++k) cuts[k].insert(cuts[k].end(), {box.at[k], box.at[k] + box.size[k]});
  }
  for (std::vector<double>& list : cuts) std::ranges::sort(list);
  double volume = 0;
  for (std::size_t i = 1; i < cuts[0].size(); ++i) {
    for (std::size_t j = 1; j < cuts[1].size(); ++j) {
      for (std::size_t l = 1; l < cuts[2].size(); ++l) {
        const Point middle = {(cuts[0][i - 1] + cuts[0][i]) / 2, (cuts[1][j - 1] + cuts[1][j]) / 2,
                              (cuts[2][l - 1] + cuts[2][l]) / 2};
        const bool is_inside = std::ranges::any_of(boxes, [&](const Box& box) {
          bool inside = true;
          for (std::size_t k = 0; k < 3; ++k)
            inside = inside && middle[k] > box.at[k] && middle[k] < box.at[k] + box.size[k];
          return inside;
        });
        if (is_inside)
          volume += (cuts[0][i] - cuts[0][i - 1]) * (cuts[1][j] - cuts[1][j - 1]) * (cuts[2][l] - cuts[2][l - 1]);
      }
    }
  }
  return volume;
}

/// New vertices are exact up to their rounding in general position. Where faces coincide, they are those of vertices
/// moved by at most 2^-32 of the longest side (cut_crossings.h), which changes the volume by at most that times the
/// area.
void expect_union(const PreparedMesh& prepared, double volume, double tolerance) {
  const MeshReport& report = prepared.report;
  EXPECT_TRUE(report.closed);
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(report.faces_within, 0u);
  EXPECT_GT(report.cut_faces, 0u);
  EXPECT_GT(report.inner_faces, 0u);
  EXPECT_NEAR(report.signed_volume, volume, tolerance);
}

TEST(OuterBoundary, OfBoxesInGeneralPosition) {
  const std::vector<Box> boxes = {
      {{0, 0, 0}, {1, 1, 1}}, {{0.4, 0.3, 0.2}, {1, 1, 1}}, {{0.23, -0.37, 0.51}, {1, 1, 1}}};
  for (std::size_t count = 2; count <= boxes.size(); ++count) {
    const std::vector<Box> some(boxes.begin(), boxes.begin() + static_cast<std::ptrdiff_t>(count));
    const PreparedMesh prepared = prepare(mesh_of(some));
    expect_union(prepared, union_volume(some), 1e-13);
    EXPECT_EQ(prepared.report.intersecting_faces, 0u);
    EXPECT_EQ(prepared.report.trusted_triangles, prepared.report.triangles);
  }
}

TEST(OuterBoundary, OfRandomBoxes) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> at(0, 1), size(0.3, 0.9);
  for (int round = 0; round < 8; ++round) {
    std::vector<Box> boxes = {{{0.2, 0.2, 0.2}, {1.3, 1.3, 1.3}}};
    for (int i = 0; i < 7; ++i)
      boxes.push_back({{at(random), at(random), at(random)}, {size(random), size(random), size(random)}});
    Mesh mesh = mesh_of(boxes);
    rotate(mesh, {1, 2, 3}, 0.1 * round);
    const PreparedMesh prepared = prepare(mesh);
    EXPECT_TRUE(prepared.report.closed);
    EXPECT_NEAR(prepared.report.signed_volume, union_volume(boxes), 1e-12);
  }
}

TEST(OuterBoundary, OfBoxesWithFacesInOnePlane) {
  const std::vector<Box> boxes = {{{0, 0, 0}, {1, 1, 1}}, {{0.4, 0, 0}, {1, 1, 1}}};
  expect_union(prepare(mesh_of(boxes)), 1.4, 7.6 * 0x1p-32 * 1.4);
}

TEST(OuterBoundary, JoinsBoxesThatTouch) {
  const std::vector<Box> boxes = {{{0, 0, 0}, {1, 1, 1}}, {{1, 0.25, 0.25}, {0.5, 0.5, 0.5}}};
  expect_union(prepare(mesh_of(boxes)), 1.125, 7 * 0x1p-32 * 1.5);
}

// A tube that is open inside a sphere closes by the sphere.
TEST(OuterBoundary, OpenEndsInsideGo) {
  Mesh tube = make_capsule(0.3, 2, 40);
  std::erase_if(tube.triangles, [&](const Triangle& t) {
    return std::ranges::any_of(t, [&](std::uint32_t v) { return tube.vertices[v][2] < -1; });
  });
  const PreparedMesh prepared = prepare(together(moved(tube, {0.01, 0.02, 1.1}), make_sphere(0.8, 3000)));
  EXPECT_TRUE(prepared.report.closed);
  EXPECT_EQ(prepared.report.open_edges, 0u);
  EXPECT_EQ(prepared.report.components, 1u);
  EXPECT_EQ(prepared.report.intersecting_faces, 0u);
}

TEST(OuterBoundary, SidesStay) {
  Mesh mesh = make_sphere(1, 2000);
  for (int i = 0; i < 6; ++i) {
    Mesh other = make_sphere(0.7, 500);
    rotate(other, {1, 2, 3}, i);
    append(mesh, moved(other, {std::cos(1.1 * i), std::sin(1.1 * i), 0.2 * i - 0.5}));
  }
  const PreparedMesh prepared = prepare(mesh);
  EXPECT_TRUE(prepared.report.closed);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-2, 2);
  int inside = 0;
  for (int i = 0; i < 400; ++i) {
    const Point p = {coordinate(random), coordinate(random), coordinate(random)};
    const bool is_inside = exact_winding_number(mesh, p) >= 0.5;
    inside += is_inside;
    EXPECT_EQ(exact_winding_number(prepared.mesh, p) >= 0.5, is_inside);
  }
  EXPECT_GT(inside, 20);
}

TEST(OuterBoundary, ASolidInsideAnotherGoes) {
  const PreparedMesh prepared = prepare(together(make_sphere(1, 500), make_sphere(0.3, 200)));
  EXPECT_EQ(prepared.report.triangles, make_sphere(1, 500).triangles.size());
  EXPECT_EQ(prepared.report.inner_faces, make_sphere(0.3, 200).triangles.size());
}

TEST(OuterBoundary, ACavityStays) {
  const PreparedMesh prepared = prepare(together(make_sphere(1, 500), over(make_sphere(0.3, 200))));
  EXPECT_EQ(prepared.report.inner_faces, 0u);
  EXPECT_EQ(prepared.report.components, 2u);
}

TEST(OuterBoundary, ACavityStaysWhereOtherPartsCross) {
  const Mesh shell = together(make_sphere(1, 500), over(make_sphere(0.3, 200)));
  const PreparedMesh prepared = prepare(together(shell, moved(make_sphere(0.5, 300), {1.1, 0.05, 0.02})));
  EXPECT_TRUE(prepared.report.closed);
  EXPECT_GT(prepared.report.inner_faces, 0u);
  EXPECT_EQ(prepared.report.components, 2u);
  EXPECT_LT(exact_winding_number(prepared.mesh, {0, 0, 0}), 0.5);
  EXPECT_GT(exact_winding_number(prepared.mesh, {0, 0, 0.6}), 0.5);
}

/// A square tube along x, open at both ends, about the line y = 0.51, z = 0.52.
Mesh tube(double from, double to, double width) {
  Mesh mesh = moved(make_box({to - from, width, width}), {from, 0.51 - width / 2, 0.52 - width / 2});
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    return std::ranges::all_of(t, [&](std::uint32_t v) { return mesh.vertices[v][0] == mesh.vertices[t[0]][0]; });
  });
  return mesh;
}

TEST(OuterBoundary, HolesInsideOtherPartsAreFilled) {
  const Mesh cubes = mesh_of({{{0, 0, 0}, {1, 1, 1}}, {{2, 0, 0}, {1, 1, 1}}});
  const PreparedMesh prepared = prepare(together(cubes, tube(0.5, 2.5, 0.4)));
  expect_union(prepared, 2 + 0.4 * 0.4, 1e-12);
  EXPECT_EQ(prepared.report.hidden_open_edges, 8u);
  // The tube's eight triangles, and two of each cube.
  EXPECT_EQ(prepared.report.cut_faces, 12u);
}

TEST(OuterBoundary, HolesOutsideStay) {
  const Mesh cube = mesh_of({{{0, 0, 0}, {1, 1, 1}}});
  const PreparedMesh prepared = prepare(together(cube, tube(0.5, 2.5, 0.4)));
  EXPECT_EQ(prepared.report.hidden_open_edges, 4u);
  EXPECT_EQ(prepared.report.open_edges, 4u);
  EXPECT_EQ(prepared.report.faces_within, 0u);
  EXPECT_GT(prepared.report.inner_faces, 0u);
}

/// A thin tube along y, about the line x, z = 0.52, open at both ends, of which one is at y = 0.51.
Mesh tube_aside(double x) {
  Mesh mesh = over(tube(0.51, 2, 0.1));
  for (Point& p : mesh.vertices) p = {p[1] + x - 0.51, p[0], p[2]};
  return mesh;
}

// A thin tube begins in a wide one, whose end is open: next to that end the winding number is too low for the hole of
// the thin tube to lie inside.
TEST(OuterBoundary, HolesNextToOpenEndsStay) {
  const Mesh part = together(tube(0, 1, 0.4), mesh_of({{{-0.5, 0, 0}, {1, 1, 1}}}));
  EXPECT_EQ(prepare(together(part, tube_aside(0.7))).report.hidden_open_edges, 8u);
  EXPECT_EQ(prepare(together(part, tube_aside(0.945))).report.hidden_open_edges, 4u);
}

/// A square of this half width in the plane y = `at`, about x = 0.52, z = 0.55.
Mesh plate(double at, double half) {
  Mesh mesh;
  for (const auto& [x, z] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
    mesh.vertices.push_back({0.52 + x * half, at, 0.55 + z * half});
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

TEST(OuterBoundary, OfAPlateThroughACubeIsTheCube) {
  const Mesh mesh = together(mesh_of({{{0, 0, 0}, {1, 1, 1}}}), plate(0.4, 0.8));
  const PreparedMesh prepared = prepare(mesh);
  expect_union(prepared, 1, 1e-12);
  EXPECT_GT(prepared.report.inner_faces, 0u);
  EXPECT_GT(prepared.report.outer_faces, 0u);
  const MeshReport kept = prepare_mesh(mesh, {.keep_outer_faces = true}).value().report;
  EXPECT_EQ(kept.inner_faces, prepared.report.inner_faces);
  EXPECT_EQ(kept.outer_faces, 0u);
  EXPECT_FALSE(kept.closed);
  EXPECT_DOUBLE_EQ(kept.upper[0], 1.32);
}

// Beside the plate the winding number is too low by up to 1/2, as if faces there bounded the solid.
TEST(OuterBoundary, FacesBesideAPlateGo) {
  const std::vector<Box> boxes = {{{0, 0, 0}, {1, 1, 1}}, {{0.3, 0.42, 0.31}, {0.43, 0.8, 0.37}}};
  const PreparedMesh prepared = prepare(together(mesh_of(boxes), plate(0.4, 0.8)));
  expect_union(prepared, 1 + 0.43 * 0.37 * 0.22, 1e-12);
}

// Six squares with gaps between them enclose a cube.
TEST(OuterBoundary, SidesThatEncloseTogetherStay) {
  Mesh sides;
  for (const Mesh& side : {plate(0.01, 0.5), over(plate(1.03, 0.5))}) append(sides, side);
  for (int turn = 1; turn < 3; ++turn) {
    for (Mesh side : {plate(0.01, 0.5), over(plate(1.03, 0.5))}) {
      for (Point& p : side.vertices) std::rotate(p.begin(), p.begin() + turn, p.end());
      append(sides, side);
    }
  }
  const PreparedMesh prepared = prepare(together(sides, moved(make_box({0.2, 0.2, 0.2}), {0.93, 0.4, 0.4})));
  EXPECT_EQ(prepared.report.outer_faces, 0u);
  EXPECT_GT(exact_winding_number(prepared.mesh, {0.52, 0.52, 0.52}), 0.9);
}

/// A box without its upper face, which a small box crosses, and a lid this far above it.
Mesh box_with_lid(double gap) {
  Mesh box = make_box({1, 1, 1});
  std::erase_if(box.triangles, [&](const Triangle& t) {
    return std::ranges::all_of(t, [&](std::uint32_t v) { return box.vertices[v][2] == 1; });
  });
  Mesh lid;
  lid.vertices = {{-0.1, -0.1, 1 + gap}, {1.1, -0.1, 1 + gap}, {1.1, 1.1, 1 + gap}, {-0.1, 1.1, 1 + gap}};
  lid.triangles = {{0, 1, 2}, {0, 2, 3}};
  const Mesh knob = moved(make_box({0.2, 0.23, 0.2}), {0.37, 0.41, 0.9 + gap});
  return together(together(box, lid), knob);
}

// The lid is flat, but where it lies the winding number of the box alone is neither that of the inside nor of the
// outside.
TEST(OuterBoundary, ALidStays) {
  const PreparedMesh prepared = prepare(box_with_lid(0.15));
  EXPECT_EQ(prepared.report.outer_faces, 0u);
  EXPECT_GT(exact_winding_number(prepared.mesh, {0.2, 0.2, 1}), 0.7);
}

TEST(OuterBoundary, APlateThatCrossesNothingStays) {
  const std::vector<Box> boxes = {{{0, 0, 0}, {1, 1, 1}}, {{0.4, 0.3, 0.2}, {1, 1, 1}}};
  const PreparedMesh prepared = prepare(together(mesh_of(boxes), plate(3, 0.8)));
  EXPECT_EQ(prepared.report.outer_faces, 0u);
  EXPECT_DOUBLE_EQ(prepared.report.upper[1], 3);
}

// Half of a sphere is open, but not flat.
TEST(OuterBoundary, ABowlStays) {
  Mesh bowl = make_sphere(0.8, 1000);
  std::erase_if(bowl.triangles, [&](const Triangle& t) {
    return std::ranges::any_of(t, [&](std::uint32_t v) { return bowl.vertices[v][2] > 0.01; });
  });
  const PreparedMesh prepared = prepare(together(mesh_of({{{0, 0, 0}, {1, 1, 1}}}), bowl));
  EXPECT_EQ(prepared.report.outer_faces, 0u);
  EXPECT_GT(exact_winding_number(prepared.mesh, {-0.4, 0, -0.4}), 0.5);
}

TEST(OuterBoundary, InnerFacesAreKeptOnRequest) {
  const Mesh mesh = mesh_of({{{0, 0, 0}, {1, 1, 1}}, {{0.4, 0.3, 0.2}, {1, 1, 1}}});
  const PreparedMesh prepared = prepare_mesh(mesh, {.keep_inner_faces = true}).value();
  EXPECT_EQ(prepared.mesh.vertices, mesh.vertices);
  EXPECT_EQ(prepared.report.triangles, 24u);
  EXPECT_EQ(prepared.report.cut_faces + prepared.report.inner_faces, 0u);
  EXPECT_GT(prepared.report.intersecting_faces, 0u);
}

/// Raises a needle from the middle of the first triangle to `tip`.
void add_needle(Mesh& mesh, const Point& tip) {
  const Triangle base = mesh.triangles.front();
  Point middle = {0, 0, 0};
  for (const std::uint32_t v : base) middle = middle + (1.0 / 3) * mesh.vertices[v];
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const std::uint32_t v : base) mesh.vertices.push_back(middle + 0.02 * (mesh.vertices[v] - middle));
  mesh.vertices.push_back(tip);
  mesh.triangles.erase(mesh.triangles.begin());
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t l = (k + 1) % 3;
    mesh.triangles.push_back({base[k], base[l], first + l});
    mesh.triangles.push_back({base[k], first + l, first + k});
    mesh.triangles.push_back({first + k, first + l, first + 3});
  }
}

// A patch of which only a needle is outside: its largest triangles are all inside.
TEST(OuterBoundary, PatchesThatCrossStayIfNoCutIsFound) {
  const Mesh outer = make_sphere(1, 500);
  Mesh inner = make_sphere(0.6, 80);
  const Triangle base = inner.triangles.front();
  add_needle(inner, 1.0 * (inner.vertices[base[0]] + inner.vertices[base[1]] + inner.vertices[base[2]]));
  const Mesh mesh = together(outer, inner);
  CutMesh cut;
  cut.vertices = cut.decided = mesh.vertices;
  cut.triangles = mesh.triangles;
  std::vector<std::uint32_t> component_of;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    cut.source.push_back(t);
    component_of.push_back(t < outer.triangles.size() ? 0 : 1);
  }
  EXPECT_EQ(leave_out_inner_patches(cut, {component_of, {}, false}, 1).inner_triangles, inner.triangles.size());
  cut.uncut = find_self_intersections(mesh, TriangleTree(mesh)).crossed;
  EXPECT_EQ(leave_out_inner_patches(cut, {component_of, {}, false}, 1).inner_triangles, 0u);
  const PreparedMesh prepared = prepare(mesh);
  EXPECT_TRUE(prepared.report.closed);
  EXPECT_EQ(prepared.report.components, 1u);
  EXPECT_TRUE(std::ranges::any_of(prepared.mesh.vertices, [](const Point& p) { return length(p) > 1.5; }));
}

// Its needle leaves through a hole, without a crossing.
TEST(OuterBoundary, PatchesThatLeaveThroughAHoleStay) {
  Mesh inner = make_sphere(0.6, 80);
  const Triangle base = inner.triangles.front();
  const Point tip = inner.vertices[base[0]] + inner.vertices[base[1]] + inner.vertices[base[2]];
  add_needle(inner, tip);
  Mesh outer = make_sphere(1, 500);
  std::erase_if(outer.triangles, [&](const Triangle& t) {
    return std::ranges::all_of(t, [&](std::uint32_t v) { return dot(outer.vertices[v], tip) > 0.97 * length(tip); });
  });
  const PreparedMesh prepared = prepare(together(outer, inner));
  EXPECT_EQ(prepared.report.intersecting_faces, 0u);
  EXPECT_GT(prepared.report.open_edges, 0u);
  EXPECT_GT(prepared.report.faces_within, 40u);
  EXPECT_EQ(prepared.report.inner_faces, 0u);
}

TEST(OuterBoundary, MapsLeadToTheInput) {
  const std::vector<Box> boxes = {{{0, 0, 0}, {1, 1, 1}}, {{0.4, 0.3, 0.2}, {1, 1, 1}}};
  const Mesh mesh = mesh_of(boxes);
  const PreparedMesh prepared = prepare(mesh);
  ASSERT_EQ(prepared.vertex_of_input.size(), mesh.vertices.size());
  std::size_t kept = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (prepared.vertex_of_input[v] == PreparedMesh::kDropped) continue;
    ++kept;
    EXPECT_EQ(prepared.mesh.vertices[prepared.vertex_of_input[v]], mesh.vertices[v]);
  }
  EXPECT_EQ(kept, 14u);  // one corner of each box is inside the other
  ASSERT_EQ(prepared.input_of_triangle.size(), prepared.mesh.triangles.size());
  for (std::size_t t = 0; t < prepared.mesh.triangles.size(); ++t) {
    const Triangle& source = mesh.triangles[prepared.input_of_triangle[t]];
    for (const std::uint32_t v : prepared.mesh.triangles[t]) {
      std::array<Point, 3> corners;
      for (std::size_t k = 0; k < 3; ++k) corners[k] = mesh.vertices[source[k]];
      const Point p = prepared.mesh.vertices[v];
      for (std::size_t k = 0; k < 3; ++k) {
        // The grid of 2^-50 has the scale 2 here, for vertices and for new points.
        if (corners[0][k] != corners[1][k] || corners[0][k] != corners[2][k]) continue;
        EXPECT_NEAR(p[k], corners[0][k], 4 * 0x1p-49);
      }
    }
  }
}

TEST(OuterBoundary, OfAPlateDoesNotDependOnThreads) {
  const Mesh mesh =
      together(mesh_of({{{0, 0, 0}, {1, 1, 1}}, {{0.3, 0.42, 0.31}, {0.43, 0.8, 0.37}}}), plate(0.4, 0.8));
  const PreparedMesh one = prepare_mesh(mesh, {.threads = 1}).value(),
                     four = prepare_mesh(mesh, {.threads = 4}).value();
  EXPECT_EQ(one.mesh.vertices, four.mesh.vertices);
  EXPECT_EQ(one.mesh.triangles, four.mesh.triangles);
}

TEST(OuterBoundary, TheResultDoesNotDependOnThreads) {
  Mesh mesh = together(make_sphere(1, 4000), moved(make_sphere(0.8, 3000), {0.7, 0.1, 0.2}));
  const PreparedMesh one = prepare_mesh(mesh, {.threads = 1}).value(),
                     four = prepare_mesh(mesh, {.threads = 4}).value();
  EXPECT_EQ(one.mesh.vertices, four.mesh.vertices);
  EXPECT_EQ(one.mesh.triangles, four.mesh.triangles);
}

}  // namespace
}  // namespace medial_vk
