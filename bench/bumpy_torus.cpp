#include "bumpy_torus.h"

#include <cmath>

#include "support/solids/solids.h"

namespace medial_vk::bench {

Mesh make_bumpy_torus(std::uint32_t triangles) {
  const auto along = static_cast<std::uint32_t>(std::lround(std::sqrt(triangles)));
  Mesh mesh = test::make_torus(1.0, 0.4, along / 2, along);
  for (Point& p : mesh.vertices) {
    const double phi = std::atan2(p[1], p[0]);
    const double bump = 1 + 0.08 * std::sin(7 * phi + 3 * p[2]) + 0.02 * std::sin(31 * phi) * std::cos(23 * p[2]);
    for (double& x : p) x *= bump;
  }
  test::rotate(mesh, {1, 2, 3}, 0.7);
  return mesh;
}

}  // namespace medial_vk::bench
