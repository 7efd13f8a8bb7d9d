// What the tests of the least wall share.
#pragma once

#include <gtest/gtest.h>

#include "base/point_ops.h"
#include "cpu_reference/queries.h"
#include "medial_vk/least_wall.h"
#include "medial_vk/prepare.h"
#include "support/eigen_points.h"
#include "support/reference_mesh.h"
#include "support/solids/solids.h"

namespace medial_vk::test {

inline LeastWallOptions width_of(double width) {
  LeastWallOptions options;
  options.width = width;
  return options;
}

/// Turned, so that no face is parallel to the cells.
inline Mesh turned(Mesh mesh) {
  rotate(mesh, {1, 2, 3}, 0.7);
  return mesh;
}

/// Two boxes, this far apart, turned.
inline Mesh make_turned_gap(double gap) {
  Mesh both = make_box({0.3, 0.3, 0.2});
  append(both, moved(make_box({0.3, 0.3, 0.2}), {0.3 + gap, 0, 0}));
  return turned(both);
}

/// The ball of the upper end is empty, on its side, and touches in both contacts, by the reference.
inline void expect_touches(const LeastWall& found, const PreparedMesh& mesh, const LeastWallOptions& options) {
  ASSERT_TRUE(found.thinnest);
  const reference::Tree tree(to_reference(mesh));
  const auto& [ball, a, b, angle] = *found.thinnest;
  const double rounding = 1e-12 * mesh.report.longest_side();
  EXPECT_LE(found.diameter.lower, 2 * ball.radius);
  EXPECT_GE(found.diameter.upper, 2 * ball.radius);
  EXPECT_GE(tree.closest(to_eigen(ball.centre)).distance, ball.radius - rounding);
  EXPECT_EQ(reference::is_inside(tree, to_eigen(ball.centre)), options.side == ThicknessSide::kWalls);
  for (const Point& contact : {a, b}) {
    EXPECT_NEAR(length(contact - ball.centre), ball.radius, rounding);
    EXPECT_LE(tree.closest(to_eigen(contact)).distance, rounding);
  }
  const Point u = (1 / ball.radius) * (a - ball.centre), v = (1 / ball.radius) * (b - ball.centre);
  // The derivative of the angle by the positions of the contacts is at most 1 / (r sin of it).
  EXPECT_NEAR(reference::half_angle(to_eigen(u), to_eigen(v)), angle, 1e-6);
  EXPECT_GE(angle, options.object_angle - 0.001);
}

}  // namespace medial_vk::test
