// Estimates of distances within their intervals.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "base/point_ops.h"
#include "medial_vk/prepare.h"
#include "medial_vk/proximity.h"
#include "support/indexed.h"
#include "support/random_poses.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using namespace test;

/// Balls on a grid in or around the box [0, 4] x [0, 3] x [0, 1], all of one radius.
std::vector<Ball> grid(double radius) {
  std::vector<Ball> balls;
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 6; ++j) balls.push_back({{0.25 + 0.5 * i, 0.25 + 0.5 * j, 0.5}, radius});
  }
  return balls;
}

/// The balls inside lie 0.25 below the large faces; those of the cover hold the corners of their parts of the box.
class EstimatedDistance : public testing::Test {
 protected:
  std::vector<Ball> inside_ = grid(0.25), cover_ = grid(std::sqrt(0.25 * 0.25 * 2 + 0.5 * 0.5) + 1e-9);
  IndexedMesh mesh_ = indexed(prepare_mesh(make_box({4, 3, 1})).value());
  Body with_mesh_ = Body::create(mesh_, inside_, cover_).value();
  Body of_balls_ = Body::create(inside_, cover_).value();
};

TEST_F(EstimatedDistance, LiesInTheIntervalAndIsNearerThanTheMiddle) {
  Random random(1);
  double error = 0, of_middle = 0;
  int apart = 0;
  for (int i = 0; i < 400; ++i) {
    const Pose pose = any_pose(random, point_in_cube(random, 6));
    const DistanceBounds bounds = distance_bounds(with_mesh_, with_mesh_, pose);
    const double estimate = estimated_distance(with_mesh_, with_mesh_, bounds);
    EXPECT_LE(bounds.lower, estimate);
    EXPECT_LE(estimate, bounds.upper);
    const Distance exact = distance(with_mesh_, with_mesh_, pose).value();
    if (bounds.lower == 0) continue;
    ++apart;
    error += std::fabs(estimate - exact.upper);
    of_middle += std::fabs((bounds.lower + bounds.upper) / 2 - exact.upper);
  }
  EXPECT_GT(apart, 100);
  EXPECT_LT(error, 0.8 * of_middle);
}

// With the balls inside at the boundary the distance is at the upper end, and with a cover that is tight, at the lower.
TEST_F(EstimatedDistance, IsNearTheBoundWhoseBallsErrLess) {
  const Body tight_cover = Body::create(mesh_, grid(0.05), cover_).value();
  const Body near_inside = Body::create(mesh_, inside_, grid(2)).value();
  const auto share = [](const Body& body) {
    Pose pose;
    pose.shift = {0.3, 0.2, 6};
    const DistanceBounds bounds = distance_bounds(body, body, pose);
    return (estimated_distance(body, body, bounds) - bounds.lower) / (bounds.upper - bounds.lower);
  };
  EXPECT_LT(share(tight_cover), 0.4);
  EXPECT_GT(share(near_inside), 0.6);
}

TEST_F(EstimatedDistance, IsTheMiddleWithoutAMesh) {
  Pose pose;
  pose.shift = {0, 0, 5};
  const DistanceBounds bounds = distance_bounds(of_balls_, of_balls_, pose);
  EXPECT_DOUBLE_EQ(estimated_distance(of_balls_, of_balls_, bounds), (bounds.lower + bounds.upper) / 2);
  // What one body knows decides.
  const DistanceBounds mixed = distance_bounds(with_mesh_, of_balls_, pose);
  const double estimate = estimated_distance(with_mesh_, of_balls_, mixed);
  EXPECT_LT(mixed.lower, estimate);
  EXPECT_LT(estimate, mixed.upper);
  EXPECT_NE(estimate, (mixed.lower + mixed.upper) / 2);
}

TEST_F(EstimatedDistance, NeedsAnUpperBound) {
  const Body cover_only = Body::create(mesh_, {}, cover_).value();
  Pose pose;
  pose.shift = {0, 0, 5};
  const DistanceBounds bounds = distance_bounds(cover_only, with_mesh_, pose);
  EXPECT_EQ(bounds.upper, std::numeric_limits<double>::infinity());
  EXPECT_EQ(estimated_distance(cover_only, with_mesh_, bounds), bounds.lower);
  EXPECT_EQ(estimated_distance(with_mesh_, with_mesh_, distance_bounds(with_mesh_, with_mesh_, Pose())), 0);
}

}  // namespace
}  // namespace medial_vk
