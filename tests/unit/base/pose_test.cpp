// Poses from quaternions.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "base/point_ops.h"
#include "support/random_poses.h"

namespace medial_vk {
namespace {

/// What the comment of make_pose() guarantees, with the rounding of this computation.
void expect_rotation(const Pose& pose) {
  const auto& r = pose.rotation;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(dot(r[i], r[j]), i == j ? 1 : 0, (64 + 6) * 0x1p-53);
  }
  EXPECT_NEAR(dot(r[0], cross(r[1], r[2])), 1, 1e-14);
}

TEST(Pose, OfAQuaternionIsARotationOfAnyLength) {
  test::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Pose pose = test::any_pose(random, {1, 2, 3});
    expect_rotation(pose);
    EXPECT_EQ(pose.shift, (Point{1, 2, 3}));
  }
  for (const double size : {1e-300, 5e-324, 1e-10, 1.0, 1e150, 1.7e308}) {
    const Pose pose = make_pose({0, 0, 0}, Quaternion(0, 0, size, size)).value();
    expect_rotation(pose);
    EXPECT_NEAR((pose * Point{1, 0, 0})[1], 1, 1e-15) << size;  // a quarter turn about z
  }
  expect_rotation(make_pose({0, 0, 0}, Quaternion(1e-200, 1, -1e-200, 1e-320)).value());
}

TEST(Pose, OfAQuaternionIsThatOfTheAngles) {
  const double half = 0.35;
  const Pose turned = make_pose({0, 0, 0}, Quaternion(std::sin(half), 0, 0, std::cos(half))).value();
  const Pose by_angle = make_pose({0, 0, 0}, Point{2 * half, 0, 0});
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(turned.rotation[i][j], by_angle.rotation[i][j], 1e-15);
  }
  EXPECT_EQ(make_pose({4, 5, 6}, Quaternion(0, 0, 0, -2)).value(),
            (Pose{{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {4, 5, 6}}));
}

TEST(Pose, NeedsAQuaternionThatIsNotZero) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const Quaternion& q : {Quaternion(0, 0, 0, 0), Quaternion(0, NAN, 0, 1), Quaternion(kInfinity, 0, 0, 0)}) {
    const Result<Pose> pose = make_pose({0, 0, 0}, q);
    ASSERT_FALSE(pose);
    EXPECT_EQ(pose.error().code, ErrorCode::kUsage);
  }
  EXPECT_FALSE(make_pose({0, kInfinity, 0}, Quaternion(0, 0, 0, 1)));
}

}  // namespace
}  // namespace medial_vk
