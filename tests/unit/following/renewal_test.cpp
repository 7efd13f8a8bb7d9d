// Balls chosen anew: within their budget, only where the uncovered volume has grown, never for less of the volume, and
// certified as all others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "medial_vk/prepare.h"
#include "support/solids/motions.h"
#include "unit/following/followed_example.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kBudget = 8;

FollowerOptions renewing(double factor, std::uint32_t most = kBudget) {
  FollowerOptions options;
  options.renewed = most;
  options.renewal_factor = factor;
  return options;
}

std::size_t count_of(const Follower& follower, FollowOrigin origin) {
  return static_cast<std::size_t>(std::ranges::count(follower.origins(), origin));
}

double uncovered_share(const Follower& follower) {
  const FollowMeasures measures = follower.measure().value();
  return measures.uncovered() / measures.solid_volume;
}

/// In which the balls miss more than at rest. Ripples do not move the corners of the second solid.
struct Case {
  Example example;
  test::Motion motion;

  Frame at(double time) const { return test::moved_vertices(example.rest(), motion, time); }
};

std::vector<Case> cases() { return {{torus(), test::Motion::kRipple}, {l_shape(), test::Motion::kTwist}}; }

Frame rippled(const Example& example, double time) {
  return test::moved_vertices(example.rest(), test::Motion::kRipple, time);
}

TEST(Renewal, FewBallsLeaveForALargerUnionAndTheOthersStay) {
  for (const Case& shape : cases()) {
    const Example& example = shape.example;
    Follower plain = example.follower(), follower = example.follower(renewing(1));
    std::size_t sum = 0;
    for (const double time : {0.3, 0.6, 1.0}) {
      ASSERT_TRUE(plain.reset().ok() && follower.reset().ok());
      ASSERT_TRUE(plain.update(shape.at(time)).ok() && follower.update(shape.at(time)).ok());
      const std::size_t renewed = count_of(follower, FollowOrigin::kRenewed);
      EXPECT_LE(renewed, kBudget);
      sum += renewed;
      for (std::size_t i = 0; i < example.balls.size(); ++i) {
        const Ball &ball = follower.balls()[i], &before = plain.balls()[i];
        const bool is_same = ball.centre == before.centre && ball.radius == before.radius;
        EXPECT_EQ(is_same, follower.origins()[i] == FollowOrigin::kFollowed) << i;
      }
      const double with = follower.measure().value().ball_volume, without = plain.measure().value().ball_volume;
      EXPECT_TRUE(renewed > 0 ? with > without : with == without) << with << " " << without;
      expect_inside(follower, example.mesh, shape.at(time), std::to_string(time));
    }
    EXPECT_GT(sum, 0u);
  }
}

TEST(Renewal, TheBudgetLimitsHowManyLeave) {
  const Example example = torus();
  std::vector<double> uncovered;
  for (const std::uint32_t most : {0u, 1u, 3u}) {
    Follower follower = example.follower(renewing(1, most));
    ASSERT_TRUE(follower.update(rippled(example, 1)).ok());
    EXPECT_EQ(count_of(follower, FollowOrigin::kRenewed), most);
    uncovered.push_back(uncovered_share(follower));
  }
  EXPECT_LT(uncovered[1], uncovered[0]);
  EXPECT_LT(uncovered[2], uncovered[1]);
}

TEST(Renewal, BallsStayUntilWhatIsUncoveredHasGrownByTheFactor) {
  const Example example = torus();
  Follower plain = example.follower();
  const double rest = uncovered_share(plain);
  ASSERT_TRUE(plain.update(rippled(example, 1)).ok());
  const double growth = uncovered_share(plain) / rest;
  ASSERT_GT(growth, 1.01);
  Follower above = example.follower(renewing(100 * growth)), below = example.follower(renewing(0.999 * growth));
  ASSERT_TRUE(above.update(rippled(example, 1)).ok() && below.update(rippled(example, 1)).ok());
  EXPECT_EQ(count_of(above, FollowOrigin::kRenewed), 0u);
  EXPECT_EQ(greatest_difference(above.balls(), plain.balls()), 0);
  EXPECT_GT(count_of(below, FollowOrigin::kRenewed), 0u);
}

TEST(Renewal, BallsAreInsideInEveryFrameOfAMotion) {
  for (const Case& shape : cases()) {
    FollowerOptions options = renewing(1);
    options.steps = 1;
    Follower follower = shape.example.follower(options);
    std::size_t renewed = 0;
    for (const double time : {0.25, 0.5, 0.75, 1.0, 0.5}) {
      const Frame frame = shape.at(time);
      ASSERT_TRUE(follower.update(frame).ok());
      renewed += count_of(follower, FollowOrigin::kRenewed);
      expect_inside(follower, shape.example.mesh, frame,
                    std::string(test::name_of(shape.motion)) + " " + std::to_string(time));
    }
    EXPECT_GT(renewed, 0u) << test::name_of(shape.motion);
  }
}

TEST(Renewal, AtRestAgainBallsReturnToTheirPlaces) {
  const Example example = torus();
  Follower follower = example.follower(renewing(1));
  const std::vector<Ball> rest = copy_of(follower.balls());
  ASSERT_TRUE(follower.update(rippled(example, 0.5)).ok());
  ASSERT_TRUE(follower.update(rippled(example, 1)).ok());
  EXPECT_GT(greatest_difference(follower.balls(), rest), 0.01);
  ASSERT_TRUE(follower.update(example.rest()).ok());
  EXPECT_GT(count_of(follower, FollowOrigin::kReturned), 0u);
  EXPECT_LE(greatest_difference(follower.balls(), rest), 1e-7);
  ASSERT_TRUE(follower.update(example.rest()).ok());
  EXPECT_EQ(count_of(follower, FollowOrigin::kReturned), 0u);
}

TEST(Renewal, TheRestPoseAsAFrameRenewsNothing) {
  for (const Example& example : {torus(), l_shape()}) {
    Follower follower = example.follower(renewing(1.5));
    const std::vector<Ball> rest = copy_of(follower.balls());
    ASSERT_TRUE(follower.update(example.rest()).ok());
    EXPECT_EQ(count_of(follower, FollowOrigin::kFollowed), rest.size());
    EXPECT_LE(greatest_difference(follower.balls(), rest), 1e-14);
  }
}

TEST(Renewal, AfterAResetEarlierFramesDoNotMatter) {
  const Example example = torus();
  Follower seen = example.follower(renewing(1)), fresh = example.follower(renewing(1));
  ASSERT_TRUE(seen.update(rippled(example, 1)).ok());
  ASSERT_GT(count_of(seen, FollowOrigin::kRenewed), 0u);
  ASSERT_TRUE(seen.reset().ok());
  EXPECT_EQ(count_of(seen, FollowOrigin::kFollowed), example.balls.size());
  EXPECT_EQ(greatest_difference(seen.balls(), fresh.balls()), 0);
  ASSERT_TRUE(seen.update(rippled(example, 0.5)).ok() && fresh.update(rippled(example, 0.5)).ok());
  EXPECT_EQ(greatest_difference(seen.balls(), fresh.balls()), 0);
}

TEST(Renewal, ResultsDoNotDependOnThreads) {
  const Example example = torus();
  std::vector<std::vector<Ball>> results;
  std::vector<std::vector<FollowOrigin>> origins;
  for (const unsigned threads : {1u, 3u}) {
    FollowerOptions options = renewing(1);
    options.steps = 1;
    options.threads = threads;
    Follower follower = example.follower(options);
    for (const double time : {0.5, 1.0}) ASSERT_TRUE(follower.update(rippled(example, time)).ok());
    results.push_back(copy_of(follower.balls()));
    origins.emplace_back(follower.origins().begin(), follower.origins().end());
  }
  EXPECT_EQ(greatest_difference(results[0], results[1]), 0);
  EXPECT_EQ(origins[0], origins[1]);
}

/// Of sides 2, 1 and 1 with a ball at one end, and beside it a small cube with a ball of its own.
class BoxAndCube {
 public:
  BoxAndCube() {
    Mesh raw = test::make_box({2, 1, 1}), cube = test::make_box({kSide, kSide, kSide});
    test::translate(cube, {4, 0, 0});
    const auto first = static_cast<std::uint32_t>(raw.vertices.size());
    raw.vertices.insert(raw.vertices.end(), cube.vertices.begin(), cube.vertices.end());
    for (const Triangle& t : cube.triangles) raw.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    mesh = test::indexed(prepare_mesh(std::move(raw)).value());
  }

  /// The cube is flat, and the box is lower.
  Frame frame(double height) const {
    Frame frame(mesh.view().vertices.begin(), mesh.view().vertices.end());
    for (Point& p : frame) p[2] *= p[0] > 3 ? 0 : height;
    return frame;
  }

  static constexpr double kSide = 0.4;
  IndexedMesh mesh = test::indexed(prepare_mesh(test::make_box({1, 1, 1})).value());
  std::vector<Ball> balls = {{{0.5, 0.5, 0.5}, 0.45}, {{4 + kSide / 2, kSide / 2, kSide / 2}, 0.19}};
};

TEST(Renewal, ALostBallGoesToAGapAndIsThenMeasuredByItsNewRadius) {
  const BoxAndCube solid;
  Follower plain = Follower::create(solid.mesh, solid.balls).value();
  ASSERT_TRUE(plain.update(solid.frame(1)).ok());
  ASSERT_EQ(plain.states()[1], FollowState::kLost);
  Follower follower = Follower::create(solid.mesh, solid.balls, renewing(1)).value();
  ASSERT_TRUE(follower.update(solid.frame(1)).ok());
  EXPECT_EQ(follower.origins()[0], FollowOrigin::kFollowed);
  EXPECT_EQ(follower.origins()[1], FollowOrigin::kRenewed);
  EXPECT_EQ(follower.states()[1], FollowState::kMedial);
  EXPECT_LT(follower.balls()[1].centre[0], 2);
  const double radius = follower.balls()[1].radius;
  EXPECT_GT(radius, 0.3);
  expect_inside(follower, solid.mesh, solid.frame(1), "beside the flat cube");
  // Larger than in the cube, but below half of what it was.
  const double height = 0.9 * radius;
  ASSERT_TRUE(follower.update(solid.frame(height)).ok());
  EXPECT_LT(follower.balls()[1].radius, 0.5 * radius);
  EXPECT_EQ(follower.origins()[1], FollowOrigin::kFollowed);
  EXPECT_EQ(follower.states()[1], FollowState::kShrunk);
}

/// Two tori apart, with many balls in the first one and few in the second, which grows.
struct GrowingTorus {
  GrowingTorus() : example(two_tori(), 160) {
    std::size_t in_second = 0;
    std::erase_if(example.balls, [&](const Ball& ball) { return ball.centre[0] > 2 && ++in_second > 6; });
  }

  static Mesh two_tori() {
    Mesh both = test::make_turned_torus(24, 12);
    test::append(both, test::moved(test::make_turned_torus(24, 12), {4, 0, 0}));
    return both;
  }

  Frame grown(double factor) const {
    Frame frame = example.rest();
    for (Point& p : frame) {
      if (p[0] > 2) p = {4 + factor * (p[0] - 4), factor * p[1], factor * p[2]};
    }
    return frame;
  }

  Example example;
};

// The first torus, which balls leave, is at rest all the time: they must not go back and forth.
TEST(Renewal, BallsStayAwayWhileTheyAreNeededElsewhere) {
  const GrowingTorus tori;
  FollowerOptions options = renewing(1.02, 3);
  options.steps = 0;  // steps alone fill much of what has grown
  Follower follower = tori.example.follower(options);
  const std::vector<Ball> rest = copy_of(follower.balls());
  std::size_t renewed = 0;
  double before = 1;
  for (int frame = 0; frame < 6; ++frame) {
    ASSERT_TRUE(follower.update(tori.grown(1.5)).ok());
    renewed += count_of(follower, FollowOrigin::kRenewed);
    EXPECT_EQ(count_of(follower, FollowOrigin::kReturned), 0u) << frame;
    const double uncovered = uncovered_share(follower);
    EXPECT_LE(uncovered, before * (1 + 1e-9)) << frame;
    before = uncovered;
  }
  EXPECT_GT(renewed, 3u);  // more than the budget of one frame
  ASSERT_TRUE(follower.update(tori.example.rest()).ok());
  EXPECT_GT(count_of(follower, FollowOrigin::kReturned), 3u);
  EXPECT_LE(greatest_difference(follower.balls(), rest), 1e-7);
}

TEST(Renewal, WhereAllBallsAreLostOthersAreChosen) {
  GrowingTorus tori;
  std::erase_if(tori.example.balls, [](const Ball& ball) { return ball.centre[0] < 2; });
  Follower follower = tori.example.follower(renewing(1, 2));
  Frame frame = tori.example.rest();
  for (Point& p : frame) {
    if (p[0] > 2) p[2] = 0;
  }
  ASSERT_TRUE(follower.update(frame).ok());
  EXPECT_GT(count_of(follower, FollowOrigin::kRenewed), 0u);
  EXPECT_GT(follower.measure().value().ball_volume, 0);
  expect_inside(follower, tori.example.mesh, frame, "the second torus is flat");
}

TEST(Renewal, WithoutAnyBallNothingIsChosen) {
  const IndexedMesh mesh = test::indexed(prepare_mesh(test::make_box({1, 1, 1})).value());
  const std::vector<Ball> balls = {{{0.5, 0.5, 0.5}, 0.4}};
  Follower follower = Follower::create(mesh, balls, renewing(1)).value();
  Frame frame(mesh.view().vertices.begin(), mesh.view().vertices.end());
  for (Point& p : frame) p[2] = 0;
  ASSERT_TRUE(follower.update(frame).ok());
  EXPECT_EQ(follower.states()[0], FollowState::kLost);
  EXPECT_EQ(follower.origins()[0], FollowOrigin::kFollowed);
}

TEST(Renewal, OptionsThatAreRefused) {
  const auto message = [](const IndexedMesh& mesh, const FollowerOptions& options) {
    const std::vector<Ball> balls = {{{0.5, 0.5, 0.5}, 0.4}};
    const Result<Follower> follower = Follower::create(mesh, balls, options);
    EXPECT_FALSE(follower.ok());
    EXPECT_EQ(follower.error().code, ErrorCode::kUsage);
    return follower.error().message;
  };
  const IndexedMesh closed = test::indexed(prepare_mesh(test::make_box({1, 1, 1})).value());
  FollowerOptions options = renewing(1.5);
  options.rule = FollowRule::kPublished;
  EXPECT_NE(message(closed, options).find("`renewed`"), std::string::npos);
  for (const double factor : {0.5, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_NE(message(closed, renewing(factor)).find("`renewal_factor`"), std::string::npos) << factor;
  }
  Mesh open = test::make_box({1, 1, 1});
  open.triangles.pop_back();
  EXPECT_NE(message(test::indexed(prepare_mesh(std::move(open)).value()), renewing(1.5)).find("not closed"),
            std::string::npos);
}

}  // namespace
}  // namespace medial_vk
