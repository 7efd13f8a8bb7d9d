// The content of a mesh as a text: it depends on every number of the mesh, and on where one list ends.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "cli/batch/mesh_digest.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

TEST(MeshDigest, ChangesWithEveryNumberOfTheMesh) {
  const Mesh box = test::make_box({1, 2, 3});
  std::set<std::string> digests = {cli::mesh_digest(box)};
  EXPECT_EQ(digests.begin()->size(), 32u);
  EXPECT_EQ(cli::mesh_digest(Mesh(box)), *digests.begin());
  const auto expect_new = [&](const Mesh& mesh) { EXPECT_TRUE(digests.insert(cli::mesh_digest(mesh)).second); };
  for (std::size_t i = 0; i < box.vertices.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Mesh moved = box;
      moved.vertices[i][axis] = std::nextafter(moved.vertices[i][axis], 9.0);
      expect_new(moved);
    }
  }
  for (std::size_t i = 0; i < box.triangles.size(); ++i) {
    Mesh turned = box;
    std::swap(turned.triangles[i][0], turned.triangles[i][1]);
    expect_new(turned);
  }
  Mesh counted = box;
  counted.short_polygons = 1;
  expect_new(counted);
  counted.short_polygons = 0;
  counted.fallback_polygons = 1;
  expect_new(counted);
}

// Six triangles take as many words as three vertices.
TEST(MeshDigest, KnowsWhereVerticesEnd) {
  Mesh vertices, triangles;
  vertices.vertices.resize(3, Point{0, 0, 0});
  triangles.triangles.resize(6, Triangle{0, 0, 0});
  EXPECT_NE(cli::mesh_digest(vertices), cli::mesh_digest(triangles));
  EXPECT_NE(cli::mesh_digest(vertices), cli::mesh_digest(Mesh()));
}

}  // namespace
}  // namespace medial_vk
