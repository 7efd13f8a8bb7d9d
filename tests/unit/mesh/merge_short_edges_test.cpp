// Crossings almost on top of each other become one vertex: no sliver stays, no surface is closed or turned over.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/point_ops.h"
#include "mesh/merge_short_edges.h"
#include "unit/mesh/prepared.h"

namespace medial_vk {
namespace {

using namespace test;

double shortest_edge(const Mesh& mesh) {
  double shortest = INFINITY;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k)
      shortest = std::min(shortest, length(mesh.vertices[t[k]] - mesh.vertices[t[(k + 1) % 3]]));
  }
  return shortest;
}

/// As in a file with seven digits: edges of aligned solids then cross up to rounding.
Mesh rounded(Mesh mesh) {
  for (Point& p : mesh.vertices) {
    for (double& x : p) x = std::round(x * 1e7) / 1e7;
  }
  return mesh;
}

TEST(MergeShortEdges, AlignedSolidsCrossWithoutSlivers) {
  const Mesh wide = rounded(make_capsule(0.5, 0.4, 48));
  Mesh high = rounded(make_capsule(0.3, 1.4, 48));
  const PreparedMesh prepared = prepare(together(wide, high));
  const MeshReport& report = prepared.report;
  EXPECT_GT(report.cut_faces, 0u);
  EXPECT_TRUE(report.closed);
  EXPECT_EQ(report.intersecting_faces, 0u);
  EXPECT_EQ(report.trusted_triangles, report.triangles);
  EXPECT_GE(shortest_edge(prepared.mesh), kMergedLength * report.longest_side());
  // Turned by a small angle it crosses in general position, and has almost the same volume.
  rotate(high, {0, 0, 1}, 0.01);
  const PreparedMesh turned = prepare(together(wide, high));
  EXPECT_NEAR(report.signed_volume, turned.report.signed_volume, 1e-3 * report.signed_volume);
}

/// A fan of triangles around the vertex `centre`, in the plane z = 0.
struct Fan {
  Mesh mesh;
  std::vector<std::uint32_t> source;

  void merge(std::size_t first_new, double longest) {
    source.clear();
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) source.push_back(t);
    merge_short_edges(mesh, source, first_new, longest);
  }
};

/// A square with two vertices near its middle, 4 and 5, `apart` from each other.
Fan square(double apart) {
  Fan fan;
  fan.mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}, {0.5 + apart, 0.5, 0}};
  fan.mesh.triangles = {{0, 1, 4}, {1, 5, 4}, {1, 2, 5}, {2, 4, 5}, {2, 3, 4}, {3, 0, 4}};
  return fan;
}

TEST(MergeShortEdges, MovesOnlyNewVertices) {
  Fan both_new = square(1e-7);
  both_new.merge(4, 1e-6);
  EXPECT_EQ(both_new.mesh.triangles.size(), 4u);
  EXPECT_EQ(both_new.source, (std::vector<std::uint32_t>{0, 2, 4, 5}));
  for (const Triangle& t : both_new.mesh.triangles) EXPECT_EQ(std::ranges::count(t, 5u), 0);
  Fan one_new = square(1e-7);
  one_new.merge(5, 1e-6);
  EXPECT_EQ(one_new.mesh.triangles, both_new.mesh.triangles);
  Fan none_new = square(1e-7);
  none_new.merge(6, 1e-6);
  EXPECT_EQ(none_new.mesh.triangles.size(), 6u);
  Fan far = square(1e-3);
  far.merge(4, 1e-6);
  EXPECT_EQ(far.mesh.triangles.size(), 6u);
}

TEST(MergeShortEdges, DoesNotTurnATriangleOver) {
  // The line through 3 and 6 passes between 4 and 5, and 5 is a corner of a triangle with them.
  Fan fan;
  fan.mesh.vertices = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {1e-7, 2, 0}, {0, 0, 0}, {2e-7, 0, 0}, {1e-7, 1, 0}};
  fan.mesh.triangles = {{4, 5, 6}, {5, 3, 6}, {5, 1, 3}, {2, 1, 5}, {2, 5, 4}, {0, 2, 4}, {0, 4, 6}, {0, 6, 3}};
  Fan wider = fan;
  wider.mesh.vertices[3][0] = wider.mesh.vertices[6][0] = -0.1;
  fan.merge(5, 1e-6);
  EXPECT_EQ(fan.mesh.triangles.size(), 8u);
  wider.merge(5, 1e-6);
  EXPECT_EQ(wider.mesh.triangles.size(), 6u);
}

TEST(MergeShortEdges, DoesNotCloseATube) {
  // A tube with a triangle around it whose three edges are short: without one of them it would be pinched.
  Fan fan;
  constexpr double s = 1e-7;
  fan.mesh.vertices = {{1, 0, -1},  {-1, 1, -1}, {-1, -1, -1}, {s, 0, 0},  {-s, s, 0},
                       {-s, -s, 0}, {1, 0, 1},   {-1, 1, 1},   {-1, -1, 1}};
  for (const std::uint32_t ring : {0u, 3u}) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t a = ring + k, b = ring + (k + 1) % 3;
      fan.mesh.triangles.push_back({a, b, b + 3});
      fan.mesh.triangles.push_back({a, b + 3, a + 3});
    }
  }
  fan.merge(3, 1e-6);
  EXPECT_EQ(fan.mesh.triangles.size(), 12u);
}

TEST(MergeShortEdges, DoesNotFlattenATetrahedron) {
  Fan fan;
  fan.mesh.vertices = {{1, 1, 0}, {1, -1, 1}, {0, 0, 0}, {1e-7, 0, 0}};
  fan.mesh.triangles = {{2, 0, 1}, {3, 1, 0}, {2, 3, 0}, {3, 2, 1}};
  fan.merge(2, 1e-6);
  EXPECT_EQ(fan.mesh.triangles.size(), 4u);
}

TEST(MergeShortEdges, NoVertexMovesByMoreThanTheLength) {
  // The vertices 4, 5 and 6 in a row: 6 moves onto 5, which would carry it too far if it moved onto 4.
  const auto merged = [](double from_4_to_5) {
    Fan fan;
    const double x = from_4_to_5;
    fan.mesh.vertices = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 0}, {x, 0, 0}, {x + 4e-7, 0, 0}};
    fan.mesh.triangles = {{0, 5, 4}, {0, 1, 5}, {1, 6, 5}, {3, 4, 5}, {3, 5, 2}, {2, 5, 6}, {0, 4, 3}, {1, 2, 6}};
    fan.merge(4, 1e-6);
    return fan.mesh.triangles.size();
  };
  EXPECT_EQ(merged(5e-7), 4u);
  EXPECT_EQ(merged(7e-7), 6u);
}

}  // namespace
}  // namespace medial_vk
