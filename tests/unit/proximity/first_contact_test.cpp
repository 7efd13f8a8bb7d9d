// First contacts of bodies in motion: known ones, and many times of the motion one by one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/point_ops.h"
#include "medial_vk/prepare.h"
#include "medial_vk/proximity.h"
#include "support/indexed.h"
#include "support/random_poses.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using namespace test;

Body moving_body(const Mesh& mesh) { return Body::create(indexed(prepare_mesh(mesh).value())).value(); }

Motion shifted(const Point& from, const Point& to) {
  return {make_pose(from, {0, 0, 0}), make_pose(to, {0, 0, 0}), {}};
}

TEST(FirstContact, OfBoxesThatMeetIsWhereTheirFacesMeet) {
  const Body box = moving_body(make_box({1, 1, 1}));
  const FirstContact found = first_contact(box, box, shifted({4, 0.1, 0.2}, {0, 0.1, 0.2})).value();
  EXPECT_EQ(found.collision(), Collision::kHit);
  EXPECT_LE(found.free_until, 0.75);
  EXPECT_GE(found.contact_at, 0.75);
  EXPECT_LE(found.contact_at - found.free_until, 3e-6);
  EXPECT_EQ(found.nearest.upper, 0);
}

TEST(FirstContact, OfBoxesThatPassIsNone) {
  const Body box = moving_body(make_box({1, 1, 1}));
  const FirstContact found = first_contact(box, box, shifted({4, 1.01, 0}, {-4, 1.01, 0})).value();
  EXPECT_EQ(found.collision(), Collision::kFree);
  EXPECT_EQ(found.free_until, 1);
  ContactOptions options;
  options.clearance = 0.02;
  EXPECT_EQ(first_contact(box, box, shifted({4, 1.01, 0}, {-4, 1.01, 0}), options).value().collision(),
            Collision::kHit);
}

// A rod turns about its end towards a box, whose corner (1.5, 1) its upper side meets, 0.02 above the axis of the rod,
// where cos(angle) - 1.5 sin(angle) = 0.02.
TEST(FirstContact, OfARodThatTurns) {
  Mesh rod = make_box({2, 0.02, 0.02});
  translate(rod, {0, 0, -0.01});
  Mesh box = make_box({1, 1, 1});
  translate(box, {0.5, 1, -0.5});
  Motion motion;
  motion.to = make_pose({0, 0, 0}, {0, 0, std::numbers::pi / 2});
  const FirstContact found = first_contact(moving_body(box), moving_body(rod), motion).value();
  ASSERT_EQ(found.collision(), Collision::kHit);
  const double angle = std::acos(0.02 / std::hypot(1.5, 1)) - std::atan2(1.5, 1);
  EXPECT_LE(found.free_until, angle / (std::numbers::pi / 2));
  EXPECT_GE(found.contact_at, angle / (std::numbers::pi / 2));
  EXPECT_LE(found.contact_at - found.free_until, 3e-6);
}

TEST(FirstContact, OfBodiesInContactIsAtOnce) {
  const Body box = moving_body(make_box({1, 1, 1}));
  const FirstContact found = first_contact(box, box, shifted({0.5, 0.5, 0.5}, {9, 9, 9})).value();
  EXPECT_EQ(found.free_until, 0);
  EXPECT_EQ(found.contact_at, 0);
}

// Without any motion, the answer is that of the pose.
TEST(FirstContact, OfABodyAtRest) {
  const Body box = moving_body(make_box({1, 1, 1}));
  EXPECT_EQ(first_contact(box, box, shifted({3, 0, 0}, {3, 0, 0})).value().collision(), Collision::kFree);
  EXPECT_EQ(first_contact(box, box, shifted({0.5, 0, 0}, {0.5, 0, 0})).value().collision(), Collision::kHit);
  EXPECT_NE(first_contact(box, box, shifted({1, 0, 0}, {1, 0, 0})).value().collision(), Collision::kFree);
}

TEST(FirstContact, HoldsAtManyTimesOfRandomMotions) {
  Random random(7);
  const Body a = moving_body(make_torus(0.5, 0.2, 20, 30)), b = moving_body(make_l_shape(1, 0.3, 0.4));
  int hits = 0, free = 0;
  for (int i = 0; i < 60; ++i) {
    const Motion motion = {any_pose(random, point_in_cube(random, 2)), any_pose(random, point_in_cube(random, 2)),
                           point_in_cube(random, 0.5)};
    ContactOptions options;
    options.clearance = i % 3 == 0 ? 0.1 : 0;
    const FirstContact found = first_contact(a, b, motion, options).value();
    SCOPED_TRACE(testing::Message() << "motion " << i);
    for (int k = 0; k <= 200; ++k) {
      const double t = k / 200.0;
      const Distance at = distance(a, b, pose_at(motion, t)).value();
      if (t < found.free_until) {
        EXPECT_GT(at.upper, options.clearance) << t;
      }
    }
    if (found.collision() == Collision::kHit) {
      EXPECT_LE(distance(a, b, pose_at(motion, found.contact_at)).value().lower, options.clearance);
      EXPECT_LE(found.free_until, found.contact_at);
    }
    hits += found.collision() == Collision::kHit;
    free += found.collision() == Collision::kFree;
  }
  EXPECT_GT(hits, 15);
  EXPECT_GT(free, 5);
}

TEST(FirstContact, MotionsBeginAndEndWhereTheyShould) {
  Random random(8);
  for (int i = 0; i < 100; ++i) {
    const Motion motion = {any_pose(random, point_in_cube(random, 2)), any_pose(random, point_in_cube(random, 2)),
                           point_in_cube(random, 1)};
    const Point p = point_in_cube(random, 1);
    EXPECT_LE(length(pose_at(motion, 0) * p - motion.from * p), 1e-13);
    EXPECT_LE(length(pose_at(motion, 1) * p - motion.to * p), 1e-13);
    const Point middle = 0.5 * (motion.from * motion.pivot + motion.to * motion.pivot);
    EXPECT_LE(length(pose_at(motion, 0.5) * motion.pivot - middle), 1e-13);
  }
}

TEST(FirstContact, RefusesOptionsWithoutMeaning) {
  const Body box = moving_body(make_box({1, 1, 1}));
  ContactOptions options;
  options.clearance = -1;
  EXPECT_THAT(first_contact(box, box, {}, options).error().message, testing::HasSubstr("`clearance`"));
  options = {};
  options.tolerance = 0;
  EXPECT_THAT(first_contact(box, box, {}, options).error().message, testing::HasSubstr("`tolerance`"));
  const Body balls = Body::create({{{{0, 0, 0}, 1}}}, {}).value();
  EXPECT_FALSE(first_contact(box, balls, {}).ok());
}

}  // namespace
}  // namespace medial_vk
