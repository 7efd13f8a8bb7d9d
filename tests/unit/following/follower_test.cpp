// Balls that follow a mesh: certified in every frame by the reference, and invariant where the frame is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "base/point_ops.h"
#include "cpu_reference/sphere_certificate.h"
#include "medial_vk/ball_union.h"
#include "medial_vk/follower.h"
#include "medial_vk/prepare.h"
#include "solid/solid.h"
#include "support/indexed.h"
#include "support/reference_balls.h"
#include "support/reference_mesh.h"
#include "support/solids/motions.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using Frame = std::vector<Point>;

/// The balls around `count` random points inside a solid.
std::vector<Ball> balls_in(const IndexedMesh& mesh, std::size_t count) {
  const Solid solid = Solid::build(mesh).value();
  const MeshReport& report = mesh.prepared().report;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Ball> balls;
  while (balls.size() < count) {
    Point p{};
    for (std::size_t k = 0; k < 3; ++k) p[k] = report.lower[k] + unit(random) * (report.upper[k] - report.lower[k]);
    const double distance = solid.distance(p);
    if (distance > 1e-3 && solid.contains(p)) balls.push_back({p, distance * (1 - 1e-12)});
  }
  return balls;
}

struct Example {
  explicit Example(Mesh raw, std::size_t count = 120)
      : mesh(test::indexed(prepare_mesh(std::move(raw)).value())), balls(balls_in(mesh, count)) {}

  Frame rest() const { return {mesh.view().vertices.begin(), mesh.view().vertices.end()}; }
  Follower follower(const FollowerOptions& options = {}) const {
    return Follower::create(mesh, balls, options).value();
  }

  IndexedMesh mesh;
  std::vector<Ball> balls;
};

Example torus() { return Example(test::make_turned_torus(40, 20)); }
Example l_shape() { return Example(test::make_l_shape(2, 0.6, 0.8)); }

std::vector<Ball> not_lost(const Follower& follower) {
  std::vector<Ball> balls;
  for (const Ball& ball : follower.balls()) {
    if (ball.radius > 0) balls.push_back(ball);
  }
  return balls;
}

reference::Mesh reference_of(const IndexedMesh& mesh, const Frame& frame) {
  Mesh moved = mesh.prepared().mesh;
  moved.vertices = frame;
  reference::Mesh out = test::to_reference(moved);
  out.closed = mesh.prepared().report.closed;
  return out;
}

/// By the reference: every ball that is not lost lies inside the frame.
void expect_inside(const Follower& follower, const IndexedMesh& mesh, const Frame& frame, const std::string& where) {
  const reference::Certificate certificate =
      reference::check_inside(reference_of(mesh, frame), test::to_reference(not_lost(follower)));
  for (const auto& line : certificate.lines) EXPECT_EQ(line.failed, 0u) << where << ": " << line.first_failure;
}

std::size_t lost(const Follower& follower) {
  return static_cast<std::size_t>(std::ranges::count(follower.states(), FollowState::kOutside));
}

double greatest_difference(std::span<const Ball> a, std::span<const Ball> b) {
  double difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference = std::max({difference, length(a[i].centre - b[i].centre), std::fabs(a[i].radius - b[i].radius)});
  }
  return difference;
}

std::vector<Ball> copy_of(std::span<const Ball> balls) { return {balls.begin(), balls.end()}; }

class FollowerInMotion : public testing::TestWithParam<std::tuple<test::Motion, std::uint32_t>> {};

TEST_P(FollowerInMotion, BallsAreInsideInEveryFrame) {
  const auto [motion, steps] = GetParam();
  for (const Example& example : {torus(), l_shape()}) {
    FollowerOptions options;
    options.steps = steps;
    Follower follower = example.follower(options);
    for (const double time : {0.25, 0.5, 0.75, 1.0}) {
      const Frame frame = test::moved_vertices(example.rest(), motion, time);
      ASSERT_TRUE(follower.update(frame).ok());
      expect_inside(follower, example.mesh, frame, std::string(test::name_of(motion)) + " " + std::to_string(time));
      EXPECT_EQ(lost(follower), 0u);
    }
  }
}

TEST_P(FollowerInMotion, ThereAndBackEndsAtTheRestPose) {
  const auto [motion, steps] = GetParam();
  const Example example = l_shape();
  FollowerOptions options;
  options.steps = steps;
  Follower follower = example.follower(options);
  const std::vector<Ball> rest = copy_of(follower.balls());
  for (const double time : {0.5, 1.0, 0.5, 0.0}) {
    ASSERT_TRUE(follower.update(test::moved_vertices(example.rest(), motion, time)).ok());
  }
  // A frame by formulas at time 0 differs from the rest pose by rounding.
  EXPECT_LE(greatest_difference(follower.balls(), rest), 1e-7);
}

INSTANTIATE_TEST_SUITE_P(All, FollowerInMotion,
                         testing::Combine(testing::ValuesIn(test::kMotions), testing::Values(0u, 1u)),
                         [](const auto& parameters) {
                           return std::string(test::name_of(std::get<0>(parameters.param))) +
                                  (std::get<1>(parameters.param) > 0 ? "_with_a_step" : "");
                         });

TEST(Follower, GivenBallsLieInThoseOfTheRestPose) {
  const Example example = l_shape();
  const Follower follower = example.follower();
  for (std::size_t i = 0; i < example.balls.size(); ++i) {
    const Ball &given = example.balls[i], &grown = follower.balls()[i];
    EXPECT_GE(grown.radius, length(grown.centre - given.centre) + given.radius - 1e-8) << i;
  }
  expect_inside(follower, example.mesh, example.rest(), "rest");
}

TEST(Follower, TheRestPoseAsAFrameChangesNothing) {
  const Example example = torus();
  Follower follower = example.follower();
  const std::vector<Ball> rest = copy_of(follower.balls());
  ASSERT_TRUE(follower.update(example.rest()).ok());
  EXPECT_LE(greatest_difference(follower.balls(), rest), 1e-14);
}

/// A rotation, then a shift; or a reflection in a plane.
Point turned(const Point& p) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  return {c * p[0] - s * p[1] + 3, s * p[0] + c * p[1] - 5, p[2] + 0.25};
}
Point mirrored(const Point& p) { return {-p[0], p[1], p[2]}; }

void expect_balls_move_with(Point (*move)(const Point&), std::uint32_t steps) {
  const Example example = torus();
  FollowerOptions options;
  options.steps = steps;
  Follower plain = example.follower(options), moved = example.follower(options);
  for (const double time : {0.3, 0.6, 1.0}) {
    const Frame frame = test::moved_vertices(example.rest(), test::Motion::kBend, time);
    Frame image = frame;
    std::ranges::transform(image, image.begin(), move);
    ASSERT_TRUE(plain.update(frame).ok());
    ASSERT_TRUE(moved.update(image).ok());
    std::vector<Ball> expected = copy_of(plain.balls());
    for (Ball& ball : expected) ball.centre = move(ball.centre);
    EXPECT_LE(greatest_difference(moved.balls(), expected), 1e-6) << time;
    expect_inside(plain, example.mesh, frame, "plain");
  }
}

TEST(Follower, BallsTurnWithTheFrame) { expect_balls_move_with(turned, 0); }
TEST(Follower, BallsOfAMirroredFrameAreMirrored) { expect_balls_move_with(mirrored, 0); }

TEST(Follower, ResultsDoNotDependOnThreads) {
  const Example example = torus();
  FollowerOptions options;
  options.steps = 1;
  std::vector<std::vector<Ball>> results;
  for (const unsigned threads : {1u, 3u}) {
    options.threads = threads;
    Follower follower = example.follower(options);
    for (const double time : {0.5, 1.0}) {
      ASSERT_TRUE(follower.update(test::moved_vertices(example.rest(), test::Motion::kTwist, time)).ok());
    }
    results.push_back(copy_of(follower.balls()));
  }
  EXPECT_EQ(greatest_difference(results[0], results[1]), 0);
}

TEST(Follower, AfterAResetEarlierFramesDoNotMatter) {
  const Example example = l_shape();
  Follower seen = example.follower(), fresh = example.follower();
  ASSERT_TRUE(seen.update(test::moved_vertices(example.rest(), test::Motion::kRipple, 1)).ok());
  ASSERT_TRUE(seen.reset().ok());
  EXPECT_EQ(greatest_difference(seen.balls(), fresh.balls()), 0);
  const Frame frame = test::moved_vertices(example.rest(), test::Motion::kSquash, 1);
  ASSERT_TRUE(seen.update(frame).ok());
  ASSERT_TRUE(fresh.update(frame).ok());
  EXPECT_EQ(greatest_difference(seen.balls(), fresh.balls()), 0);
}

TEST(Follower, TrianglesWithoutAreaArePermitted) {
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

TEST(Follower, AFrameWithoutVolumeLosesAllBallsForItsTime) {
  const Example example = torus();
  Follower follower = example.follower();
  Frame frame = example.rest();
  for (Point& p : frame) p[2] = 0;
  ASSERT_TRUE(follower.update(frame).ok());
  for (const Ball& ball : follower.balls()) EXPECT_LE(ball.radius, 1e-9);
  ASSERT_TRUE(follower.update(example.rest()).ok());
  expect_inside(follower, example.mesh, example.rest(), "after it");
  EXPECT_EQ(lost(follower), 0u);
}

TEST(Follower, PartsThatCrossKeepBallsInside) {
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

TEST(Follower, AnOpenMeshIsFollowedByItsWindingNumber) {
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
  EXPECT_LT(lost(follower), 10u);
}

TEST(Follower, AFaultyFrameChangesNothing) {
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

TEST(Follower, RefusesBallsThatAreNotInside) {
  const IndexedMesh mesh = test::indexed(prepare_mesh(test::make_box({1, 1, 1})).value());
  const auto message = [&](const Ball& ball) {
    const Result<Follower> result = Follower::create(mesh, {{Ball{{0.5, 0.5, 0.5}, 0.5}, ball}});
    return result.ok() ? std::string("accepted") : result.error().message;
  };
  EXPECT_EQ(message({{0.5, 0.5, 0.4}, 0.4}), "accepted");
  EXPECT_EQ(message({{0.5, 0.5, 0.4}, 0.41}), "ball 1 is not inside the mesh");
  EXPECT_EQ(message({{0.5, 0.5, 1.4}, 0.1}), "ball 1 is not inside the mesh");
  EXPECT_EQ(message({{0.5, 0.5, 0.4}, 0}), "ball 1 has a number that is not finite, or no positive radius");
  FollowerOptions options;
  options.protrusion = 0;
  EXPECT_EQ(Follower::create(mesh, {{Ball{{0.5, 0.5, 0.5}, 0.5}}}, options).error().code, ErrorCode::kUsage);
  EXPECT_EQ(Follower::create(mesh, {}).error().code, ErrorCode::kUsage);
}

TEST(Follower, MeasuresAreThoseOfTheFrame) {
  const Example example = torus();
  FollowerOptions options;
  options.steps = 1;
  Follower follower = example.follower(options);
  const Frame frame = test::moved_vertices(example.rest(), test::Motion::kSquash, 1);
  ASSERT_TRUE(follower.update(frame).ok());
  Mesh moved = example.mesh.prepared().mesh;
  moved.vertices = frame;
  const FollowMeasures measures = follower.measure().value();
  EXPECT_NEAR(measures.solid_volume, test::signed_volume(moved), 1e-9);
  EXPECT_EQ(measures.ball_volume, measure_ball_union(follower.balls()).value().volume);
  EXPECT_EQ(measures.outside_bound, 0);
  EXPECT_GT(measures.uncovered(), 0);
  // Steps towards a greater volume find one.
  Follower without = example.follower();
  ASSERT_TRUE(without.update(frame).ok());
  EXPECT_GT(measures.ball_volume, without.measure().value().ball_volume);
}

}  // namespace
}  // namespace medial_vk
