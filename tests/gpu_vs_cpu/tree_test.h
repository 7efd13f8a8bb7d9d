// Shared definitions of the tests of kernels that walk the tree: solids, points, tolerances, a context.
//
// Tolerances, for a mesh whose longest side is L and queries within its box, u = 2^-24. The device sees positions
// scaled to the unit box and rounded to float: the query and a corner a are off by sqrt(3) u/2 each, an edge by as much
// again; together below 3 sqrt(3) u/2 = 1.6e-7. The distance to a triangle is evaluated to 8 u (|p - a| + |edge|)
// (shaders/shared/tree/closest_point.glsl); with |p - a| <= sqrt(3) and edges up to sqrt(2) that is 1.5e-6.
// Faces are preferred to edges by 2^-21 of the distance (tree_closest.glsl), 5e-7. Sum: 2.2e-6 L.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <string>
#include <vector>

#include "cpu_reference/queries.h"
#include "medial_vk/scene.h"
#include "support/device/device_test.h"
#include "support/eigen_points.h"
#include "support/indexed.h"
#include "support/reference_mesh.h"
#include "support/solids/solids.h"

namespace medial_vk {

constexpr double kDistanceTolerance = 2.2e-6;

struct NamedSolid {
  std::string name;
  Mesh mesh;
};

/// Convex, concave, with a hole, thin, needles, far from the origin; all in generic position.
inline std::vector<NamedSolid> solids() {
  std::vector<NamedSolid> all = {{"box", test::make_box({1, 2, 3})},
                                 {"ellipsoid", test::make_ellipsoid({1, 0.9, 0.4}, 40)},
                                 {"needles", test::make_capsule(1, 1, 60)},
                                 {"cup", test::make_cup(1, 0.1, 1.5, 60)},
                                 {"L", test::make_l_shape(2, 0.5, 1)},
                                 {"torus", test::make_torus(1, 0.3, 60, 30)},
                                 {"plate", test::make_plate_with_hole(2, 0.05, 0.7)}};
  for (Point& p : all[2].mesh.vertices) p[2] *= 100;  // triangles a hundred times longer than wide
  double angle = 0.3;
  for (NamedSolid& solid : all) {
    test::rotate(solid.mesh, {1, -2, 0.5}, angle);
    angle += 0.4;
  }
  test::scale(all[5].mesh, 1e-3);
  test::translate(all[5].mesh, {5, -3, 4});
  return all;
}

class TreeQueriesTest : public test::DeviceTest {
 protected:
  Scene scene_of(const Mesh& mesh) {
    Result<Scene> scene = test::make_scene(*context_, test::view_of(mesh));
    EXPECT_TRUE(scene.ok());
    return std::move(scene).value();
  }
};

/// Points distributed over the mesh's box, the same in every run.
inline std::vector<Point> points_in_box(const reference::Tree& tree, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<Point> points(count);
  for (Point& p : points) {
    for (int k = 0; k < 3; ++k) p[k] = tree.lower()[k] + share(random) * (tree.upper()[k] - tree.lower()[k]);
  }
  return points;
}

}  // namespace medial_vk
