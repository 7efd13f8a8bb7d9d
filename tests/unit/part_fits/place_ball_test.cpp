// Balls in the frame of a link: the rounding of poses.
#include "part_fits/place_ball.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "medial_vk/pose.h"

namespace medial_vk {
namespace {

TEST(PlaceBall, AllowsForRounding) {
  Pose pose;
  const Ball ball = {{0.1, 0.2, 0.3}, 0.05};
  EXPECT_EQ(place_ball(pose, ball, -1).radius, 0.05);
  EXPECT_EQ(place_ball(pose, ball, -1).centre, ball.centre);
  pose = make_pose({1, 2, 3}, {0.3, -0.2, 0.7});
  const Ball inside = place_ball(pose, ball, -1), around = place_ball(pose, ball, 1);
  EXPECT_LT(inside.radius, 0.05);
  EXPECT_GT(around.radius, 0.05);
  EXPECT_NEAR(inside.radius, 0.05, 1e-14);
  EXPECT_NEAR(around.radius, 0.05, 1e-14);
  EXPECT_EQ(place_ball(pose, ball, 0).radius, 0.05);
  EXPECT_EQ(place_ball(pose, {{0.1, 0.2, 0.3}, 0}, -1).radius, 0);
  // The same in extended precision is within the allowed bound.
  const long double cr = std::cos(0.3L), sr = std::sin(0.3L), cp = std::cos(-0.2L), sp = std::sin(-0.2L),
                    cy = std::cos(0.7L), sy = std::sin(0.7L);
  const long double x = 0.1, y = 0.2, z = 0.3;
  const long double y1 = cr * y - sr * z, z1 = sr * y + cr * z;
  const long double x2 = cp * x + sp * z1, z2 = -sp * x + cp * z1;
  const long double dx = cy * x2 - sy * y1 + 1 - inside.centre[0], dy = sy * x2 + cy * y1 + 2 - inside.centre[1],
                    dz = z2 + 3 - inside.centre[2];
  // The angles of the pose are doubles, those here are not: another 1e-16.
  EXPECT_LE(static_cast<double>(std::sqrt(dx * dx + dy * dy + dz * dz)), ball.radius - inside.radius + 1e-16);
}

// A matrix in single precision is a rotation to seven digits: the radius allows for the difference.
TEST(PlaceBall, AllowsForAnInexactRotation) {
  const Pose exact = make_pose({1, 2, 3}, {0.3, -0.2, 0.7});
  Pose rounded = exact;
  for (Point& row : rounded.rotation) {
    for (double& entry : row) entry = static_cast<float>(entry);
  }
  EXPECT_TRUE(is_rigid(rounded));
  EXPECT_EQ(placement_rounding(exact, 1), 96 * 0x1p-53 + 2 * 3 * 0x1p-53);
  EXPECT_GT(placement_rounding(rounded, 1), 1e-9);
  EXPECT_LT(placement_rounding(rounded, 1), 1e-6);
  const Point p = {0.9, -0.8, 0.7}, a = exact * p, b = rounded * p;
  EXPECT_LE(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]), 2 * placement_rounding(rounded, 0.9));
}

TEST(PlaceBall, OnlyRigidMotions) {
  EXPECT_TRUE(is_rigid(Pose()));
  EXPECT_TRUE(is_rigid(make_pose({1e6, 0, 0}, {1, 2, 3})));
  Pose pose;
  pose.rotation[0] = {-1, 0, 0};
  EXPECT_FALSE(is_rigid(pose)) << "a mirror";
  pose.rotation[0] = {1.001, 0, 0};
  EXPECT_FALSE(is_rigid(pose)) << "a scale";
  pose.rotation[0] = {1, 0.001, 0};
  EXPECT_FALSE(is_rigid(pose)) << "a shear";
  pose.rotation[0] = {1e200, -1e200, 1e200};
  EXPECT_FALSE(is_rigid(pose));
  pose = Pose();
  pose.shift[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(is_rigid(pose));
}

}  // namespace
}  // namespace medial_vk
