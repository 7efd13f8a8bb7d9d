// Proofs of given balls.
#include <gtest/gtest.h>

#include <cmath>
#include <stop_token>
#include <vector>

#include "medial_vk/prepare.h"
#include "medial_vk/sphere_proofs.h"
#include "support/indexed.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

TEST(ProveSpheres, AcceptsTrueBallsAndRefusesOthers) {
  const IndexedMesh mesh = test::indexed(prepare_mesh(test::make_box({1, 1, 1})).value());
  const std::vector<Ball> inside = {{{0.5, 0.5, 0.5}, 0.499}}, cover = {{{0.5, 0.5, 0.5}, 0.87}};
  const SphereProofs proofs = prove_spheres(mesh, inside, cover).value();
  EXPECT_TRUE(proofs.inside.proved());
  EXPECT_TRUE(proofs.cover.proved());
  const std::vector<Ball> large = {inside[0], {{0.5, 0.5, 0.5}, 0.5001}}, small = {{{0.5, 0.5, 0.5}, 0.86}};
  const SphereProofs refused = prove_spheres(mesh, large, small).value();
  EXPECT_EQ(refused.inside.failed, 1u);
  EXPECT_EQ(refused.inside.first_failure, 1u);
  EXPECT_FALSE(refused.cover.proved());
  EXPECT_FALSE(prove_spheres(mesh, {{{{2, 0.5, 0.5}, 0.1}}}, cover).value().inside.proved());
}

TEST(ProveSpheres, NoBallCoversNothing) {
  const IndexedMesh mesh = test::indexed(prepare_mesh(test::make_box({1, 1, 1})).value());
  const SphereProofs proofs = prove_spheres(mesh, {}, {}).value();
  EXPECT_TRUE(proofs.inside.proved());
  EXPECT_FALSE(proofs.cover.proved());
  EXPECT_EQ(proofs.cover.uncovered, 12u);
  std::stop_source stopped;
  stopped.request_stop();
  const std::vector<Ball> cover = {{{0.5, 0.5, 0.5}, 0.87}};
  EXPECT_EQ(prove_spheres(mesh, {}, cover, {}, stopped.get_token()).error().code, ErrorCode::kInterrupted);
  EXPECT_EQ(prove_spheres(mesh, {}, {{{{0, 0, 0}, -1}}}).error().code, ErrorCode::kUsage);
}

TEST(MeasureGap, IsTheDistanceFromTheFarthestCorner) {
  const IndexedMesh mesh = test::indexed(prepare_mesh(test::make_box({1, 1, 1})).value());
  const std::vector<Ball> balls = {{{0.5, 0.5, 0.5}, 0.25}, {{2, 0.5, 0.5}, 0}};
  const Bounds gap = measure_gap(mesh, balls).value();
  const double corner = 0.5 * std::sqrt(3.0) - 0.25;
  EXPECT_LE(gap.lower, corner);
  EXPECT_GE(gap.upper, corner) << "the ball without a radius is no ball";
  EXPECT_LE(gap.upper - gap.lower, 1e-3 * std::sqrt(3.0));
  const Bounds none = measure_gap(mesh, {{{{0.5, 0.5, 0.5}, 1}}}).value();
  EXPECT_EQ(none.lower, 0) << "the ball holds the solid";
  EXPECT_LE(none.upper, 1e-12) << "rounding is bounded by some units in the last place";
}

TEST(MeasureGap, Refuses) {
  const IndexedMesh mesh = test::indexed(prepare_mesh(test::make_box({1, 1, 1})).value());
  EXPECT_EQ(measure_gap(mesh, {}).error().code, ErrorCode::kUsage);
  EXPECT_EQ(measure_gap(mesh, {{{{0.5, 0.5, 0.5}, 0}}}).error().code, ErrorCode::kUsage);
  EXPECT_EQ(measure_gap(mesh, {{{{0.5, 0.5, 1e300}, 1}}}).error().code, ErrorCode::kUsage);
  std::stop_source stopped;
  stopped.request_stop();
  EXPECT_EQ(measure_gap(mesh, {{{{0.5, 0.5, 0.5}, 0.1}}}, {}, stopped.get_token()).error().code,
            ErrorCode::kInterrupted);
}

TEST(MeasureDepths, AreProvedAndNearTheDistance) {
  const IndexedMesh mesh = test::indexed(prepare_mesh(test::make_box({1, 1, 1})).value());
  const std::vector<Point> points = {{0.5, 0.5, 0.5}, {0.25, 0.5, 0.375}, {1.5, 0.5, 0.5}, {0, 0.5, 0.5}};
  std::vector<double> depths(points.size(), 7);
  ASSERT_TRUE(measure_depths(mesh, points, depths));
  const double exact[] = {0.5, 0.25, -0.5, 0};
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LE(depths[i], exact[i]);
    EXPECT_NEAR(depths[i], exact[i], 1e-12) << "rounding is bounded by some units in the last place";
  }
  EXPECT_TRUE(prove_spheres(mesh, {{{points[0], depths[0]}, {points[1], depths[1]}}}, {}).value().inside.proved());
}

TEST(MeasureDepths, Refuses) {
  const IndexedMesh mesh = test::indexed(prepare_mesh(test::make_box({1, 1, 1})).value());
  const std::vector<Point> far = {{0, 0, 1e300}}, point = {{0.5, 0.5, 0.5}};
  std::vector<double> none, one(1);
  EXPECT_EQ(measure_depths(mesh, point, none).error().code, ErrorCode::kUsage);
  EXPECT_EQ(measure_depths(mesh, far, one).error().code, ErrorCode::kUsage);
  std::stop_source stopped;
  stopped.request_stop();
  EXPECT_EQ(measure_depths(mesh, point, one, {}, stopped.get_token()).error().code, ErrorCode::kInterrupted);
}

}  // namespace
}  // namespace medial_vk
