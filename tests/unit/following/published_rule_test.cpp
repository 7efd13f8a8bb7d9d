// Section 7.4.1 as published: Lemma 7.2, Algorithm 5 and Lemma 7.3.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "following/published_rule.h"
#include "following/surface/moving_surface.h"
#include "medial_vk/follower.h"
#include "medial_vk/prepare.h"
#include "solid/solid.h"
#include "support/indexed.h"
#include "support/solids/motions.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

double distance_to(const MovingSurface& surface, const Point& p) {
  return std::sqrt(surface.closest(p, std::numeric_limits<double>::infinity()).squared_distance);
}

IndexedMesh indexed_l_shape() { return test::indexed(prepare_mesh(test::make_l_shape(2, 0.6, 0.8)).value()); }

/// Contacts in all triangles, with directions up to 60 degrees from the normals, and radii up to twice the width.
template <class Check>
void for_contacts(const MovingSurface& surface, const Check& check) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0, 1), sign(-1, 1);
  for (std::uint32_t t = 0; t < surface.triangles().size(); ++t) {
    for (int i = 0; i < 10; ++i) {
      const double v = unit(random), w = (1 - v) * unit(random);
      Point towards = surface.inward_normal(t) + Point{sign(random), sign(random), sign(random)};
      if (!(length(towards) > 0.1) || dot(towards, surface.inward_normal(t)) <= 0) continue;
      towards = (1 / length(towards)) * towards;
      check(surface.at({t, v, w}), towards, 0.05 + 1.2 * unit(random));
    }
  }
}

TEST(PublishedRule, LemmaSevenTwoAShrunkBallStillReachesOutOrIsMaximal) {
  const MovingSurface surface = MovingSurface::build(indexed_l_shape()).value();
  int reached_out = 0;
  for_contacts(surface, [&](const Point& at, const Point& towards, double radius) {
    const double nearest = distance_to(surface, at + radius * towards);
    if (nearest >= radius - 1e-9) return;
    const double next = (radius + nearest) / 2;
    EXPECT_LE(distance_to(surface, at + next * towards), next + 1e-12);
    ++reached_out;
  });
  EXPECT_GT(reached_out, 50);
}

TEST(PublishedRule, AlgorithmFiveLeavesAtMostTheProtrusion) {
  const MovingSurface surface = MovingSurface::build(indexed_l_shape()).value();
  for (const double protrusion : {0.1, 0.005, 1e-6}) {
    for_contacts(surface, [&](const Point& at, const Point& towards, double radius) {
      const double shrunk = shrink(surface, at, towards, radius, protrusion);
      EXPECT_LE(shrunk, radius + 1e-12);
      EXPECT_GT(distance_to(surface, at + shrunk * towards), shrunk - protrusion - 1e-12);
    });
  }
}

TEST(PublishedRule, EndsWhereNoNumberIsBetween) {
  const MovingSurface surface = MovingSurface::build(indexed_l_shape()).value();
  for_contacts(surface, [&](const Point& at, const Point& towards, double radius) {
    const double shrunk = shrink(surface, at, towards, radius, 1e-300);
    EXPECT_GT(distance_to(surface, at + shrunk * towards), shrunk - 1e-12);
  });
}

TEST(PublishedRule, FramesDoNotDependOnEachOther) {
  const IndexedMesh mesh = indexed_l_shape();
  FollowerOptions options;
  options.rule = FollowRule::kPublished;
  const std::vector<Ball> balls = {{{0.3, 0.3, 0.4}, 0.29}, {{1.2, 0.3, 0.4}, 0.29}};
  Follower seen = Follower::create(mesh, balls, options).value(),
           fresh = Follower::create(mesh, balls, options).value();
  ASSERT_TRUE(seen.update(test::moved_vertices(mesh.view().vertices, test::Motion::kSquash, 1)).ok());
  const std::vector<Point> frame = test::moved_vertices(mesh.view().vertices, test::Motion::kTwist, 1);
  ASSERT_TRUE(seen.update(frame).ok());
  ASSERT_TRUE(fresh.update(frame).ok());
  for (std::size_t i = 0; i < balls.size(); ++i) {
    EXPECT_EQ(seen.balls()[i].centre, fresh.balls()[i].centre);
    EXPECT_EQ(seen.balls()[i].radius, fresh.balls()[i].radius);
  }
}

TEST(PublishedRule, LemmaSevenThreeBoundsTheVolumeOutside) {
  const IndexedMesh mesh = test::indexed(prepare_mesh(test::make_turned_torus(40, 20)).value());
  const Solid rest = Solid::build(mesh).value();
  const MovingSurface surface = MovingSurface::build(mesh).value();
  std::vector<Ball> balls;
  for (std::size_t t = 0; t < mesh.view().triangles.size(); t += 7) {
    const Point p = surface.at({static_cast<std::uint32_t>(t), 1.0 / 3, 1.0 / 3}) +
                    0.35 * surface.inward_normal(static_cast<std::uint32_t>(t));
    if (rest.contains(p)) balls.push_back({p, rest.distance(p) * (1 - 1e-12)});
  }
  FollowerOptions options;
  options.rule = FollowRule::kPublished;
  options.protrusion = 0.01;
  Follower follower = Follower::create(mesh, balls, options).value();
  const std::vector<Point> frame = test::moved_vertices(mesh.view().vertices, test::Motion::kTwist, 1);
  ASSERT_TRUE(follower.update(frame).ok());
  IndexedMesh moved = mesh;
  ASSERT_TRUE(moved.move_vertices(frame).ok());
  const Solid solid = Solid::build(moved).value();
  for (const Ball& ball : follower.balls()) {
    if (!(ball.radius > 0)) continue;  // lost
    EXPECT_TRUE(solid.contains(ball.centre));
    EXPECT_GT(solid.distance(ball.centre), ball.radius - 0.01 * mesh.longest_side());
  }
  // Samples of the box: the error is the share of those in the solid or in a ball, but not in both.
  const FollowMeasures measures = follower.measure().value();
  EXPECT_GT(measures.outside_bound, 0);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  const MeshReport& box = moved.prepared().report;
  const Point sides = box.upper - box.lower;
  const double volume = sides[0] * sides[1] * sides[2];
  constexpr int kSamples = 20000;
  int wrong = 0;
  for (int i = 0; i < kSamples; ++i) {
    const Point p = box.lower + Point{unit(random) * sides[0], unit(random) * sides[1], unit(random) * sides[2]};
    const bool in_balls =
        std::ranges::any_of(follower.balls(), [&](const Ball& ball) { return length(p - ball.centre) < ball.radius; });
    wrong += in_balls != solid.contains(p) ? 1 : 0;
  }
  // Four standard deviations of the estimate.
  const double share = static_cast<double>(wrong) / kSamples, deviation = std::sqrt(share * (1 - share) / kSamples);
  EXPECT_LE((share - 4 * deviation) * volume, measures.uncovered() + 2 * measures.outside_bound);
}

}  // namespace
}  // namespace medial_vk
