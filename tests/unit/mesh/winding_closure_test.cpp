// Winding numbers of open meshes from rough ones.
#include "mesh/winding_closure.h"

#include <gtest/gtest.h>

#include <random>

#include "mesh/winding/winding_number.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

/// At points in a box around the mesh, from numbers with errors up to 0.45.
void expect_sharp(const Mesh& mesh, std::size_t closing) {
  const WindingClosure closure(mesh, MeshTopology(mesh));
  EXPECT_EQ(closure.size(), closing);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> in_box(-1.2, 1.2), error(-0.45, 0.45);
  for (int i = 0; i < 300; ++i) {
    const Point p = {in_box(random), in_box(random), in_box(random)};
    const double exact = exact_winding_number(mesh, p);
    EXPECT_NEAR(closure.sharpened(p, exact + error(random)), exact, 1e-11);
  }
}

TEST(WindingClosure, SharpensRoughNumbersOfOpenMeshes) {
  Mesh torus = test::make_torus(0.7, 0.2, 20, 40);
  expect_sharp(torus, 0);
  torus.triangles.resize(torus.triangles.size() * 3 / 4);  // two rims of 20 edges
  expect_sharp(torus, 40);
  // Two sheets in one place: all edges are open twice.
  Mesh sheet;
  sheet.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.3}};
  sheet.triangles = {{0, 1, 2}, {0, 1, 2}};
  expect_sharp(sheet, 3);
}

}  // namespace
}  // namespace medial_vk
