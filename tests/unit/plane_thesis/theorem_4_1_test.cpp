// Theorem 4.1 and the tighter bounds of docs/theory.md: on random circles, and that the checks themselves can fail.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/plane_thesis/circle_trials.h"
#include "support/plane_thesis/missed_points.h"
#include "support/plane_thesis/random_shapes.h"

namespace medial_vk::test {
namespace {

TEST(Theorem41, HoldsForRandomCirclesAndForTheWorstNearThem) {
  TrialCounts counts;
  for (unsigned family = 0; family < kShapeFamilies; ++family) {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      const TrialShape shape(family, seed);
      ASSERT_TRUE(shape.is_usable());
      shape.try_circles(100, 20, counts);
    }
  }
  EXPECT_TRUE(counts.reports.empty()) << counts.reports.front();
  EXPECT_EQ(counts.counterexamples, (std::array<std::uint64_t, kStatements>{}));
  EXPECT_GT(counts.missing, 50u);
  EXPECT_GT(counts.worst[kPublished].share, 0.5);
  // The theorem on strips is attained: a bound that is smaller by a hundredth would not hold.
  EXPECT_GT(counts.worst[kWithTheFlow].share, 0.99);
}

/// Three specks at the distance 1 from the origin: one below, two above, each turned by `apart` from straight above.
PreparedShape three_specks(double apart) {
  std::vector<PlaneRing> rings = {{{-3, -3}, {3, -3}, {3, 3}, {-3, 3}}};
  for (const double a : {-std::numbers::pi / 2, std::numbers::pi / 2 - apart, std::numbers::pi / 2 + apart}) {
    const double x = std::cos(a), y = std::sin(a), size = 1e-8;
    rings.push_back({{x - size, y}, {x + size, y - size}, {x, y + size}});
  }
  return prepare_shape(rings, FillRule::kEvenOdd, 1).value();
}

/// The second part of the theorem on strips is attained where a tail is as far from the foot below as from its own: the
/// reflection of one in the line of the tail and the medial point is the other.
TEST(Theorem41, TheBendIsNearlyAttained) {
  for (const double half_bend : {0.02, 0.1, 0.2}) {
    const PreparedShape shape = three_specks(2 * half_bend * 1.001);
    const PlaneBoundary boundary = PlaneBoundary::build(shape).value();
    const double half_gap = 0.05, radius = 0.3, turn = std::asin(half_gap / radius);
    const PlaneCircle circle = {{0, radius * std::cos(turn) - half_gap * std::tan(half_bend)}, radius};
    const double down = -std::numbers::pi / 2;
    const std::vector<double> angles = {down - turn, down + turn, down - 2 * turn, down + 2 * turn, 0.1, 0.6, 3.0, 2.5};
    const CircleDecision decision = decide_medial_axis(boundary, circle, angles).value();
    ASSERT_EQ(decision.decision, MedialDecision::kUndetermined) << static_cast<int>(decision.reason);
    const CombedCircle combed(circle, decision.points);
    const PlanePoint left = {-std::sin(2 * half_bend), std::cos(2 * half_bend)};
    const MedialPoint p = {{0, 0}, {left, {0, -1}}, 1, std::numbers::pi - 2 * half_bend};
    ASSERT_TRUE(combed.hull_contains(p.point));
    const double share = combed.strip_shares(p).against_the_flow;
    EXPECT_LE(share, 1.002);  // its chords are turned by a thousandth more than in the limit
    EXPECT_GE(share, 0.998);
  }
}

/// Four chords across a circle around the origin, upwards, with the foot far above.
std::vector<CirclePoint> upward_flow() {
  std::vector<CirclePoint> theta;
  for (int i = 0; i < 8; ++i) {
    const double x = i < 4 ? 0.6 * i - 0.9 : 0.9 - 0.6 * (i - 4);
    const double y = (i < 4 ? -1 : 1) * std::sqrt(1 - x * x);
    CirclePoint p;
    p.point = {x, y};
    p.nearest = {{x, 10}, {0, 1}, 10 - y, true};
    p.opposite = static_cast<std::uint32_t>(7 - i);
    theta.push_back(p);
  }
  return theta;
}

TEST(Theorem41, TheChecksFindAPointThatIsTooDeep) {
  const std::vector<CirclePoint> theta = upward_flow();
  const CombedCircle combed({{0, 0}, 1}, theta);
  EXPECT_TRUE(combed.hull_contains({0, 0}));
  EXPECT_FALSE(combed.hull_contains({0, 0.99}));
  // With one spoke up and one down, from the centre: no circle that is undetermined holds such a point.
  const MedialPoint across = {{0, 0}, {{{0, 10}, {0, -10}}}, 10, std::numbers::pi};
  EXPECT_GT(std::ranges::min(combed.published_shares(across)), 1);
  EXPECT_GT(std::ranges::min(combed.corollary_shares(across)), 1);
  EXPECT_GT(combed.strip_shares(across).against_the_flow, 1);
  // With both spokes up and an angle between them.
  const MedialPoint wide = {{0, 0}, {{{-0.25, 10}, {0.25, 10}}}, std::hypot(0.25, 10), 2 * std::atan(0.025)};
  const double bound = 2 * std::asin(0.3 / wide.distance);  // the flow is parallel, p in the middle of a strip
  EXPECT_NEAR(combed.strip_shares(wide).with_the_flow, wide.angle / bound, 1e-12);
}

}  // namespace
}  // namespace medial_vk::test
