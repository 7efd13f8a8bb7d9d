// Regions of a surface whose uncovered volume has grown: there balls are chosen anew, and nowhere else.
#include "following/regional_growth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <set>
#include <vector>

#include "ball_unions/unions/union_measurer.h"
#include "base/point_ops.h"
#include "following/gap_samples.h"
#include "following/renewal.h"
#include "following/surface/moving_surface.h"
#include "medial_vk/ball_union.h"
#include "medial_vk/prepare.h"
#include "support/solids/motions.h"
#include "threads/worker_pool.h"
#include "unit/following/followed_example.h"

namespace medial_vk {
namespace {

constexpr double kFactor = 1.5;

/// A ball of radius 1 with a limb along x, of the given length, and balls inside.
class Limbed {
 public:
  explicit Limbed(std::size_t balls = 300) : example(limbed(test::make_sphere(1, 5120), kRestLength), balls) {}

  Frame with_limb(double length) const {
    Frame frame = example.rest();
    for (Point& p : frame) {
      if (p[0] > 1) p[0] = 1 + (p[0] - 1) * length / kRestLength;
    }
    return frame;
  }

  static constexpr double kRestLength = 0.3;
  Example example;

 private:
  /// Radii around the direction x within 0.3 are greater, most in the middle.
  static Mesh limbed(Mesh sphere, double length) {
    for (Point& p : sphere.vertices) {
      const double angle = std::acos(std::clamp(p[0], -1.0, 1.0)) / 0.3;
      if (angle < 1) p[0] += (length + 0.1) * std::pow(std::cos(0.5 * std::numbers::pi * angle), 2);
    }
    return sphere;
  }
};

double uncovered_of(const Follower& follower) {
  const FollowMeasures measures = follower.measure().value();
  return measures.uncovered() / measures.solid_volume;
}

FollowerOptions renewing_in_regions() {
  FollowerOptions options;
  options.renewed = 10;
  options.renewal_factor = kFactor;
  return options;
}

TEST(RegionalGrowth, ALimbThatGrowsGetsBalls) {
  const Limbed solid;
  Follower plain = solid.example.follower(), follower = solid.example.follower(renewing_in_regions());
  const double rest = uncovered_of(plain);
  std::size_t renewed = 0;
  for (const double length : {0.4, 0.5, 0.6}) {
    const Frame frame = solid.with_limb(length);
    ASSERT_TRUE(plain.update(frame).ok() && follower.update(frame).ok());
    EXPECT_LT(uncovered_of(plain), kFactor * rest) << "the whole solid alone would not tell";
    for (std::size_t i = 0; i < solid.example.balls.size(); ++i) {
      if (follower.origins()[i] != FollowOrigin::kRenewed) continue;
      ++renewed;
      EXPECT_GT(follower.balls()[i].centre[0] + follower.balls()[i].radius, 0.9) << i;
    }
    expect_inside(follower, solid.example.mesh, frame, std::to_string(length));
  }
  EXPECT_GT(renewed, 0u);
  EXPECT_LT(uncovered_of(follower), uncovered_of(plain));
}

/// Turned, and larger or smaller by a factor.
Frame similar(const Frame& rest, double factor) {
  const double c = std::cos(0.3), s = std::sin(0.3);
  Frame frame = rest;
  for (Point& p : frame) p = {factor * (c * p[0] - s * p[1]) + 3, factor * (s * p[0] + c * p[1]), factor * p[2]};
  return frame;
}

TEST(RegionalGrowth, MotionsThatChangeNoShapeChooseNone) {
  for (const Example& example : {torus(), l_shape()}) {
    for (const std::uint32_t steps : {0u, 1u}) {
      FollowerOptions options = renewing_in_regions();
      options.renewal_factor = 1.1;
      options.steps = steps;
      Follower follower = example.follower(options);
      for (const double factor : {1.5, 0.1, 1.0}) {
        if (steps > 0 && factor != 1) continue;  // steps move balls that have grown
        ASSERT_TRUE(follower.update(similar(example.rest(), factor)).ok());
        EXPECT_EQ(std::ranges::count(follower.origins(), FollowOrigin::kFollowed), std::ssize(follower.origins()))
            << factor;
      }
    }
  }
}

/// In the last frame the limb is at rest again, and another place is not.
TEST(RegionalGrowth, BallsReturnOnceTheirRegionNeedsThemNoLonger) {
  const Limbed solid;
  Follower follower = solid.example.follower(renewing_in_regions());
  ASSERT_TRUE(follower.update(solid.with_limb(0.6)).ok());
  ASSERT_GT(std::ranges::count(follower.origins(), FollowOrigin::kRenewed), 0);
  for (int frame = 0; frame < 3; ++frame) {
    ASSERT_TRUE(follower.update(solid.with_limb(0.6)).ok());
    EXPECT_EQ(std::ranges::count(follower.origins(), FollowOrigin::kReturned), 0) << frame;
  }
  ASSERT_TRUE(follower.update(solid.example.rest()).ok());
  EXPECT_GT(std::ranges::count(follower.origins(), FollowOrigin::kReturned), 0);
  EXPECT_EQ(std::ranges::count(follower.origins(), FollowOrigin::kRenewed), 0);
}

struct Sampled {
  explicit Sampled(const Example& of)
      : example(of), surface(MovingSurface::build(of.mesh).value()), samples(surface, of.balls) {}

  double area(std::uint32_t triangle) const {
    const Corners3 corners = surface.corners(triangle);
    return 0.5 * length(cross(corners[1] - corners[0], corners[2] - corners[0]));
  }
  double volume_of_all() {
    samples.prepare(example.balls);
    double sum = 0;
    for (std::uint32_t region = 0; region < samples.regions(); ++region) {
      samples.tighten(surface, region);
      sum += samples.volume(region);
    }
    return sum;
  }

  const Example& example;
  MovingSurface surface;
  GapSamples samples;
};

TEST(GapSamples, RegionsShareTheAreaAndThePoints) {
  for (const Example& example : {torus(), Limbed().example, l_shape()}) {
    Sampled sampled(example);
    EXPECT_EQ(sampled.samples.points().size(), GapSamples::kPoints);
    std::vector<double> areas(sampled.samples.regions());
    double all = 0;
    for (std::uint32_t t = 0; t < sampled.surface.triangles().size(); ++t) {
      areas[sampled.samples.region_of(t)] += sampled.area(t);
      all += sampled.area(t);
    }
    std::vector<std::size_t> points(sampled.samples.regions());
    for (const SurfacePoint& point : sampled.samples.points()) ++points[sampled.samples.region_of(point.triangle)];
    for (std::size_t region = 0; region < areas.size(); ++region) {
      EXPECT_GT(points[region], 0u);
      // Triangles are halved, and each division moves less than one point to the other half.
      const auto divisions = static_cast<double>(std::bit_width(sampled.surface.triangles().size()));
      const double share = areas[region] / all * static_cast<double>(GapSamples::kPoints);
      EXPECT_NEAR(static_cast<double>(points[region]), share, divisions) << region;
    }
  }
}

/// Between a box and a smaller one of balls that touch nothing, the gap is known.
TEST(GapSamples, TheVolumeOfAThinShellIsItsAreaTimesItsWidth) {
  Example example(test::make_sphere(1, 5120), 0);
  example.balls = {{{0, 0, 0}, 0.97}};
  Sampled sampled(example);
  double area = 0, least = 1, greatest = 0;
  for (std::uint32_t t = 0; t < sampled.surface.triangles().size(); ++t) area += sampled.area(t);
  for (const Point& p : sampled.surface.vertices()) greatest = std::max(greatest, length(p) - 0.97);
  least = std::sqrt(sampled.surface.closest({0, 0, 0}, 2).squared_distance) - 0.97;
  const double volume = sampled.volume_of_all();
  EXPECT_GE(volume, area * least * (1 - 1e-12));
  EXPECT_LE(volume, area * greatest * (1 + 1e-12));
}

TEST(GapSamples, BoundsHoldInLaterFrames) {
  const Example example = torus();
  Sampled sampled(example);
  sampled.volume_of_all();
  WorkerPool pool(2);
  Follower follower = example.follower();
  std::size_t looser = 0;
  for (const double time : {0.5, 1.0}) {
    const Frame frame = test::moved_vertices(example.rest(), test::Motion::kTwist, time);
    ASSERT_TRUE(follower.update(frame).ok() && sampled.surface.move(frame, 1).ok());
    sampled.samples.bound(sampled.surface, follower.balls(), pool);
    std::vector<double> bounds;
    for (std::uint32_t region = 0; region < sampled.samples.regions(); ++region) {
      bounds.push_back(sampled.samples.volume(region));
    }
    sampled.samples.prepare(follower.balls());
    for (std::uint32_t region = 0; region < sampled.samples.regions(); region += 2) {
      sampled.samples.tighten(sampled.surface, region);
      EXPECT_LE(sampled.samples.volume(region), bounds[region]) << region;
      looser += sampled.samples.volume(region) < bounds[region] ? 1 : 0;
    }
  }
  EXPECT_GT(looser, 0u);
}

TEST(RegionalGrowth, OnlyTheRegionThatGrowsIsChosen) {
  const Limbed solid;
  MovingSurface surface = MovingSurface::build(solid.example.mesh).value();
  Follower follower = solid.example.follower();
  WorkerPool pool(1);
  const auto volume = [&] { return follower.measure().value().solid_volume; };
  RegionalGrowth growth(surface, follower.balls(), volume(), kFactor);
  EXPECT_FALSE(growth.choose(surface, follower.balls(), volume(), pool));
  const Frame frame = solid.with_limb(0.6);
  ASSERT_TRUE(follower.update(frame).ok() && surface.move(frame, 1).ok());
  EXPECT_TRUE(growth.has_grown(surface, follower.balls(), volume(), pool));
  ASSERT_TRUE(growth.choose(surface, follower.balls(), volume(), pool));
  for (std::uint32_t t = 0; t < surface.triangles().size(); ++t) {
    if (growth.chosen()[growth.samples().region_of(t)] == 0) continue;
    EXPECT_GT(surface.corners(t)[0][0], 0.5) << t;
  }
  // Where no exchange was worth it, none is tried again at once, but after a return to rest.
  growth.tried(surface, follower.balls(), volume());
  EXPECT_FALSE(growth.choose(surface, follower.balls(), volume(), pool));
  EXPECT_TRUE(growth.has_grown(surface, follower.balls(), volume(), pool));
  growth.return_to_rest();
  EXPECT_TRUE(growth.choose(surface, follower.balls(), volume(), pool));
  EXPECT_FALSE(growth.choose(surface, follower.balls(), std::numeric_limits<double>::quiet_NaN(), pool));
}

/// The greatest distance of the samples and of the middles of triangles from the balls.
double greatest_gap(const MovingSurface& surface, const GapSamples& samples, std::span<const Ball> balls) {
  std::vector<SurfacePoint> points(samples.points().begin(), samples.points().end());
  for (std::uint32_t t = 0; t < surface.triangles().size(); ++t) points.push_back({t, 1.0 / 3, 1.0 / 3});
  double greatest = 0;
  for (const SurfacePoint& point : points) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Ball& ball : balls) {
      if (ball.radius > 0) nearest = std::min(nearest, length(surface.at(point) - ball.centre) - ball.radius);
    }
    greatest = std::max(greatest, nearest);
  }
  return greatest;
}

TEST(Renewal, NoExchangeMakesTheGreatestGapLarger) {
  std::size_t renewed = 0;
  for (const test::Motion motion : test::kMotions) {
    const Example example = torus();
    Follower plain = example.follower({.steps = 0}), follower = example.follower(renewing_in_regions());
    MovingSurface surface = MovingSurface::build(example.mesh).value();
    const GapSamples samples(surface, example.balls);
    const Frame frame = test::moved_vertices(example.rest(), motion, 1);
    ASSERT_TRUE(surface.move(frame, 1).ok() && plain.update(frame).ok());
    UnionMeasurer measurer;
    WorkerPool pool(1);
    ASSERT_TRUE(measurer.measure(plain.balls(), true, pool).ok());
    const std::vector<std::uint8_t> all(samples.regions(), 1);
    Renewal renewal = std::move(Renewal::build(surface, example.balls, samples, 20)).value();
    // What an object has found before does not matter.
    ASSERT_TRUE(renewal.find(surface, example.balls, measurer.result(), {samples, all}, pool).ok());
    const auto exchanges = renewal.find(surface, plain.balls(), measurer.result(), {samples, all}, pool).value();
    Renewal other = std::move(Renewal::build(surface, plain.balls(), samples, 20)).value();
    const auto same = other.find(surface, plain.balls(), measurer.result(), {samples, all}, pool).value();
    ASSERT_EQ(exchanges.size(), same.size());
    for (std::size_t i = 0; i < same.size(); ++i) {
      EXPECT_EQ(exchanges[i].ball, same[i].ball);
      EXPECT_EQ(exchanges[i].by.ball.centre, same[i].by.ball.centre);
      EXPECT_EQ(exchanges[i].by.ball.radius, same[i].by.ball.radius);
      EXPECT_TRUE(std::ranges::equal(renewal.others_of(exchanges[i]), other.others_of(same[i])));
    }
    std::vector<Ball> balls = copy_of(plain.balls());
    const double before = greatest_gap(surface, samples, balls);
    for (const BallExchange& exchange : exchanges) {
      balls[exchange.ball] = exchange.by.ball;
      EXPECT_LE(greatest_gap(surface, samples, balls), before) << test::name_of(motion);
    }
    renewed += exchanges.size();
  }
  EXPECT_GT(renewed, 0u);
}

/// In a long box a small ball is at one end. It holds least, but without it the end would be the farthest place of all;
/// of two balls that overlap the left one would leave a wider gap than any.
TEST(Renewal, ABallThatAloneReachesAnEndStays) {
  Example box(test::make_box({10, 1, 1}), 0);
  box.balls = {{{0.06, 0.5, 0.5}, 0.05}, {{5, 0.5, 0.5}, 0.45}, {{5.15, 0.5, 0.5}, 0.45}, {{9.5, 0.5, 0.5}, 0.45}};
  MovingSurface surface = MovingSurface::build(box.mesh).value();
  const GapSamples samples(surface, box.balls);
  const std::vector<std::uint8_t> all(samples.regions(), 1);
  UnionMeasurer measurer;
  WorkerPool pool(1);
  ASSERT_TRUE(measurer.measure(box.balls, true, pool).ok());
  Renewal renewal = std::move(Renewal::build(surface, box.balls, samples, 2)).value();
  const auto exchanges = renewal.find(surface, box.balls, measurer.result(), {samples, all}, pool).value();
  ASSERT_FALSE(exchanges.empty());
  EXPECT_EQ(exchanges[0].ball, 2u);
  for (const BallExchange& exchange : exchanges) EXPECT_NE(exchange.ball, 0u);
}

}  // namespace
}  // namespace medial_vk
