// Frames of any kind: in any unit, flat, crossing, open, faulty.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "medial_vk/prepare.h"
#include "support/solids/motions.h"
#include "unit/following/followed_example.h"

namespace medial_vk {
namespace {

TEST(FollowerOfAnyFrame, InAnyUnitAndPlace) {
  const Example example = torus();
  for (const double unit : {1e-50, 1.0, 1e50}) {
    for (const double away : {0.0, 1e9}) {
      const PlacedExample placed(example, unit, away);
      Follower follower = Follower::create(placed.mesh, placed.balls).value();
      const Frame frame = placed.place(test::moved_vertices(example.rest(), test::Motion::kBend, 1));
      ASSERT_TRUE(follower.update(frame).ok());
      EXPECT_EQ(lost(follower), 0u);
      expect_inside(follower, placed.mesh, frame, "placed");
    }
  }
}

TEST(FollowerOfAnyFrame, RefusesSizesBeyondItsArithmetic) {
  const Example example = torus();
  Follower follower = example.follower();
  for (const double unit : {1e-200, 1e-70, 1e70, 1e200}) {
    Frame frame = example.rest();
    for (Point& p : frame) p = unit * p;
    EXPECT_EQ(follower.update(frame).error().code, ErrorCode::kInvalidMesh) << unit;
    Mesh mesh = example.mesh.prepared().mesh;
    mesh.vertices = frame;
    EXPECT_EQ(Follower::create(test::indexed(test::view_of(mesh)), example.balls).error().code,
              ErrorCode::kInvalidMesh);
  }
  ASSERT_TRUE(follower.update(example.rest()).ok());
}

TEST(FollowerOfAnyFrame, TrianglesWithoutAreaArePermitted) {
  const Example example = torus();
  Follower follower = example.follower();
  Frame frame = example.rest();
  for (Point& p : frame) p[2] = std::max(p[2], -0.1);  // a part becomes flat, and its edges collapse
  for (int repeat = 0; repeat < 3; ++repeat) {
    ASSERT_TRUE(follower.update(frame).ok());
    expect_inside(follower, example.mesh, frame, "flat");
  }
  EXPECT_LT(lost(follower), example.balls.size() / 4);
  ASSERT_TRUE(follower.update(example.rest()).ok());
  expect_inside(follower, example.mesh, example.rest(), "rest again");
}

TEST(FollowerOfAnyFrame, AFrameWithoutVolumeLosesAllBallsForItsTime) {
  const Example example = torus();
  Follower follower = example.follower();
  Frame frame = example.rest();
  for (Point& p : frame) p[2] = 0;
  ASSERT_TRUE(follower.update(frame).ok());
  EXPECT_EQ(lost(follower), example.balls.size());
  ASSERT_TRUE(follower.update(example.rest()).ok());
  expect_inside(follower, example.mesh, example.rest(), "after it");
  EXPECT_EQ(lost(follower), 0u);
}

TEST(FollowerOfAnyFrame, PartsThatCrossKeepBallsInside) {
  // One arm of the L is moved through the other one.
  const Example example = l_shape();
  Follower follower = example.follower();
  Frame frame = example.rest();
  for (Point& p : frame) {
    if (p[1] > 1) p = {p[0] + 0.3, 0.8 - 0.5 * p[1], p[2] + 0.1};
  }
  ASSERT_TRUE(follower.update(frame).ok());
  expect_inside(follower, example.mesh, frame, "crossing");
}

TEST(FollowerOfAnyFrame, AnOpenMeshIsFollowedByItsWindingNumber) {
  Mesh raw = test::make_turned_torus(40, 20);
  raw.triangles.pop_back();
  const Example example(std::move(raw), 60);
  ASSERT_FALSE(example.mesh.prepared().report.closed);
  Follower follower = example.follower();
  for (const double time : {0.5, 1.0}) {
    const Frame frame = test::moved_vertices(example.rest(), test::Motion::kTwist, time);
    ASSERT_TRUE(follower.update(frame).ok());
    expect_inside(follower, example.mesh, frame, "open");
  }
  EXPECT_LT(lost(follower), 10u);  // those that touch the boundary next to the hole
}

TEST(FollowerOfAnyFrame, AFaultyFrameChangesNothing) {
  const Example example = l_shape();
  Follower follower = example.follower();
  ASSERT_TRUE(follower.update(test::moved_vertices(example.rest(), test::Motion::kBend, 0.5)).ok());
  const std::vector<Ball> before = copy_of(follower.balls());
  Frame short_frame = example.rest(), not_finite = short_frame, one_point = short_frame;
  short_frame.pop_back();
  not_finite[3][1] = std::numeric_limits<double>::quiet_NaN();
  std::ranges::fill(one_point, Point{1, 2, 3});
  for (const Frame& frame : {short_frame, not_finite, one_point}) {
    const Status status = follower.update(frame);
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().code, ErrorCode::kInvalidMesh);
    EXPECT_EQ(greatest_difference(follower.balls(), before), 0);
  }
  EXPECT_EQ(follower.update(not_finite).error().message, "vertex 3 has a coordinate that is not finite");
  Follower untouched = example.follower();
  ASSERT_TRUE(untouched.update(test::moved_vertices(example.rest(), test::Motion::kBend, 0.5)).ok());
  for (Follower* each : {&follower, &untouched}) {
    ASSERT_TRUE(each->update(test::moved_vertices(example.rest(), test::Motion::kBend, 1)).ok());
  }
  EXPECT_EQ(greatest_difference(follower.balls(), untouched.balls()), 0);
}

TEST(FollowerOfAnyFrame, RefusesBallsThatAreNotInside) {
  const IndexedMesh mesh = test::indexed(prepare_mesh(test::make_box({1, 1, 1})).value());
  const auto message = [&](const Ball& ball) {
    const Result<Follower> result = Follower::create(mesh, {{Ball{{0.5, 0.5, 0.5}, 0.5}, ball}});
    return result.ok() ? std::string("accepted") : result.error().message;
  };
  EXPECT_EQ(message({{0.5, 0.5, 0.4}, 0.4}), "accepted");
  EXPECT_EQ(message({{0.5, 0.5, 0.4}, 0.41}), "ball 1 is not inside the mesh");
  EXPECT_EQ(message({{0.5, 0.5, 1.4}, 0.1}), "ball 1 is not inside the mesh");
  EXPECT_EQ(message({{0.5, 0.5, 0.4}, 0}), "ball 1 has a number that is out of range, or no positive radius");
  FollowerOptions options;
  options.protrusion = 0;
  EXPECT_EQ(Follower::create(mesh, {{Ball{{0.5, 0.5, 0.5}, 0.5}}}, options).error().code, ErrorCode::kUsage);
  EXPECT_EQ(Follower::create(mesh, {}).error().code, ErrorCode::kUsage);
}

}  // namespace
}  // namespace medial_vk
