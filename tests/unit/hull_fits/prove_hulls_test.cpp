// Proofs of given hulls: what sticks out is never proved, and what is well inside is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "hull_fits/final_hulls.h"
#include "medial_vk/hull_proofs.h"
#include "medial_vk/prepare.h"
#include "support/hulls/known_hulls.h"
#include "support/indexed.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using testing::HasSubstr;

IndexedMesh mesh_of_solid(Mesh mesh) { return test::indexed(prepare_mesh(std::move(mesh)).value()); }

bool is_proved(const IndexedMesh& mesh, const BallHull& hull) {
  const HullProof proof = prove_hulls(mesh, {&hull, 1}).value();
  EXPECT_EQ(proof.tested, 1u);
  EXPECT_EQ(proof.proved(), proof.failed == 0);
  EXPECT_EQ(proof.proved(), proof.greatest_lack == 0) << proof.greatest_lack;
  return proof.proved();
}

/// Moved and scaled by a power of two: the same roundings but for those of the move.
BallHull moved(BallHull hull, double factor, const Point& by) {
  for (Ball& ball : hull.corners) {
    for (std::size_t k = 0; k < 3; ++k) ball.centre[k] = factor * ball.centre[k] + by[k];
    ball.radius *= factor;
  }
  return hull;
}

// soak_hull_proofs does the same for any number of solids.
TEST(ProveHulls, OfSolidsInWhichAllIsKnown) {
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    const test::KnownSolid solid(seed);
    const IndexedMesh mesh = mesh_of_solid(solid.mesh());
    std::mt19937_64 random(seed + 100);
    std::vector<BallHull> out, in;
    for (int i = 0; i < 100; ++i) {
      out.push_back(solid.outside(random));
      in.push_back(solid.inside(random));
    }
    const HullProof refused = prove_hulls(mesh, out).value(), proof = prove_hulls(mesh, in).value();
    EXPECT_EQ(refused.tested, out.size());
    EXPECT_EQ(refused.failed, out.size()) << seed;
    EXPECT_EQ(refused.first_failure, 0u);
    EXPECT_GT(refused.greatest_lack, 0);
    EXPECT_EQ(proof.failed, 0u) << seed << ", first " << proof.first_failure;
    EXPECT_GE(proof.planes, in.size());
  }
}

// Sides of the box are exact, so that hulls that reach to them but for the rounding of the proof have one.
TEST(ProveHulls, GoToTheLastBits) {
  const IndexedMesh mesh = mesh_of_solid(test::make_box({1, 1, 1}));
  const auto slab = [](double r) {
    return hull_of(Ball{{0.5, 0.5, 0.5}, r}, Ball{{0.75, 0.5, 0.5}, 0.25}, Ball{{0.5, 0.875, 0.5}, 0.125});
  };
  const double u = 0x1p-53;
  EXPECT_TRUE(is_proved(mesh, moved(slab(0.5), 1 - 40 * u, {20 * u, 20 * u, 20 * u})));
  EXPECT_FALSE(is_proved(mesh, slab(0.5))) << "it touches";
  EXPECT_FALSE(is_proved(mesh, slab(0.5 + u)));
  const BallHull ball = hull_of(Ball{{0.5, 0.5, 0.5}, 0.5 * (1 - 40 * u)});
  EXPECT_TRUE(is_proved(mesh, ball));
}

TEST(ProveHulls, TellByHowMuchRadiiAreTooLarge) {
  const IndexedMesh mesh = mesh_of_solid(test::make_box({1, 1, 1}));
  for (const double excess : {1e-12, 1e-6, 0.01, 0.125}) {
    const BallHull hulls[] = {
        hull_of(Ball{{0.5, 0.5, 0.5}, 0.25}),
        hull_of(Ball{{0.25, 0.5, 0.5}, 0.25 + excess}, Ball{{0.5, 0.5, 0.5}, 0.25}),
        hull_of(Ball{{0.25, 0.5, 0.5}, 0.1}, Ball{{0.5, 0.25, 0.5}, 0.25 + 0.5 * excess}, Ball{{0.5, 0.5, 0.5}, 0.1})};
    const HullProof proof = prove_hulls(mesh, hulls).value();
    EXPECT_EQ(proof.tested, 3u);
    EXPECT_EQ(proof.failed, 2u);
    EXPECT_EQ(proof.first_failure, 1u);
    // Planes of closed forms, with a rounding of 12 units of sums of products up to 2.
    EXPECT_GE(proof.greatest_lack, excess - 1e-14);
    EXPECT_LE(proof.greatest_lack, excess + 1e-14);
    EXPECT_GT(proof.planes, 0u);
  }
}

TEST(ProveHulls, OfOneBallOrOnePoint) {
  const IndexedMesh mesh = mesh_of_solid(test::make_l_shape(1, 0.25, 0.5));
  EXPECT_TRUE(is_proved(mesh, hull_of(Ball{{0.125, 0.125, 0.25}, 0})));
  EXPECT_TRUE(is_proved(mesh, hull_of(Ball{{0.125, 0.125, 0.25}, 0.1249})));
  EXPECT_FALSE(is_proved(mesh, hull_of(Ball{{0.125, 0.125, 0.25}, 0.1251})));
  EXPECT_FALSE(is_proved(mesh, hull_of(Ball{{0.5, 0.5, 0.25}, 0}))) << "outside, in the notch";
  EXPECT_FALSE(is_proved(mesh, hull_of(Ball{{0.5, 0.5, 0.25}, 0.1})));
  EXPECT_FALSE(is_proved(mesh, hull_of(Ball{{0.5, 0.5, 0.25}, 10}))) << "it holds the solid";
  EXPECT_FALSE(is_proved(mesh, hull_of(Ball{{0.125, 0, 0.25}, 0}))) << "on a face";
  EXPECT_FALSE(is_proved(mesh, hull_of(Ball{{0, 0, 0}, 0}))) << "at a corner";
  EXPECT_FALSE(is_proved(mesh, hull_of(Ball{{0.25, 0.25, 0.25}, 0}))) << "on the edge of the notch";
  // An axis without radii, from one arm to the other, and one that stays inside.
  EXPECT_FALSE(is_proved(mesh, hull_of(Ball{{0.9, 0.1, 0.25}, 0}, Ball{{0.1, 0.9, 0.25}, 0})));
  EXPECT_TRUE(is_proved(mesh, hull_of(Ball{{0.3, 0.1, 0.25}, 0}, Ball{{0.1, 0.3, 0.25}, 0})));
  EXPECT_TRUE(
      is_proved(mesh, hull_of(Ball{{0.9, 0.1, 0.25}, 0}, Ball{{0.1, 0.1, 0.25}, 0}, Ball{{0.1, 0.2, 0.25}, 0})));
}

// Of planes that touch both, products are exactly 0: of a hull that lies in the plane of a face.
TEST(ProveHulls, AHullAlongAFaceIsNotProved) {
  const IndexedMesh mesh = mesh_of_solid(test::make_l_shape(1, 0.25, 0.5));
  // The faces of the notch, x = 0.25 from y = 0.25 on, and the same with x and y exchanged.
  for (const bool exchanged : {false, true}) {
    const auto at = [&](double x, double y, double z) { return exchanged ? Point{y, x, z} : Point{x, y, z}; };
    const Ball start = {at(0.25, 0.125, 0.25), 0};
    EXPECT_TRUE(is_proved(mesh, hull_of(start, Ball{at(0.25, 0.2, 0.25), 0})));
    EXPECT_FALSE(is_proved(mesh, hull_of(start, Ball{at(0.25, 0.75, 0.25), 0}))) << "it ends on the face";
    EXPECT_FALSE(is_proved(mesh, hull_of(start, Ball{at(0.25, 1.5, 0.25), 0})));
    EXPECT_FALSE(is_proved(mesh, hull_of(start, Ball{at(0.25, 0.75, 0.125), 0}, Ball{at(0.25, 0.75, 0.375), 0})));
  }
}

// Where the other face of the notch is missing, no triangle across the hull meets it at the edge of the notch.
TEST(ProveHulls, AHullAlongAFaceBesideAnOpeningIsNotProved) {
  Mesh open = test::make_l_shape(1, 0.25, 0.5);
  std::erase_if(open.triangles, [&](const Triangle& t) {
    const auto is_there = [&](std::uint32_t v) { return open.vertices[v][1] == 0.25 && open.vertices[v][0] >= 0.25; };
    return is_there(t[0]) && is_there(t[1]) && is_there(t[2]);
  });
  const IndexedMesh mesh = mesh_of_solid(open);
  ASSERT_EQ(mesh.prepared().report.open_edges, 4u);
  for (const double x : {0.25 - 0x1p-53, 0.25, 0.25 + 0x1p-53}) {
    const Ball start = {{x, 0.0625, 0.25}, 0};
    EXPECT_TRUE(is_proved(mesh, hull_of(start)));
    for (const double y : {0.25, 0.3, 0.5, 0.75, 1.5}) {
      EXPECT_FALSE(is_proved(mesh, hull_of(start, Ball{{x, y, 0.25}, 0}))) << y;
    }
  }
}

TEST(ProveHulls, OfNestedAndEqualBalls) {
  const IndexedMesh mesh = mesh_of_solid(test::make_box({1, 1, 1}));
  const Ball large = {{0.5, 0.5, 0.5}, 0.375}, small = {{0.625, 0.5, 0.5}, 0.125}, tiny = {{0.5, 0.5, 0.5}, 0};
  const Ball too_large = {{0.5, 0.5, 0.5}, 0.6};
  EXPECT_TRUE(is_proved(mesh, hull_of(small, large)));
  EXPECT_TRUE(is_proved(mesh, hull_of(tiny, large, large)));
  EXPECT_TRUE(is_proved(mesh, hull_of(tiny, tiny, tiny)));
  EXPECT_FALSE(is_proved(mesh, hull_of(tiny, too_large)));
  EXPECT_FALSE(is_proved(mesh, hull_of(small, tiny, too_large)));
}

// Mesh and hull at many scales and places: nothing that sticks out is proved, whatever under- or overflows.
TEST(ProveHulls, OfHugeTinyAndFarSolids) {
  const BallHull in = hull_of(Ball{{0.3, 0.3, 0.3}, 0.25}, Ball{{0.7, 0.5, 0.5}, 0.125}, Ball{{0.5, 0.7, 0.5}, 0.2});
  const BallHull out = hull_of(Ball{{0.3, 0.3, 0.3}, 0.25}, Ball{{0.7, 0.5, 0.5}, 0.125}, Ball{{0.5, 0.7, 0.5}, 0.31});
  for (const int exponent : {-60, -20, 0, 20, 58}) {
    const double factor = std::ldexp(1, exponent);
    for (const double far : {0.0, 16.0, 1e4}) {
      if (factor * far > 1e18) continue;
      Mesh box = test::make_box({1, 1, 1});
      test::scale(box, factor);
      const Point by = {factor * far, -2 * factor * far, 0};
      test::translate(box, by);
      const IndexedMesh mesh = mesh_of_solid(box);
      EXPECT_TRUE(is_proved(mesh, moved(in, factor, by))) << exponent << ' ' << far;
      EXPECT_FALSE(is_proved(mesh, moved(out, factor, by))) << exponent << ' ' << far;
    }
  }
  // Of numbers at both ends of what is taken.
  const IndexedMesh unit = mesh_of_solid(test::make_box({1, 1, 1}));
  const double least = std::numeric_limits<double>::denorm_min();
  EXPECT_FALSE(is_proved(unit, hull_of(Ball{{0.5, 0.5, -least}, least}, Ball{{0.5, 0.5, least}, 0})));
  EXPECT_TRUE(is_proved(unit, hull_of(Ball{{0.5, 0.5, 0.5}, least}, Ball{{0.25, 0.5, 0.5}, 0})));
  EXPECT_FALSE(is_proved(unit, hull_of(Ball{{0.5, 0.5, 0.5}, 0.1}, Ball{{1e18, 0.5, 0.5}, 0})));
  EXPECT_FALSE(is_proved(unit, hull_of(Ball{{0.5, 0.5, 0.5}, 1e18})));
}

// Outside of a closed mesh, but enclosed by it on all sides but one, and between two parts.
TEST(ProveHulls, InAPocketOutsideIsNoneProved) {
  const IndexedMesh cup = mesh_of_solid(test::make_cup(0.5, 0.1, 0.8, 24));
  EXPECT_FALSE(is_proved(cup, hull_of(Ball{{0, 0, 0.4}, 0.1})));
  EXPECT_FALSE(is_proved(cup, hull_of(Ball{{0, 0, 0.4}, 0.1}, Ball{{0.1, 0, 0.5}, 0.1}, Ball{{0, 0.1, 0.5}, 0.05})));
  EXPECT_FALSE(is_proved(cup, hull_of(Ball{{0, 0, 0.05}, 0.01}, Ball{{0, 0, 0.4}, 0.1}))) << "through the floor";
  EXPECT_TRUE(is_proved(cup, hull_of(Ball{{0, 0, 0.05}, 0.04}, Ball{{0.3, 0, 0.05}, 0.04})));
  Mesh two = test::make_box({1, 1, 1});
  test::append(two, test::moved(test::make_box({1, 1, 1}), {1.0 + 1e-9, 0, 0}));
  const IndexedMesh apart = mesh_of_solid(two);
  EXPECT_FALSE(is_proved(apart, hull_of(Ball{{0.5, 0.5, 0.5}, 0.1}, Ball{{1.5, 0.5, 0.5}, 0.1})));
  EXPECT_TRUE(is_proved(apart, hull_of(Ball{{1.4, 0.5, 0.5}, 0.1}, Ball{{1.5, 0.5, 0.5}, 0.1})));
}

TEST(ProveHulls, OfAMeshWithAnInnerShell) {
  Mesh shell = test::make_box({1, 1, 1}), inner = test::moved(test::make_box({0.5, 0.5, 0.5}), {0.25, 0.25, 0.25});
  const BallHull wall = hull_of(Ball{{0.1, 0.1, 0.1}, 0.09}, Ball{{0.9, 0.1, 0.1}, 0.09}, Ball{{0.1, 0.9, 0.1}, 0.05});
  const BallHull across = hull_of(Ball{{0.1, 0.5, 0.5}, 0.05}, Ball{{0.9, 0.5, 0.5}, 0.05});
  const BallHull around = hull_of(Ball{{0.5, 0.5, 0.5}, 0.48});
  const BallHull within = hull_of(Ball{{0.5, 0.5, 0.5}, 0.1}, Ball{{0.6, 0.5, 0.5}, 0.1});
  {
    Mesh cavity = shell, turned = inner;
    test::turn_over(turned);
    test::append(cavity, turned);
    const IndexedMesh mesh = mesh_of_solid(cavity);
    ASSERT_TRUE(mesh.prepared().report.closed);
    EXPECT_TRUE(is_proved(mesh, wall));
    EXPECT_FALSE(is_proved(mesh, across)) << "through the cavity";
    EXPECT_FALSE(is_proved(mesh, around)) << "it holds the cavity's boundary";
    EXPECT_FALSE(is_proved(mesh, within)) << "in the cavity";
  }
  {  // Faces that lie within the solid, if the preparation keeps them, may prevent a proof, but make none.
    Mesh both = shell;
    test::append(both, inner);
    const IndexedMesh mesh = mesh_of_solid(both);
    EXPECT_TRUE(is_proved(mesh, wall));
    EXPECT_TRUE(is_proved(mesh, within));
    EXPECT_FALSE(is_proved(mesh, hull_of(Ball{{0.5, 0.5, 0.5}, 0.51})));
  }
}

Mesh open_box() {
  Mesh mesh = test::make_box({1, 1, 1});
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    return mesh.vertices[t[0]][2] == 1 && mesh.vertices[t[1]][2] == 1 && mesh.vertices[t[2]][2] == 1;
  });
  return mesh;
}

// No triangle is between the inside of a box without a face and the outside before it. By symmetry the winding number
// is 1/2 in the middle of the missing face, and below 1/2 above it.
TEST(ProveHulls, NoneLeavesThroughAnOpening) {
  const IndexedMesh mesh = mesh_of_solid(open_box());
  ASSERT_FALSE(mesh.prepared().report.closed);
  const Ball deep = {{0.5, 0.5, 0.3}, 0.1};
  EXPECT_TRUE(is_proved(mesh, hull_of(deep)));
  EXPECT_TRUE(is_proved(mesh, hull_of(deep, Ball{{0.3, 0.5, 0.4}, 0.2}, Ball{{0.5, 0.3, 0.4}, 0.1})));
  for (const double top : {1.01, 1.2, 1.5, 3.0, 100.0}) {
    for (const double r : {0.0, 1e-6, 0.01, 0.3}) {
      const Ball outside = {{0.5, 0.5, top}, r};
      EXPECT_FALSE(is_proved(mesh, hull_of(outside))) << top << ' ' << r;
      EXPECT_FALSE(is_proved(mesh, hull_of(deep, outside))) << top << ' ' << r;
      EXPECT_FALSE(is_proved(mesh, hull_of(deep, Ball{{0.3, 0.5, 0.4}, 0.1}, outside))) << top << ' ' << r;
    }
  }
  EXPECT_FALSE(is_proved(mesh, hull_of(Ball{{0.5, 0.5, 0.8}, 0.45}))) << "it reaches above the opening";
  // Random hulls that reach above it.
  std::mt19937_64 random(36);
  const auto any = [&] { return std::uniform_real_distribution<double>(0.05, 0.95)(random); };
  for (int i = 0; i < 200; ++i) {
    const double x = any(), y = any(), z = any(), over_x = any(), over_y = any(), above = any();
    const BallHull hull = hull_of(Ball{{x, y, z}, 0.01}, Ball{{over_x, over_y, 1 + 0.1 * above}, 0.01});
    EXPECT_FALSE(is_proved(mesh, hull)) << i;
  }
}

TEST(ProveHulls, Refuses) {
  const IndexedMesh mesh = mesh_of_solid(test::make_box({1, 1, 1}));
  const BallHull good = hull_of(Ball{{0.5, 0.5, 0.5}, 0.1}, Ball{{0.6, 0.5, 0.5}, 0.1});
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  std::vector<BallHull> bad;
  for (const double x : {nan, infinity, -infinity, 1.001e18, -1.001e18}) {
    for (std::size_t i = 0; i < 2; ++i) {
      bad.push_back(good);
      bad.back().corners[i].centre[i] = x;
      bad.push_back(good);
      bad.back().corners[i].radius = x;
    }
  }
  bad.push_back(good);
  bad.back().corners[1].radius = -1e-300;
  for (const std::uint32_t count : {0u, 4u}) {
    bad.push_back(good);
    bad.back().count = count;
  }
  for (std::size_t i = 0; i < bad.size(); ++i) {
    const std::vector<BallHull> hulls = {good, good, bad[i]};
    const Result<HullProof> refused = prove_hulls(mesh, hulls);
    ASSERT_FALSE(refused.ok()) << i;
    EXPECT_EQ(refused.error().code, ErrorCode::kUsage);
    EXPECT_THAT(refused.error().message, HasSubstr("hull 2 of `hulls`"));
  }
  BallHull unused = hull_of(Ball{{0.5, 0.5, 0.5}, 0.1});
  unused.corners[1] = {{nan, nan, nan}, nan};
  EXPECT_TRUE(is_proved(mesh, unused)) << "only the first ball is one of the hull";
  const Result<HullProof> many = prove_hulls(mesh, std::vector<BallHull>((1u << 20) + 1, good));
  ASSERT_FALSE(many.ok());
  EXPECT_EQ(many.error().code, ErrorCode::kUsage);
  EXPECT_THAT(many.error().message, HasSubstr("1048577"));
  EXPECT_EQ(prove_hulls(mesh.on_side({}).value(), {&good, 1}).error().code, ErrorCode::kUsage);
}

TEST(ProveHulls, StopsAndNeedsNoHull) {
  const IndexedMesh mesh = mesh_of_solid(test::make_box({1, 1, 1}));
  const HullProof none = prove_hulls(mesh, {}).value();
  EXPECT_TRUE(none.proved());
  EXPECT_EQ(none.tested, 0u);
  std::stop_source stopped;
  stopped.request_stop();
  const BallHull good = hull_of(Ball{{0.5, 0.5, 0.5}, 0.1});
  EXPECT_EQ(prove_hulls(mesh, {&good, 1}, {}, stopped.get_token()).error().code, ErrorCode::kInterrupted);
}

TEST(ProveHulls, IsTheSameForAnyNumberOfThreads) {
  const test::KnownSolid solid(7);
  const IndexedMesh mesh = mesh_of_solid(solid.mesh());
  std::mt19937_64 random(1);
  std::vector<BallHull> hulls;
  for (int i = 0; i < 60; ++i) hulls.push_back(i % 7 == 5 ? solid.outside(random) : solid.inside(random));
  const HullProof one = prove_hulls(mesh, hulls, {.threads = 1}).value();
  EXPECT_EQ(one.first_failure, 5u);
  for (const unsigned threads : {2u, 3u}) {
    const HullProof other = prove_hulls(mesh, hulls, {.threads = threads}).value();
    EXPECT_EQ(other.failed, one.failed);
    EXPECT_EQ(other.first_failure, one.first_failure);
    EXPECT_EQ(other.planes, one.planes);
    EXPECT_EQ(other.greatest_lack, one.greatest_lack);
  }
}

// Radii give way by little more than they must.
TEST(FreeHulls, AreProvedAfterTheLeastChange) {
  const IndexedMesh mesh = mesh_of_solid(test::make_box({1, 1, 1}));
  const Solid solid = Solid::build(mesh).value();
  const std::vector<BallHull> hulls = {
      hull_of(Ball{{0.25, 0.5, 0.5}, 0.25}, Ball{{0.5, 0.5, 0.5}, 0.3}),          // touches
      hull_of(Ball{{0.25, 0.5, 0.5}, 0.25 + 1e-8}, Ball{{0.5, 0.5, 0.5}, 0.25}),  // by the tolerance of the search
      hull_of(Ball{{0.25, 0.5, 0.5}, 0.1}, Ball{{0.5, 0.5, 0.5}, 0.1}),           // inside
      hull_of(Ball{{0.25, 0.5, 1.5}, 0.1}, Ball{{0.5, 0.5, 1.5}, 0.1}),           // outside
      hull_of(Ball{{0.5, 0.5, 0.5}, 0.1}, Ball{{0.5, 0.5, 1.5}, 0.1})};           // through the boundary
  const FreedHulls freed = free_hulls(solid, hulls, {});
  ASSERT_EQ(freed.hulls.size(), 3u);
  EXPECT_TRUE(prove_hulls(mesh, freed.hulls).value().proved());
  EXPECT_NEAR(freed.greatest_shrink, 1e-8, 1e-13);
  for (std::uint32_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(freed.hulls[0].corners[k].radius, hulls[0].corners[k].radius, 1e-13);
    EXPECT_EQ(freed.hulls[2].corners[k].radius, hulls[2].corners[k].radius);
  }
}

}  // namespace
}  // namespace medial_vk
