// Balls by distance, and covers of a greatest reach.
#include "sphere_fits/spread/spread.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/point_ops.h"
#include "medial_vk/sphere_fits.h"
#include "medial_vk/sphere_proofs.h"
#include "sphere_fits/quality/sphere_certificate.h"
#include "sphere_fits/spread/reach_cover.h"
#include "support/solids/solids.h"
#include "unit/sphere_fits/shape.h"

namespace medial_vk {
namespace {

using testing::HasSubstr;

Result<SphereFit> fit_to(const Shape& shape, const SphereFitOptions& options) {
  return fit_spheres(test::indexed(shape.mesh), options, reference_extractor());
}

SphereFitOptions by_count(SphereAim aim, std::size_t count) {
  SphereFitOptions options;
  options.aim = aim;
  options.count = count;
  options.resolution = 24;  // of the volume
  return options;
}

SphereFitOptions by_reach(double reach, std::size_t count = 0) {
  SphereFitOptions options;
  options.contract = SphereContract::kCover;
  options.max_reach = reach;
  options.count = count;
  options.balls_only = true;  // their measures take longer than they do
  return options;
}

std::vector<Mesh> thin_solids() {
  return {test::make_box({1, 0.6, 0.02}), test::make_cup(0.5, 0.03, 0.6, 24), test::make_plate_with_hole(1, 0.03, 0.4),
          test::make_l_shape(1, 0.03, 0.5)};  // a bracket
}

/// Whether all balls hold their place in the solid, by the library's own proof.
bool are_inside(const Shape& shape, const std::vector<Ball>& balls) {
  return prove_inside(shape.solid, balls).proved();
}

TEST(BallsByDistance, IsNeverWiderWithMoreBalls) {
  for (const Mesh& mesh : thin_solids()) {
    const Shape shape(mesh);
    BallSpread spread(shape.solid, 1);
    const std::vector<double> gaps = spread.gaps(40);
    ASSERT_EQ(gaps.size(), 40u);
    for (std::size_t n = 1; n < gaps.size(); ++n) EXPECT_LE(gaps[n], gaps[n - 1]) << n;
    EXPECT_LT(gaps[39], 0.4 * gaps[3]);
  }
}

TEST(BallsByDistance, TheSetOfANumberDoesNotDependOnTheCallsBeforeOrOnThreads) {
  const Shape shape(test::make_plate_with_hole(1, 0.03, 0.4));
  BallSpread one(shape.solid, 1), three(shape.solid, 3);
  one.gaps(33);
  for (const std::size_t count : {20u, 7u, 33u, 8u}) {
    const std::vector<Ball> a = one.of(count), b = three.of(count);
    ASSERT_EQ(a.size(), count);
    ASSERT_EQ(b.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(a[i].centre, b[i].centre);
      EXPECT_EQ(a[i].radius, b[i].radius);
    }
  }
}

TEST(BallsByDistance, IsNearTheLeastGapOfAPlate) {
  const double thickness = 0.02;
  const Shape plate(test::make_box({1, 0.6, thickness}));
  BallSpread spread(plate.solid, 1);
  for (const std::size_t count : {16u, 64u}) {
    const std::vector<Ball> balls = spread.of(count);
    ASSERT_TRUE(are_inside(plate, balls));
    // Points of a face at most g from a ball of radius t/2 are in a disc of radius sqrt((g + t/2)^2 - t^2/4) around its
    // centre's projection, as the centre is at least t/2 below the face; n such discs must have the area of the face.
    const double disc = std::sqrt(0.6 / (std::numbers::pi * static_cast<double>(count)));
    const double least = std::hypot(disc, thickness / 2) - thickness / 2;
    const double gap = spread.gaps(count).back();
    EXPECT_GE(gap, 0.95 * least);  // the places are points of the face, 16384 of them
    EXPECT_LE(gap, 1.7 * least);
  }
}

TEST(BallsByDistance, BallsAreNearerThanThoseForTheVolume) {
  for (const Mesh& mesh : thin_solids()) {
    const Shape shape(mesh);
    const SphereFit volume = fit_to(shape, by_count(SphereAim::kVolume, 24)).value();
    const SphereFit distance = fit_to(shape, by_count(SphereAim::kDistance, 24)).value();
    EXPECT_TRUE(distance.measures.inside.proved());
    EXPECT_EQ(distance.levels.back().size(), 24u);
    EXPECT_LT(distance.measures.distances.boundary_to_balls.upper, volume.measures.distances.boundary_to_balls.lower);
  }
}

TEST(BallsByDistance, AutoChoosesByThickness) {
  const Shape plate(test::make_box({1, 0.6, 0.02}));
  const auto same_radii = [](const SphereFit& a, const SphereFit& b) {
    return a.levels.back().size() == b.levels.back().size() && a.measures.volume.balls == b.measures.volume.balls;
  };
  // A ball of radius 0.01 has 1 / 2865 of the volume.
  EXPECT_NEAR(static_cast<double>(sparse_count(plate.solid)), 1432, 2);
  const SphereFit chosen = fit_to(plate, by_count(SphereAim::kAuto, 24)).value();
  EXPECT_TRUE(same_radii(chosen, fit_to(plate, by_count(SphereAim::kDistance, 24)).value()));
  const Shape cube(test::make_box({1, 1, 1}));
  EXPECT_EQ(sparse_count(cube.solid), 0u);  // one ball has 0.52 of it
  const SphereFit of_cube = fit_to(cube, by_count(SphereAim::kAuto, 8)).value();
  EXPECT_TRUE(same_radii(of_cube, fit_to(cube, by_count(SphereAim::kVolume, 8)).value()));
}

TEST(BallsByDistance, AGapIsKeptByFewBallsAndProved) {
  const Shape plate(test::make_plate_with_hole(1, 0.03, 0.4));
  SphereFitOptions options;
  options.aim = SphereAim::kDistance;
  options.max_gap = 0.12;
  const SphereFit fit = fit_to(plate, options).value();
  EXPECT_TRUE(fit.measures.inside.proved());
  EXPECT_LE(fit.measures.distances.solid_to_balls.lower, 0.12);
  // Grown by the gap they cover everything.
  std::vector<Ball> grown = fit.levels.back();
  for (Ball& ball : grown) ball.radius += 0.12;
  EXPECT_TRUE(prove_cover(plate.solid, grown).value().proved());
  options.aim = SphereAim::kVolume;
  options.resolution = 24;
  EXPECT_LT(fit.levels.back().size(), fit_to(plate, options).value().levels.back().size());
}

TEST(BallsByDistance, LevelsAreSetsOfTheirOwn) {
  const Shape plate(test::make_box({1, 0.6, 0.02}));
  SphereFitOptions options = by_count(SphereAim::kDistance, 20);
  options.levels = true;
  const SphereFit fit = fit_to(plate, options).value();
  ASSERT_EQ(fit.levels.size(), 5u);
  options.levels = false;
  options.count = 10;
  const SphereFit half = fit_to(plate, options).value();
  ASSERT_EQ(fit.levels[3].size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(fit.levels[3][i].centre, half.levels.back()[i].centre);
}

TEST(ReachCover, CoversAndReachesOutNoFarther) {
  std::vector<Mesh> meshes = thin_solids();
  meshes.push_back(test::make_l_shape(2.0, 0.6, 0.8));
  meshes.push_back(test::make_sphere(1, 300));
  for (const Mesh& mesh : meshes) {
    const Shape shape(mesh);
    for (const double reach : {0.3, 0.15}) {
      const SphereFit fit = fit_to(shape, by_reach(reach)).value();
      EXPECT_TRUE(fit.measures.cover.proved());
      EXPECT_LE(fit.reach.back().greatest, reach);
      for (const Ball& ball : fit.levels.back()) {
        EXPECT_LE(ball.radius, shape.solid.distance(ball.centre) + reach);
      }
    }
  }
}

TEST(ReachCover, ASurfaceThatEnclosesNothingIsCoveredToo) {
  Mesh mesh = test::make_box({1, 1, 1});
  // A membrane far from it: no ball lies inside, so points of it are the centres.
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {{3, 0, 0}, {4, 0, 0}, {3, 1, 0}});
  mesh.triangles.push_back({first, first + 1, first + 2});
  const Shape shape(mesh);
  const SphereFit fit = fit_to(shape, by_reach(0.3)).value();
  EXPECT_TRUE(fit.measures.cover.surface_proved());
  EXPECT_LE(fit.reach.back().greatest, 0.3);
  std::size_t on_membrane = 0;
  for (const Ball& ball : fit.levels.back()) {
    if (ball.centre[0] > 2) ++on_membrane;
  }
  // Half a unit of area, by discs of radius 0.3 or less; and not many more.
  EXPECT_GE(on_membrane, 2u);
  EXPECT_LE(on_membrane, 12u);
}

/// The membrane has hundreds of the places at which gaps are measured, and is the first or the last of them.
TEST(BallsByDistance, ASurfaceThatEnclosesNothingHoldsUpNoBall) {
  for (const double x : {3.0, -4.0}) {
    Mesh mesh = test::make_box({1, 1, 1});
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}});
    mesh.triangles.push_back({first, first + 1, first + 2});
    const Shape shape(mesh);
    BallSpread spread(shape.solid, 2);
    EXPECT_EQ(spread.of(20).size(), 20u);
    const std::vector<double> gaps = spread.gaps(20);
    ASSERT_EQ(gaps.size(), 20u);
    // Of the box alone: the ball in its middle leaves its corners at (sqrt(3) - 1) / 2.
    EXPECT_LE(gaps.front(), 0.5);
    EXPECT_LT(gaps.back(), 0.5 * gaps.front());
  }
}

TEST(ReachCover, GivesUpSoonWhereTheNumberIsHopeless) {
  const Shape cube(test::make_box({1, 1, 1}));
  EXPECT_THAT(fit_to(cube, by_reach(0.004, 5)).error().message, HasSubstr("even 1024 balls leave a part"));
}

TEST(ReachCover, NeedsFewBalls) {
  const double thickness = 0.02, reach = 0.08;
  const Shape plate(test::make_box({1, 0.6, thickness}));
  const std::size_t count = fit_to(plate, by_reach(reach)).value().levels.back().size();
  // A ball that reaches out by d has a radius of at most t/2 + d around a centre t/2 below a face.
  const double disc = reach * (reach + thickness);
  const double least = 0.6 / (std::numbers::pi * disc);
  EXPECT_GE(static_cast<double>(count), least);
  EXPECT_LE(static_cast<double>(count), 2.2 * least);
}

TEST(ReachCover, SaysWhichNumberSuffices) {
  const Shape plate(test::make_box({1, 0.6, 0.02}));
  const std::size_t count = fit_to(plate, by_reach(0.08)).value().levels.back().size();
  EXPECT_EQ(fit_to(plate, by_reach(0.08, count)).value().levels.back().size(), count);
  const Result<SphereFit> fewer = fit_to(plate, by_reach(0.08, count - 1));
  ASSERT_FALSE(fewer.ok());
  EXPECT_EQ(fewer.error().code, ErrorCode::kUsage);
  EXPECT_THAT(fewer.error().message, HasSubstr("but " + std::to_string(count) + " are"));
  EXPECT_THAT(fewer.error().message, HasSubstr("raise `count` or `max_reach`"));
}

TEST(ReachCover, GoalsThatExcludeEachOther) {
  const Shape cube(test::make_box({1, 1, 1}));
  SphereFitOptions inside = by_reach(0.1);
  inside.contract = SphereContract::kInside;
  EXPECT_THAT(fit_to(cube, inside).error().message, HasSubstr("`max_reach` is of the method best"));
  SphereFitOptions with_error = by_reach(0.1);
  with_error.error = 0.1;
  EXPECT_FALSE(fit_to(cube, with_error).ok());
  EXPECT_THAT(fit_to(cube, by_reach(1e-16)).error().message, HasSubstr("below the rounding"));
  EXPECT_FALSE(fit_to(cube, by_reach(std::nan(""))).ok());
  SphereFitOptions cover = by_count(SphereAim::kDistance, 8);
  cover.contract = SphereContract::kCover;
  EXPECT_THAT(fit_to(cube, cover).error().message, HasSubstr("other values of `aim`"));
  cover.aim = SphereAim::kAuto;
  EXPECT_THAT(fit_to(cube, cover).error().message, HasSubstr("other values of `aim`"));
}

TEST(ReachCover, StopsOnRequest) {
  const Shape cup(test::make_cup(0.5, 0.03, 0.6, 24));
  std::stop_source stop;
  stop.request_stop();
  const Result<SphereFit> fit =
      fit_spheres(test::indexed(cup.mesh), by_reach(0.02), reference_extractor(), {}, stop.get_token());
  ASSERT_FALSE(fit.ok());
  EXPECT_EQ(fit.error().code, ErrorCode::kInterrupted);
}

}  // namespace
}  // namespace medial_vk
