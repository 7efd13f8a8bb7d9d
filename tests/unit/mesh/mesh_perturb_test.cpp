// The noise against degenerate positions is the same everywhere and no larger than requested.
#include <gtest/gtest.h>

#include <cmath>

#include "medial_vk/prepare.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using namespace test;

TEST(Perturb, SeededAndBounded) {
  const Mesh mesh = make_box({1, 2, 4});
  Mesh a = mesh, b = mesh, c = mesh;
  perturb_vertices(a, 1e-3, 7);
  perturb_vertices(b, 1e-3, 7);
  perturb_vertices(c, 1e-3, 8);
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_NE(a.vertices, c.vertices);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    double squared = 0;
    for (int k = 0; k < 3; ++k) squared += std::pow(a.vertices[i][k] - mesh.vertices[i][k], 2);
    EXPECT_GT(squared, 0);
    EXPECT_LE(std::sqrt(squared), 4e-3 * (1 + 1e-9));
  }
}

}  // namespace
}  // namespace medial_vk
