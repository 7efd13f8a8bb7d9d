// FollowMeasures::solid_volume: that of the solid in mirrored and thin frames, and NaN where the triangles contradict
// the balls, have no volume beyond rounding, or do not enclose any.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "unit/following/followed_example.h"

namespace medial_vk {
namespace {

using Place = std::function<Point(const Point&)>;

FollowMeasures measured(const Example& example, FollowRule rule, const Place& place) {
  FollowerOptions options;
  options.rule = rule;
  Follower follower = example.follower(options);
  Frame frame = example.rest();
  std::ranges::transform(frame, frame.begin(), place);
  EXPECT_TRUE(follower.update(frame).ok());
  return follower.measure().value();
}

constexpr FollowRule kBothRules[] = {FollowRule::kTangent, FollowRule::kPublished};

TEST(KnownVolume, OfImagesOfASolid) {
  const Example example(test::make_turned_torus(40, 20), 60);
  const double at_rest = std::fabs(test::signed_volume(example.mesh.prepared().mesh));
  for (const FollowRule rule : kBothRules) {
    EXPECT_NEAR(measured(example, rule, [](const Point& p) { return p; }).solid_volume, at_rest, 1e-12);
    const FollowMeasures mirrored = measured(example, rule, [](const Point& p) { return Point{-p[0], p[1], p[2]}; });
    EXPECT_NEAR(mirrored.solid_volume, at_rest, 1e-12);
    EXPECT_GT(mirrored.uncovered(), 0);
    const FollowMeasures inverted = measured(example, rule, [](const Point& p) { return -1.0 * p; });
    EXPECT_NEAR(inverted.solid_volume, at_rest, 1e-12);
    // Along an axis nothing is lost to rounding, however thin the frame is.
    const auto thin = [](const Point& p) { return Point{p[0], p[1], 1e-12 * p[2]}; };
    EXPECT_NEAR(measured(example, rule, thin).solid_volume, 1e-12 * at_rest, 1e-22);
  }
}

TEST(KnownVolume, NotOfAFrameWhosePartsCancel) {
  const Example example(test::make_torus(1, 0.4, 20, 40), 60);
  // Right and left have winding numbers of opposite signs, and nearly the same volumes. The balls are on one side.
  const auto bow = [](const Point& p) { return Point{p[0], (p[0] - 0.05) * p[1], p[2]}; };
  for (const FollowRule rule : kBothRules) {
    const FollowMeasures measures = measured(example, rule, bow);
    EXPECT_GT(measures.ball_volume, 0.1);
    EXPECT_TRUE(std::isnan(measures.solid_volume)) << measures.solid_volume;
    EXPECT_TRUE(std::isnan(measures.uncovered()));
  }
}

TEST(KnownVolume, NotOfAFlatFrame) {
  const Example example(test::make_turned_torus(40, 20), 60);
  const Place in_a_plane[] = {[](const Point& p) {
                                return Point{p[0], 0, p[2]};
                              },
                              [](const Point& p) {
                                return Point{p[0], p[1], 0.3 * p[0] - 0.7 * p[1] + 5};
                              },
                              [](const Point& p) {
                                return Point{p[0], 1e-3 * p[0], 3 * p[0]};
                              }};
  for (const FollowRule rule : kBothRules) {
    for (const Place& place : in_a_plane) {
      const FollowMeasures measures = measured(example, rule, place);
      EXPECT_EQ(measures.ball_volume, 0);
      EXPECT_TRUE(std::isnan(measures.solid_volume)) << measures.solid_volume;
    }
  }
}

TEST(KnownVolume, NotOfAMeshThatIsNotClosed) {
  Mesh open = test::make_sphere(1, 500);
  open.triangles.pop_back();
  const IndexedMesh mesh = test::indexed(prepare_mesh(open).value());
  const Follower follower = Follower::create(mesh, std::vector<Ball>{{{0, 0, 0}, 0.5}}).value();
  EXPECT_TRUE(std::isnan(follower.measure().value().solid_volume));
}

}  // namespace
}  // namespace medial_vk
