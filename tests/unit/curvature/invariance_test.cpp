// What the result does not depend on, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "unit/curvature/ball_sheets.h"

namespace medial_vk {
namespace {

using test::BallSheet;

void expect_same_bytes(const BoundaryCurvature& a, const BoundaryCurvature& b) {
  ASSERT_EQ(a.balls.size(), b.balls.size());
  EXPECT_EQ(a.spacing, b.spacing);
  const auto bytes = [](const auto& value) {
    std::array<unsigned char, sizeof(value)> out;
    std::memcpy(out.data(), &value, sizeof(value));
    return out;
  };
  for (std::size_t i = 0; i < a.balls.size(); ++i) {
    EXPECT_EQ(bytes(a.balls[i].object_angle), bytes(b.balls[i].object_angle));
    for (std::size_t side = 0; side < 2; ++side) {
      const TipCurvature &p = a.balls[i].tips[side], &q = b.balls[i].tips[side];
      EXPECT_EQ(p.state, q.state);
      EXPECT_EQ(bytes(p.normal), bytes(q.normal));
      EXPECT_EQ(bytes(p.kappa), bytes(q.kappa));
      EXPECT_EQ(bytes(p.directions), bytes(q.directions));
      EXPECT_EQ(bytes(std::array{p.error, p.spread, p.normal_error, p.window}),
                bytes(std::array{q.error, q.spread, q.normal_error, q.window}));
    }
  }
}

TEST(CurvatureInvariance, ThreadsChangeNothing) {
  const BallSheet sheet = test::spheroid(2, 1, 0.08);
  for (const CurvatureMethod method : {CurvatureMethod::kFits, CurvatureMethod::kDifferences}) {
    CurvatureOptions one, three;
    one.method = three.method = method;
    one.threads = 1;
    three.threads = 3;
    expect_same_bytes(measure_curvature(sheet.balls, one, sheet.spokes).value(),
                      measure_curvature(sheet.balls, three, sheet.spokes).value());
  }
}

TEST(CurvatureInvariance, APowerOfTwoScalesExactly) {
  const BallSheet sheet = test::spheroid(2, 1, 0.08);
  std::vector<Ball> larger = sheet.balls;
  for (Ball& ball : larger) ball = {8 * ball.centre, 8 * ball.radius};
  BoundaryCurvature scaled = measure_curvature(larger).value();
  scaled.spacing /= 8;
  for (BallCurvature& ball : scaled.balls) {
    for (TipCurvature& tip : ball.tips) {
      tip.kappa = {8 * tip.kappa[0], 8 * tip.kappa[1]};
      tip.error *= 8;
      tip.spread *= 8;
      tip.window /= 8;
    }
  }
  expect_same_bytes(measure_curvature(sheet.balls).value(), scaled);
}

TEST(CurvatureInvariance, RigidMotionsChangeRoundingAlone) {
  const BallSheet sheet = test::spheroid(2, 1, 0.08);
  // A rotation by quaternion (1, 2, 3, 4) / sqrt(30), and a shift.
  const std::array<Point, 3> rows = {Point{-20, 4, 22}, Point{20, -10, 20}, Point{10, 28, 4}};
  const auto turned = [&](const Point& p) {
    return 1.0 / 30 * Point{dot(rows[0], p), dot(rows[1], p), dot(rows[2], p)};
  };
  std::vector<Ball> moved = sheet.balls;
  std::vector<SpokePair> spokes = sheet.spokes;
  for (Ball& ball : moved) ball.centre = turned(ball.centre) + Point{0.3, -2, 1};
  for (SpokePair& pair : spokes) pair = {turned(pair.a), turned(pair.b)};
  const BoundaryCurvature before = measure_curvature(sheet.balls, {}, sheet.spokes).value();
  const BoundaryCurvature after = measure_curvature(moved, {}, spokes).value();
  std::size_t same = 0, all = 0;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    for (std::size_t side = 0; side < 2; ++side) {
      const TipCurvature &p = before.balls[i].tips[side], &q = after.balls[i].tips[side];
      ASSERT_EQ(p.state, q.state);
      if (!is_known(p.state)) continue;
      const double change = std::max(std::fabs(p.kappa[0] - q.kappa[0]), std::fabs(p.kappa[1] - q.kappa[1]));
      // Rounding may choose another window where two are equally good; else coefficients keep half of their digits,
      // of curvatures up to 4.
      EXPECT_LE(change, p.error + q.error);
      EXPECT_LE(length(turned(p.normal) - q.normal), p.normal_error + q.normal_error);
      ++all;
      if (change < 4e-8) ++same;
    }
  }
  EXPECT_GT(all, moved.size());
  EXPECT_GT(same, 95 * all / 100);
}

TEST(CurvatureInvariance, FarFromTheOriginTipsAreTheSame) {
  // A shift by a power of two, of coordinates that it does not round.
  BallSheet sheet = test::spheroid(2, 1, 0.08);
  for (Ball& ball : sheet.balls) {
    for (double& x : ball.centre) x = std::round(x * 0x1p30) * 0x1p-30;
  }
  std::vector<Ball> moved = sheet.balls;
  for (Ball& ball : moved) ball.centre = ball.centre + Point{0x1p20, 0x1p20, -0x1p20};
  const BoundaryCurvature before = measure_curvature(sheet.balls).value(), after = measure_curvature(moved).value();
  std::size_t same = 0, known = 0;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    for (std::size_t side = 0; side < 2; ++side) {
      const TipCurvature &p = before.balls[i].tips[side], &q = after.balls[i].tips[side];
      if (!is_known(p.state)) continue;
      ++known;
      // Tips are rounded to 2^-32 there, over squares of windows of 5 spacings or more: less than 10^-8.
      if (std::fabs(p.kappa[0] - q.kappa[0]) < 1e-8 && std::fabs(p.kappa[1] - q.kappa[1]) < 1e-8) ++same;
    }
  }
  EXPECT_GT(known, moved.size());
  EXPECT_GT(same, 95 * known / 100);
}

TEST(CurvatureInvariance, SpokesNameTipsOfWhichOneIsUnknown) {
  // The inner radius is less than the spacing: nothing is known of the inner tip but where windows happen to agree.
  BallSheet sheet = test::pipe_wall(0.2, 10, 0.25);
  for (SpokePair& pair : sheet.spokes) std::swap(pair.a, pair.b);
  const BoundaryCurvature result = measure_curvature(sheet.balls, {}, sheet.spokes).value();
  std::array<std::size_t, 2> alone = {};
  for (std::size_t i = 0; i < sheet.balls.size(); ++i) {
    const auto& tips = result.balls[i].tips;
    const std::array<bool, 2> is_there = {!std::isnan(tips[0].normal[0]), !std::isnan(tips[1].normal[0])};
    if (is_there[0] == is_there[1]) continue;
    const std::size_t side = is_there[0] ? 0 : 1;
    ++alone[side];
    EXPECT_GT(dot(tips[side].normal, side == 0 ? sheet.spokes[i].a : sheet.spokes[i].b), 0);
  }
  EXPECT_GT(alone[1], 10u);
}

TEST(CurvatureErrors, NameWhatIsWrong) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Ball> ball = {{{0, 0, 0}, 1}};
  const std::vector<SpokePair> pair = {{{1, 0, 0}, {0, 1, 0}}};
  const auto message_of = [](const Result<BoundaryCurvature>& result) {
    EXPECT_FALSE(result.ok());
    if (result.ok()) return std::string();
    EXPECT_EQ(result.error().code, ErrorCode::kUsage);
    return result.error().message;
  };
  using testing::HasSubstr;
  EXPECT_THAT(message_of(measure_curvature(std::vector<Ball>{{{0, 0, 0}, 1}, {{nan, 0, 0}, 1}})), HasSubstr("ball 1"));
  EXPECT_THAT(message_of(measure_curvature(std::vector<Ball>{{{0, 0, 0}, 0}})), HasSubstr("positive radius"));
  // Beyond 1e18, squares and sums of them are no longer certain to be finite.
  for (const double far : {1.1e18, 1e300, std::numeric_limits<double>::max()}) {
    EXPECT_THAT(message_of(measure_curvature(std::vector<Ball>{{{0, 0, 0}, 1}, {{0, -far, 0}, 1}})),
                HasSubstr("ball 1"));
    EXPECT_THAT(message_of(measure_curvature(std::vector<Ball>{{{0, 0, 0}, far}})), HasSubstr("1e18"));
  }
  const std::vector<SpokePair> two = {pair[0], pair[0]}, lengths = {{{2, 0, 0}, {0, 1, 0}}};
  EXPECT_THAT(message_of(measure_curvature(ball, {}, two)), HasSubstr("as many"));
  EXPECT_THAT(message_of(measure_curvature(ball, {}, lengths)), HasSubstr("unit vectors"));
  CurvatureOptions options;
  options.spacing = -1;
  EXPECT_THAT(message_of(measure_curvature(ball, options)), HasSubstr("spacing"));
  options = {};
  options.method = CurvatureMethod::kDifferences;
  EXPECT_THAT(message_of(measure_curvature(ball, options)), HasSubstr("spokes"));
  options.step = 3;
  EXPECT_THAT(message_of(measure_curvature(ball, options, pair)), HasSubstr("step"));
}

TEST(CurvatureErrors, ExtremeNumbersEnd) {
  // Many balls, so that the search for the 16th neighbour is not one for all: two heaps at the greatest distance.
  std::vector<Ball> balls;
  for (int i = 0; i < 40; ++i) balls.push_back({{i < 20 ? -1e18 : 1e18, 1e3 * i, 0}, i < 20 ? 1e18 : 1});
  const BoundaryCurvature far = measure_curvature(balls).value();
  EXPECT_GT(far.spacing, 0);
  EXPECT_EQ(far.balls.size(), balls.size());
  // As near as numbers are.
  for (std::size_t i = 0; i < balls.size(); ++i) balls[i] = {{5e-324 * static_cast<double>(i), 0, 0}, 5e-324};
  EXPECT_EQ(measure_curvature(balls).value().balls.size(), balls.size());
}

TEST(CurvatureErrors, AStopEndsTheCall) {
  const BallSheet sheet = test::spheroid(2, 1, 0.08);
  std::stop_source stop;
  std::vector<std::string> stages;
  const auto progress = [&](const char* stage, double done) {
    stages.emplace_back(stage);
    EXPECT_GE(done, 0);
    EXPECT_LE(done, 1);
    if (stages.back() == "tips") stop.request_stop();
  };
  const auto result = measure_curvature(sheet.balls, {}, {}, progress, stop.get_token());
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::kInterrupted);
  EXPECT_EQ(stages, (std::vector<std::string>{"sheets", "regions", "tips"}));
}

}  // namespace
}  // namespace medial_vk
