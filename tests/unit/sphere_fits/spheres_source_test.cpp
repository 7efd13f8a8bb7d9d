// The source's own sets, and the quality of beginnings of a set.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/point_ops.h"
#include "medial_vk/ball_union.h"
#include "medial_vk/prepare.h"
#include "reference_bridge/reference_extractor.h"
#include "sphere_fits/methods/approximate.h"
#include "sphere_fits/methods/prefixes.h"
#include "sphere_fits/methods/sphere_set.h"
#include "support/indexed.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class SourceMethod : public testing::Test {
 protected:
  SourceMethod() : mesh_(prepare_mesh(make()).value()), solid_(Solid::build(test::indexed(mesh_)).value()) {
    request_.method = SphereMethod::kSource;
  }

  static Mesh make() {
    Mesh mesh = test::make_l_shape(2.0, 0.6, 0.8);
    test::rotate(mesh, {1, 2, 3}, 0.4);
    return mesh;
  }

  Result<SphereSet> fit() const { return approximate_by_spheres(solid_, request_, reference_extractor()); }

  double error_of(const std::vector<Ball>& balls) const {
    return 1 - measure_ball_union(balls).value().volume / solid_.volume();
  }

  PreparedMesh mesh_;
  Solid solid_;
  SphereFitOptions request_;
};

TEST_F(SourceMethod, KeepsTheCountAndStaysInside) {
  double last = 1;
  for (const std::size_t count : {16u, 64u, 200u}) {
    request_.count = count;
    const Result<SphereSet> set = fit();
    ASSERT_TRUE(set.ok()) << set.error().message;
    const std::vector<Ball>& balls = set.value().balls;
    EXPECT_LE(balls.size(), count);
    EXPECT_GT(balls.size(), count / 4);
    for (const Ball& ball : balls) {
      EXPECT_TRUE(solid_.contains(ball.centre));
      EXPECT_LE(ball.radius, solid_.distance(ball.centre));
    }
    EXPECT_LT(error_of(balls), last);
    last = error_of(balls);
  }
}

TEST_F(SourceMethod, ReachesAnErrorWithTheCoarsestGrid) {
  request_.error = 0.2;
  const Result<SphereSet> set = fit();
  ASSERT_TRUE(set.ok()) << set.error().message;
  EXPECT_LE(error_of(set.value().balls), 0.2);
  EXPECT_GT(error_of(set.value().balls), 0.1);
  request_.count = 10;
  EXPECT_THAT(fit().error().message, HasSubstr("more than the `error` of 0.2; raise `count`"));
}

TEST_F(SourceMethod, TakesAResolutionForACount) {
  request_.resolution = 8;
  const Result<SphereSet> eight = fit();
  request_.resolution = 12;
  const Result<SphereSet> twelve = fit();
  ASSERT_TRUE(eight.ok() && twelve.ok());
  EXPECT_GT(twelve.value().balls.size(), eight.value().balls.size());
}

TEST_F(SourceMethod, SaysWhatCannotBe) {
  EXPECT_EQ(fit().error().code, ErrorCode::kUsage);
  request_.count = 1;
  request_.resolution = 7;
  EXPECT_THAT(fit().error().message, HasSubstr("`method` source finds its own resolution"));
  request_.resolution = 0;
  request_.max_gap = 0.1;
  EXPECT_THAT(fit().error().message, HasSubstr("`method` source does not support `max_gap`"));
  request_.max_gap = std::nan("");
  EXPECT_EQ(fit().error().code, ErrorCode::kUsage);
}

TEST_F(SourceMethod, StopsOnRequest) {
  request_.count = 100;
  const Result<SphereSet> set =
      approximate_by_spheres(solid_, request_, reference_extractor(), [](const char*, double) { return false; });
  ASSERT_FALSE(set.ok());
  EXPECT_EQ(set.error().code, ErrorCode::kInterrupted);
}

TEST_F(SourceMethod, LevelsAreBeginnings) {
  request_.count = 60;
  const Result<std::vector<SphereSet>> levels = approximate_in_levels(solid_, request_, reference_extractor());
  ASSERT_TRUE(levels.ok()) << levels.error().message;
  const std::vector<Ball>& all = levels.value().back().balls;
  EXPECT_EQ(levels.value().size(), level_counts(all.size()).size());
  double last = 1;
  for (const SphereSet& level : levels.value()) {
    for (std::size_t i = 0; i < level.balls.size(); ++i) {
      EXPECT_EQ(level.balls[i].centre, all[i].centre);
      EXPECT_EQ(level.balls[i].radius, all[i].radius);
    }
    EXPECT_LT(error_of(level.balls), last);
    last = error_of(level.balls);
  }
}

TEST(SpherePrefixes, TheBallsThatMatterComeFirst) {
  std::vector<Ball> balls = {{{0, 0, 0}, 0.1}, {{5, 0, 0}, 1}, {{0, 0, 0}, 0.5}, {{5.1, 0, 0}, 0.9}, {{9, 0, 0}, 0.7}};
  ASSERT_TRUE(order_by_share(balls).ok());
  EXPECT_EQ(balls[0].radius, 1);
  EXPECT_EQ(balls[1].radius, 0.7);
  EXPECT_EQ(balls[2].radius, 0.5);
  const Result<std::vector<double>> volumes = prefix_volumes(balls);
  ASSERT_TRUE(volumes.ok());
  const double unit = 4.0 / 3 * std::numbers::pi;
  EXPECT_NEAR(volumes.value()[0], unit, 1e-12);
  EXPECT_NEAR(volumes.value()[1], unit * (1 + 0.343), 1e-12);
  EXPECT_NEAR(volumes.value()[4], unit * (1 + 0.343 + 0.125), 0.01);
  EXPECT_THAT(level_counts(10), ElementsAre(1, 2, 5, 10));
  EXPECT_TRUE(level_counts(0).empty());
}

}  // namespace
}  // namespace medial_vk
