// Winding numbers of open meshes from rough ones.
#include "mesh/winding_closure.h"

#include <gtest/gtest.h>

#include <optional>
#include <random>

#include "mesh/winding/winding_number.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

/// At points in a box around the mesh, from numbers with errors up to 0.2.
void expect_sharp(const Mesh& mesh, std::size_t closing) {
  const WindingClosure closure(mesh, MeshTopology(mesh));
  EXPECT_EQ(closure.size(), closing);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> in_box(-1.2, 1.2), error(-0.2, 0.2);
  for (int i = 0; i < 300; ++i) {
    const Point p = {in_box(random), in_box(random), in_box(random)};
    const double exact = exact_winding_number(mesh, p);
    const std::optional<double> sharp = closure.sharpened(p, exact + error(random), 0.2);
    ASSERT_TRUE(sharp);
    EXPECT_NEAR(*sharp, exact, 1e-11);
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

// A rough number that is too wrong is noticed instead of rounded.
TEST(WindingClosure, RefusesNumbersFarFromAnyInteger) {
  Mesh torus = test::make_torus(0.7, 0.2, 20, 40);
  torus.triangles.resize(torus.triangles.size() / 2);
  const WindingClosure closure(torus, MeshTopology(torus));
  const Point p = {0.1, 0.2, 0.3};
  const double exact = exact_winding_number(torus, p);
  EXPECT_TRUE(closure.sharpened(p, exact + 0.1, 0.2));
  EXPECT_FALSE(closure.sharpened(p, exact + 0.4, 0.2));
}

}  // namespace
}  // namespace medial_vk
