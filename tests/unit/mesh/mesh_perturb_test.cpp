// The noise against degenerate positions is the same everywhere and no larger than requested.
#include <gtest/gtest.h>

#include <cmath>

#include "medial_vk/prepare.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using namespace test;

TEST(Perturb, SeededAndBounded) {
  const PreparedMesh box = prepare_mesh(make_box({1, 2, 4})).value();
  const Mesh& mesh = box.mesh;
  const Mesh a = perturb_mesh(box, 1e-3, 7).value().mesh, b = perturb_mesh(box, 1e-3, 7).value().mesh;
  const Mesh c = perturb_mesh(box, 1e-3, 8).value().mesh;
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_NE(a.vertices, c.vertices);
  ASSERT_EQ(a.vertices.size(), mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    double squared = 0;
    for (int k = 0; k < 3; ++k) squared += std::pow(a.vertices[i][k] - mesh.vertices[i][k], 2);
    EXPECT_GT(squared, 0);
    EXPECT_LE(std::sqrt(squared), 4e-3 * (1 + 1e-9));
  }
}

}  // namespace
}  // namespace medial_vk
