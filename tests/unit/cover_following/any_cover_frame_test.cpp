// Frames of any kind: in any unit, flat, crossing, open, faulty.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "unit/cover_following/cover_example.h"

namespace medial_vk {
namespace {

TEST(CoverOfAnyFrame, InAnyUnitAndPlace) {
  const CoverExample example = covered_l_shape();
  for (const double unit : {1e-50, 1e-10, 1.0, 1e10, 1e50}) {
    for (const double away : {0.0, 1e6}) {
      const auto place = [&](CoverFrame frame) {
        for (Point& p : frame) p = unit * (p + Point{away, -away, away});
        return frame;
      };
      Mesh mesh = example.mesh.prepared().mesh;
      mesh.vertices = place(mesh.vertices);
      const IndexedMesh placed = test::indexed(test::view_of(mesh));
      std::vector<Ball> balls;
      for (const Ball& ball : example.balls) balls.push_back({place({ball.centre})[0], unit * ball.radius});
      CoverFollower follower = CoverFollower::create(placed, balls).value();
      const CoverFrame frame = place(test::moved_vertices(example.rest(), test::Motion::kBend, 1));
      ASSERT_TRUE(follower.update(frame).ok());
      if (unit == 1e-50 || unit == 1e50) {
        EXPECT_EQ(follower.state(), CoverState::kSurface);
        for (const Point& p : frame) EXPECT_TRUE(any_holds(follower.balls(), p));
      } else {
        expect_cover(follower, placed, frame, "placed");
      }
    }
  }
}

TEST(CoverOfAnyFrame, TrianglesWithoutAreaArePermitted) {
  const CoverExample example = covered_torus();
  CoverFollower follower = example.follower();
  CoverFrame frame = example.rest();
  for (Point& p : frame) p[2] = std::max(p[2], -0.1);  // a part becomes flat, and its edges collapse
  ASSERT_TRUE(follower.update(frame).ok());
  expect_cover(follower, example.mesh, frame, "flat");
}

TEST(CoverOfAnyFrame, AFrameWithoutVolumeIsHeld) {
  const CoverExample example = covered_torus();
  CoverFollower follower = example.follower();
  for (const bool is_line : {false, true}) {
    CoverFrame frame = example.rest();
    for (Point& p : frame) {
      p[2] = 0;
      if (is_line) p[1] = 0;
    }
    ASSERT_TRUE(follower.update(frame).ok());
    EXPECT_EQ(follower.state(), CoverState::kSolid);
    for (const Triangle& t : example.mesh.view().triangles) {
      EXPECT_TRUE(any_holds(follower.balls(), frame[t[0]]));
      EXPECT_TRUE(any_holds(follower.balls(), 0.5 * (frame[t[0]] + frame[t[1]])));
    }
  }
}

TEST(CoverOfAnyFrame, PartsThatCrossAreCovered) {
  // One arm of the L is moved through the other one.
  const CoverExample example = covered_l_shape();
  CoverFollower follower = example.follower();
  CoverFrame frame = example.rest();
  for (Point& p : frame) {
    if (p[1] > 1) p = {p[0] + 0.3, 0.8 - 0.5 * p[1], p[2] + 0.1};
  }
  ASSERT_TRUE(follower.update(frame).ok());
  expect_cover(follower, example.mesh, frame, "crossing");
}

/// The frames of a motion with some that a division of the surface should not be made for.
std::vector<std::pair<std::string, CoverFrame>> frames_with_faulty_ones(const CoverFrame& rest) {
  CoverFrame flat = rest, crossing = rest;
  for (Point& p : flat) p[2] = 0;
  for (Point& p : crossing) p = p[1] > 0.5 ? Point{0.2 - p[0], 0.9 - p[1], p[2] + 0.1} : p;
  return {{"bent", test::moved_vertices(rest, test::Motion::kBend, 0.5)},
          {"flat", flat},
          {"after the flat one", test::moved_vertices(rest, test::Motion::kTwist, 1)},
          {"crossing", crossing},
          {"after the crossing one", test::moved_vertices(rest, test::Motion::kTwist, 0.5)},
          {"rest", rest}};
}

TEST(CoverOfAnyFrame, TighteningInFaultyFramesMakesNoLaterCoverLarger) {
  for (const CoverExample& example : {covered_torus(), covered_l_shape()}) {
    for (const std::uint32_t steps : {0u, 1u}) {
      CoverFollower loose = example.follower({.steps = steps}), tight = example.follower({.steps = steps});
      for (const auto& [name, frame] : frames_with_faulty_ones(example.rest())) {
        ASSERT_TRUE(loose.update(frame).ok());
        ASSERT_TRUE(tight.update(frame).ok());
        ASSERT_TRUE(tight.tighten().ok());
        EXPECT_LE(tight.measure().value().ball_volume, loose.measure().value().ball_volume) << name;
        EXPECT_EQ(tight.state(), CoverState::kSolid) << name;
        if (name != "flat") expect_cover(tight, example.mesh, frame, name);  // whose winding numbers are all 0
      }
    }
  }
}

// The same frame gives the same cover, as tighten() then begins from the division at rest.
TEST(CoverOfAnyFrame, TighteningRecoversFromAFaultyFrame) {
  const CoverExample example = covered_torus();
  const auto frames = frames_with_faulty_ones(example.rest());
  CoverFollower seen = example.follower(), fresh = example.follower();
  ASSERT_TRUE(seen.update(frames[1].second).ok());
  ASSERT_TRUE(seen.tighten().ok());
  for (CoverFollower* const follower : {&seen, &fresh}) {
    ASSERT_TRUE(follower->update(frames[2].second).ok());
    ASSERT_TRUE(follower->tighten().ok());
  }
  EXPECT_EQ(difference_of(seen.balls(), fresh.balls()), 0);
}

TEST(CoverOfAnyFrame, OfAnOpenMeshTheSurfaceIsHeld) {
  Mesh raw = test::make_turned_torus(40, 20);
  raw.triangles.pop_back();
  const CoverExample example(std::move(raw), 0.4);
  ASSERT_FALSE(example.mesh.prepared().report.closed);
  CoverFollower follower = example.follower();
  const CoverFrame frame = test::moved_vertices(example.rest(), test::Motion::kTwist, 1);
  ASSERT_TRUE(follower.update(frame).ok());
  EXPECT_EQ(follower.state(), CoverState::kSurface);
  for (const Triangle& t : example.mesh.view().triangles) {
    EXPECT_TRUE(any_holds(follower.balls(), (1.0 / 3) * (frame[t[0]] + frame[t[1]] + frame[t[2]])));
  }
}

TEST(CoverOfAnyFrame, BallsThatLeavePointsOutGrow) {
  const IndexedMesh mesh = test::indexed(prepare_mesh(test::make_box({1, 2, 3})).value());
  const std::vector<Ball> balls = {{{0.5, 0.5, 0.5}, 0.1}, {{0.5, 1.5, 2.5}, 0.01}};
  const CoverFollower follower = CoverFollower::create(mesh, balls).value();
  expect_cover(follower, mesh, {mesh.view().vertices.begin(), mesh.view().vertices.end()}, "small balls");
}

TEST(CoverOfAnyFrame, AFaultyFrameChangesNothing) {
  const CoverExample example = covered_l_shape();
  CoverFollower follower = example.follower();
  ASSERT_TRUE(follower.update(test::moved_vertices(example.rest(), test::Motion::kBend, 0.5)).ok());
  const std::vector<Ball> before = balls_of(follower);
  CoverFrame short_frame = example.rest(), not_finite = short_frame, one_point = short_frame, huge = short_frame;
  short_frame.pop_back();
  not_finite[3][1] = std::numeric_limits<double>::quiet_NaN();
  std::ranges::fill(one_point, Point{1, 2, 3});
  for (Point& p : huge) p = 1e70 * p;
  for (const CoverFrame& frame : {short_frame, not_finite, one_point, huge}) {
    const Status status = follower.update(frame);
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().code, ErrorCode::kInvalidMesh);
    EXPECT_EQ(difference_of(follower.balls(), before), 0);
    EXPECT_EQ(follower.state(), CoverState::kSolid);
  }
  EXPECT_EQ(follower.update(not_finite).error().message, "vertex 3 has a coordinate that is not finite");
  ASSERT_TRUE(follower.tighten().ok());  // of the frame before
}

TEST(CoverOfAnyFrame, RefusesBallsOutOfRange) {
  const IndexedMesh mesh = test::indexed(prepare_mesh(test::make_box({1, 1, 1})).value());
  const auto message = [&](const std::vector<Ball>& balls) {
    const Result<CoverFollower> result = CoverFollower::create(mesh, balls);
    return result.ok() ? std::string("accepted") : result.error().message;
  };
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message({{{0.5, 0.5, 0.5}, 1}, {{0, 0, 0}, 0}}), "accepted");
  EXPECT_EQ(message({}), "there is no ball to cover the mesh");
  EXPECT_EQ(message({{{0.5, 0.5, 0.5}, 0}}), "there is no ball to cover the mesh");
  EXPECT_EQ(message({{{0.5, 0.5, 0.5}, 1}, {{0, none, 0}, 1}}), "ball 1 has a number that is out of range");
  EXPECT_EQ(message({{{0.5, 0.5, 0.5}, -1}}), "ball 0 has a number that is out of range");
  EXPECT_EQ(message({{{0.5, 0.5, 0.5}, none}}), "ball 0 has a number that is out of range");
}

}  // namespace
}  // namespace medial_vk
