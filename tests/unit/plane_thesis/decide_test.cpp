// Algorithm 4 on circles: Lemmas 4.1 to 4.3 against the exact axis, decisions that are known, and refused input.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "medial_vk/plane_axis.h"
#include "medial_vk/plane_thesis.h"
#include "plane/sites/vec2.h"
#include "support/plane_thesis/axis_distance.h"
#include "support/plane_thesis/random_shapes.h"

namespace medial_vk {
namespace {

PreparedShape prepared(const std::vector<PlaneRing>& rings) {
  return prepare_shape(rings, FillRule::kEvenOdd, 1).value();
}

PreparedShape square() { return prepared({{{0, 0}, {4, 0}, {4, 4}, {0, 4}}}); }

CircleDecision decide(const PlaneBoundary& boundary, const PlaneCircle& circle, unsigned samples) {
  return decide_medial_axis(boundary, circle, samples).value();
}

TEST(PlaneThesisDecide, ACircleBesideOneSideIsUndetermined) {
  const PlaneBoundary boundary = PlaneBoundary::build(square()).value();
  const CircleDecision decision = decide(boundary, {{2, 0.5}, 0.25}, 12);
  EXPECT_EQ(decision.decision, MedialDecision::kUndetermined);
  EXPECT_EQ(decision.reason, DecisionReason::kNone);
  // Each sample is the opposite of another one, but the two whose gradients are tangent.
  EXPECT_EQ(decision.points.size(), 12u);
  for (const CirclePoint& p : decision.points) {
    const CirclePoint& opposite = decision.points[p.opposite];
    EXPECT_NEAR(p.point[0], opposite.point[0], 1e-15);
    EXPECT_EQ(p.nearest.foot[1], 0);
    EXPECT_EQ(p.nearest.direction[1], -1);
    EXPECT_EQ(p.nearest.distance, p.point[1]);
  }
}

TEST(PlaneThesisDecide, ACircleOnTheDiagonalIsTrueByOppositeGradients) {
  const PlaneBoundary boundary = PlaneBoundary::build(square()).value();
  const CircleDecision decision = decide(boundary, {{1, 1}, 0.5}, 12);
  EXPECT_EQ(decision.decision, MedialDecision::kTrue);
  EXPECT_EQ(decision.reason, DecisionReason::kOppositeDiffers);
}

TEST(PlaneThesisDecide, NearestIsThatOfAllSegments) {
  SplitMix random(5);
  for (unsigned family = 0; family < test::kShapeFamilies; ++family) {
    const PreparedShape shape = prepared(test::random_shape(family, 3));
    const PlaneBoundary boundary = PlaneBoundary::build(shape).value();
    for (int i = 0; i < 300; ++i) {
      const PlanePoint p = {1.5 * random.symmetric(), 1.5 * random.symmetric()};
      const NearestBoundary nearest = boundary.nearest(p);
      double least = std::numeric_limits<double>::infinity();
      for (const auto& [a, b] : shape.segments) {
        const plane::Vec2 from = {shape.points[a][0], shape.points[a][1]},
                          to = {shape.points[b][0], shape.points[b][1]};
        const plane::Vec2 x = {p[0], p[1]};
        const double share = std::clamp(plane::dot(x - from, to - from) / plane::dot(to - from, to - from), 0.0, 1.0);
        least = std::min(least, plane::distance(x, from + share * (to - from)));
      }
      EXPECT_NEAR(nearest.distance, least, 1e-14);
      EXPECT_NEAR(nearest.foot[0], p[0] + nearest.distance * nearest.direction[0], 1e-14);
      EXPECT_NEAR(nearest.foot[1], p[1] + nearest.distance * nearest.direction[1], 1e-14);
    }
  }
}

/// Lemma 4.3, and Lemmas 2.3, 4.1 and 4.2 by the segment that the reason names.
TEST(PlaneThesisDecide, ATrueCircleHoldsAMedialPointOnTheSegmentThatIsNamed) {
  std::array<int, 14> reasons = {};
  PlaneAxisOptions all_angles;
  all_angles.object_angle = 0;
  for (unsigned family = 0; family < test::kShapeFamilies; ++family) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      const PreparedShape shape = prepared(test::random_shape(family, seed));
      const PlaneAxis axis = find_plane_axis(shape, all_angles).value();
      const PlaneBoundary boundary = PlaneBoundary::build(shape).value();
      SplitMix random(seed);
      for (int i = 0; i < 300; ++i) {
        PlaneCircle circle = {{random.symmetric(), random.symmetric()}, 0};
        const NearestBoundary nearest = boundary.nearest(circle.centre);
        if (!nearest.is_inside || nearest.distance < 1e-3) continue;
        circle.radius = nearest.distance * test::uniform(random, 0.05, 0.95);
        const std::array<double, 4> angles = {test::uniform(random, 0, 1.5), test::uniform(random, 1.6, 3),
                                              test::uniform(random, 3.1, 4.5), test::uniform(random, 4.6, 6)};
        const CircleDecision decision = decide_medial_axis(boundary, circle, angles).value();
        ++reasons.at(static_cast<std::size_t>(decision.reason));
        if (decision.decision == MedialDecision::kUndetermined) continue;
        EXPECT_TRUE(test::crosses_axis(axis, decision.points[decision.found[0]].point,
                                       decision.points[decision.found[1]].point))
            << test::family_name(family) << " " << seed << " circle " << i;
      }
    }
  }
  EXPECT_GT(reasons[0], 0);
  EXPECT_GT(reasons[3], 0);
  EXPECT_GT(reasons[8], 0);
  EXPECT_GT(reasons[13], 0);
}

TEST(PlaneThesisDecide, TheResultIsThatOfAnyScale) {
  for (const double scale : {1e-9, 1.0, 1e9}) {
    PlaneRing ring = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
    for (PlanePoint& p : ring) p = {scale * p[0], scale * p[1]};
    const PlaneBoundary boundary = PlaneBoundary::build(prepared({ring})).value();
    EXPECT_EQ(decide(boundary, {{scale, scale}, 0.5 * scale}, 7).decision, MedialDecision::kTrue);
    EXPECT_EQ(decide(boundary, {{2 * scale, 0.5 * scale}, 0.4 * scale}, 7).decision, MedialDecision::kUndetermined);
  }
}

TEST(PlaneThesisDecide, RefusesCirclesOutsideAndTooFewSamples) {
  const PlaneBoundary boundary = PlaneBoundary::build(square()).value();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const PlaneCircle& circle : {PlaneCircle{{1, 1}, 1.01}, PlaneCircle{{5, 1}, 0.5}, PlaneCircle{{1, 1}, 0},
                                    PlaneCircle{{nan, 1}, 0.5}, PlaneCircle{{1, 1}, nan}}) {
    const Result<CircleDecision> decision = decide_medial_axis(boundary, circle, 8u);
    ASSERT_FALSE(decision);
    EXPECT_EQ(decision.error().code, ErrorCode::kUsage);
  }
  EXPECT_EQ(decide_medial_axis(boundary, {{1, 1}, 0.5}, 2u).error().code, ErrorCode::kUsage);
  EXPECT_EQ(decide_medial_axis(boundary, {{1, 1}, 0.5}, std::vector<double>{0, 1, nan}).error().code,
            ErrorCode::kUsage);
  EXPECT_EQ(PlaneBoundary::build({}).error().code, ErrorCode::kInvalidMesh);
}

}  // namespace
}  // namespace medial_vk
