// Balls that stay close to the boundary, and balanced sets with a bound of the distance of the surfaces.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stop_token>
#include <vector>

#include "base/point_ops.h"
#include "medial_vk/prepare.h"
#include "medial_vk/sphere_fits.h"
#include "reference_bridge/reference_extractor.h"
#include "sphere_fits/quality/envelope_distance.h"
#include "sphere_fits/quality/surface_samples.h"
#include "sphere_fits/steps/near_boundary.h"
#include "support/indexed.h"
#include "support/solids/solids.h"
#include "unit/sphere_fits/shape.h"

namespace medial_vk {
namespace {

using testing::HasSubstr;

/// Two plates of 2 x 2 x 0.5, with a gap of this width between them in z.
Mesh two_plates(double gap) {
  Mesh mesh = test::make_box({2, 2, 0.5});
  Mesh other = test::make_box({2, 2, 0.5});
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (Point& p : other.vertices) mesh.vertices.push_back(p + Point{0, 0, 0.5 + gap});
  for (const Triangle& t : other.triangles) mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  return mesh;
}

/// Balls in each plate on a grid, each of which reaches out by `out`.
std::vector<Ball> balls_in_plates(double gap, double out) {
  std::vector<Ball> balls;
  for (const double z : {0.25, 0.75 + gap}) {
    for (int i = 0; i < 8; ++i) {
      for (int j = 0; j < 8; ++j) balls.push_back({{0.25 + 0.2143 * i, 0.25 + 0.2143 * j, z}, 0.25 + out});
    }
  }
  return balls;
}

/// The greatest depth in the union of a sample of the boundary: no point nearer than that is in no ball, as far as
/// `points` points around it show. Independent of the envelope.
double depth_of_samples(const Shape& shape, const std::vector<Ball>& balls, double step) {
  constexpr std::size_t kPoints = 400;
  const auto is_out = [&](const Point& p) {
    return std::none_of(balls.begin(), balls.end(),
                        [&](const Ball& b) { return length(p - b.centre) < b.radius * (1 - 1e-9); });
  };
  double deepest = 0;
  for (const Point& p : sample_surface(shape.solid.mesh().mesh, 300)) {
    double depth = 0;
    bool is_found = is_out(p);
    while (!is_found) {
      depth += step;
      for (std::size_t k = 0; k < kPoints && !is_found; ++k) is_found = is_out(p + depth * spiral_point(k, kPoints));
    }
    deepest = std::max(deepest, depth);
  }
  return deepest;
}

TEST(KeptNearBoundary, UncoversAGapBetweenParts) {
  constexpr double kGap = 0.02, kMost = 0.1;
  const Shape plates(two_plates(kGap));
  std::vector<Ball> balls = balls_in_plates(kGap, 0.06);
  const std::size_t at_gap = balls.size();
  balls.push_back({{1, 1, 0.1}, 0.09});  // far from the gap
  EXPECT_GT(depth_of_samples(plates, balls, 0.02), 2 * kMost);
  const std::vector<Ball> kept = NearBoundary(plates.solid, kMost).keep(balls, {});
  ASSERT_TRUE(std::all_of(kept.begin(), kept.end(), [](const Ball& ball) { return ball.radius > 0; }));
  const Envelope envelope = Envelope::build(kept).value();
  for (const Point& p : sample_surface(plates.solid.mesh().mesh, 3000)) {
    if (envelope.tree().holds(p)) {
      EXPECT_LE(envelope.distance(p), kMost + envelope.distance_error());
    }
  }
  EXPECT_EQ(kept[at_gap].radius, balls[at_gap].radius);
}

TEST(KeptNearBoundary, BoundsWhatBallsReachOut) {
  constexpr double kMost = 0.05;
  const Shape box(test::make_box({2, 2, 2}));
  const std::vector<Ball> balls = {{{1, 1, 1}, 0.9}, {{1, 1, 1.5}, 0.7}, {{0.3, 0.3, 2.02}, 0.2}, {{1, 1, 2.2}, 0.3}};
  const std::vector<Ball> kept = NearBoundary(box.solid, kMost).keep(balls, {});
  ASSERT_EQ(kept.size(), balls.size());
  EXPECT_EQ(kept[0].radius, 0.9);
  EXPECT_NEAR(kept[1].radius, 0.5 + kReachShare * kMost, 2 * box.solid.rounding());
  EXPECT_NEAR(kept[2].radius, kReachShare * kMost - 0.02, 2 * box.solid.rounding());
  EXPECT_EQ(kept[3].radius, 0);  // its centre is farther out
  for (std::size_t k = 0; k < kept.size(); ++k) EXPECT_EQ(kept[k].centre, balls[k].centre);
}

TEST(KeptNearBoundary, LeavesBallsInsideAsTheyAre) {
  const Shape shape(test::make_l_shape(2.0, 0.6, 0.8));
  SphereFitOptions request;
  request.count = 40;
  request.resolution = 16;
  const std::vector<Ball> balls = shape.fit(request).value().balls;
  const std::vector<Ball> kept = NearBoundary(shape.solid, 0.01).keep(balls, {});
  ASSERT_EQ(kept.size(), balls.size());
  for (std::size_t k = 0; k < kept.size(); ++k) EXPECT_EQ(kept[k].radius, balls[k].radius);
}

TEST(KeptNearBoundary, DoesNotDependOnThreads) {
  const Shape plates(two_plates(0.02));
  const std::vector<Ball> balls = balls_in_plates(0.02, 0.06);
  const std::vector<Ball> one = NearBoundary(plates.solid, 0.1).keep(balls, {1});
  const std::vector<Ball> three = NearBoundary(plates.solid, 0.1).keep(balls, {3});
  ASSERT_EQ(one.size(), three.size());
  for (std::size_t k = 0; k < one.size(); ++k) EXPECT_EQ(one[k].radius, three[k].radius);
}

class BoundedDistance : public testing::Test {
 protected:
  BoundedDistance() {
    options_.contract = SphereContract::kBalanced;
    options_.resolution = 16;
  }

  Result<SphereFit> fit() const { return fit_spheres(mesh_, options_, reference_extractor()); }
  static double distance_of(const SphereFit& fit) { return fit.measures.distances.between_surfaces().upper; }

  IndexedMesh mesh_ = test::indexed(prepare_mesh(two_plates(0.02)).value());
  SphereFitOptions options_;
};

TEST_F(BoundedDistance, IsKeptByANumberOfBalls) {
  options_.count = 100;
  EXPECT_GT(distance_of(fit().value()), 0.2);  // the gap is filled
  options_.max_distance = 0.2;
  const SphereFit bounded = fit().value();
  EXPECT_LE(distance_of(bounded), 0.2);
  EXPECT_EQ(bounded.levels.back().size(), 100u);
}

TEST_F(BoundedDistance, IsAGoalWithoutANumber) {
  options_.max_distance = 0.25;
  const SphereFit found = fit().value();
  EXPECT_LE(distance_of(found), 0.25);
  options_.count = found.levels.back().size() / 2;
  const Error error = fit().error();
  EXPECT_EQ(error.code, ErrorCode::kUsage);
  EXPECT_THAT(error.message, HasSubstr("raise `count` or `max_distance`"));
}

TEST_F(BoundedDistance, HasTheSameBallsWithLevels) {
  options_.max_distance = 0.25;
  const SphereFit found = fit().value();
  options_.levels = true;
  const SphereFit levels = fit().value();
  ASSERT_GT(levels.levels.size(), 2u);
  EXPECT_LE(distance_of(levels), 0.25);
  const std::vector<Ball>&alone = found.levels.back(), &last = levels.levels.back();
  ASSERT_EQ(alone.size(), last.size());
  for (std::size_t k = 0; k < last.size(); ++k) EXPECT_EQ(alone[k].radius, last[k].radius);
}

TEST_F(BoundedDistance, IsProvedWithoutOtherMeasures) {
  options_.count = 100;
  options_.max_distance = 0.2;
  options_.balls_only = true;
  const std::vector<Ball> balls = fit().value().levels.back();
  const Solid solid = Solid::build(mesh_).value();
  EXPECT_LE(measure_surface_distance(solid, balls).value().upper, 0.2 + 1e-3 * solid.diagonal());
  options_.max_distance = 0.01;
  EXPECT_THAT(fit().error().message, HasSubstr("balls keep the surfaces within"));
}

TEST_F(BoundedDistance, EndsSoonAtAStop) {
  options_.count = 40;
  options_.max_distance = 0.004;  // takes minutes
  std::stop_source stop;
  const auto progress = [&](const char*, double done) {
    if (done > 0.2) stop.request_stop();
  };
  EXPECT_EQ(fit_spheres(mesh_, options_, reference_extractor(), progress, stop.get_token()).error().code,
            ErrorCode::kInterrupted);
}

TEST_F(BoundedDistance, IsKeptBesideAnError) {
  options_.max_distance = 0.25;
  options_.error = 0.2;
  const SphereFit found = fit().value();
  EXPECT_LE(distance_of(found), 0.25);
  EXPECT_LE(found.measures.volume.normalized(), 0.2);
}

TEST_F(BoundedDistance, IsRefusedWhereItHasNoMeaning) {
  options_.count = 10;
  for (const double wrong : {-1.0, std::numeric_limits<double>::infinity(), std::nan(""), 1e-4}) {
    options_.max_distance = wrong;
    EXPECT_EQ(fit().error().code, ErrorCode::kUsage) << wrong;
  }
  options_.max_distance = 0.1;
  options_.method = SphereMethod::kSource;
  EXPECT_THAT(fit().error().message, HasSubstr("`max_distance` is about balanced balls"));
  options_.method = SphereMethod::kBest;
  options_.contract = SphereContract::kCover;
  EXPECT_THAT(fit().error().message, HasSubstr("`max_distance` is about balanced balls"));
}

}  // namespace
}  // namespace medial_vk
