// Distances of solids against the reference: all pairs of triangles, without a tree.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "base/point_ops.h"
#include "cpu_reference/distance.h"
#include "medial_vk/prepare.h"
#include "medial_vk/proximity.h"
#include "support/distances/reference_motion.h"
#include "support/indexed.h"
#include "support/random_poses.h"
#include "support/reference_mesh.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using namespace test;

struct Solids {
  const char* name;
  Mesh mesh;
};

std::vector<Solids> all_solids() {
  return {{"box", make_box({1, 1, 1})},
          {"needle", make_box({2, 0.01, 0.02})},
          {"plate", make_plate_with_hole(1, 0.02, 0.4)},
          {"sphere", make_sphere(0.5, 500)},
          {"torus", make_torus(0.5, 0.2, 20, 30)},
          {"cup", make_cup(0.5, 0.1, 0.8, 24)},
          {"L", make_l_shape(1, 0.3, 0.4)},
          {"shell", make_shell(300, 200)},
          {"parts", make_two_parts(200)}};
}

Body body_of(const Mesh& mesh) { return Body::create(indexed(prepare_mesh(mesh).value())).value(); }

/// The distance of the solids, by the reference.
double exact_distance(const Mesh& a, const Mesh& b, const Pose& pose, bool surfaces_only) {
  const reference::Mesh of_a = to_reference(a), of_b = to_reference(b);
  const double distance = reference::nearest_of_meshes(of_a, of_b, test::to_reference(pose)).distance;
  if (surfaces_only || distance == 0) return distance;
  return reference::one_holds_the_other(of_a, of_b, test::to_reference(pose)) ? 0 : distance;
}

/// Six times the error of nearest_triangles.cpp, 32 * 2^-53 of the sum of both reaches and of the shift, to which
/// `size` is a bound. The reference has fewer roundings.
double rounding(double size) { return 192 * 0x1p-53 * size; }

void expect_holds(const Distance& found, double exact, double size, const DistanceOptions& options = {}) {
  EXPECT_LE(found.lower, exact + rounding(size));
  EXPECT_GE(found.upper, exact - rounding(size));
  if (found.upper == 0 || exact > options.limit) return;
  EXPECT_LE(found.upper - found.lower, options.tolerance + rounding(size));
  EXPECT_NEAR(length(found.on_a - found.on_b), found.upper, rounding(size));
}

// Of all solids with all: far apart, near, crossing and nested.
TEST(Distance, OfSolidsIsThatOfAllPairs) {
  Random random(1);
  const std::vector<Solids> solids = all_solids();
  std::size_t hits = 0, free = 0;
  for (const Solids& of_a : solids) {
    const Body a = body_of(of_a.mesh);
    for (const Solids& of_b : solids) {
      const Body b = body_of(of_b.mesh);
      for (const double far : {0.1, 0.3, 0.6, 1.5, 4.0}) {
        const Pose pose = any_pose(random, point_in_cube(random, far));
        SCOPED_TRACE(testing::Message() << of_a.name << " and " << of_b.name << ", shift up to " << far);
        const double exact = exact_distance(of_a.mesh, of_b.mesh, pose, false);
        const Distance found = distance(a, b, pose).value();
        expect_holds(found, exact, 8 + 2 * far);
        EXPECT_EQ(found.collision(), exact > 0 ? Collision::kFree : Collision::kHit);
        EXPECT_EQ(collide(a, b, pose), found.collision());
        ++(exact > 0 ? free : hits);
      }
    }
  }
  EXPECT_GT(hits, 80u);
  EXPECT_GT(free, 80u);
}

TEST(Distance, OfSurfacesSeesWhatLiesInside) {
  Random random(2);
  const Mesh large = make_shell(300, 200), small = make_box({0.2, 0.3, 0.1});
  const Body a = body_of(large), b = body_of(small);
  DistanceOptions surfaces;
  surfaces.surfaces_only = true;
  for (const double x : {0.0, 0.3, 0.8, 0.9, 2.0}) {  // in the cavity, through its wall, in the wall, outside
    for (int i = 0; i < 10; ++i) {
      const Pose pose = any_pose(random, {x, 0.02 * i, 0});
      SCOPED_TRACE(testing::Message() << "at " << x << ", pose " << i);
      expect_holds(distance(a, b, pose, surfaces).value(), exact_distance(large, small, pose, true), 8, surfaces);
      expect_holds(distance(a, b, pose).value(), exact_distance(large, small, pose, false), 8);
    }
  }
}

// Inside another solid, on either side of the pair, the witness is a point of both.
TEST(Distance, OfNestedSolidsIsZero) {
  const Body large = body_of(make_sphere(1, 300)), small = body_of(make_box({0.1, 0.1, 0.1}));
  const Pose pose = make_pose({0.2, 0.3, -0.4}, {1, 2, 3});
  const Distance found = distance(large, small, pose).value(), other = distance(small, large, Pose{}).value();
  EXPECT_EQ(found.collision(), Collision::kHit);
  EXPECT_EQ(other.collision(), Collision::kHit);
  EXPECT_LT(length(found.on_a), 1);
  EXPECT_EQ(found.on_a, found.on_b);
}

TEST(Distance, IsNoWiderThanTheToleranceAndEndsAtTheLimit) {
  Random random(3);
  const Mesh mesh = make_torus(0.5, 0.2, 20, 30);
  const Body a = body_of(mesh);
  for (int i = 0; i < 60; ++i) {
    const Pose pose = any_pose(random, point_in_cube(random, 2));
    const double exact = exact_distance(mesh, mesh, pose, false);
    for (const double tolerance : {0.0, 1e-9, 1e-3, 0.1, 10.0}) {
      for (const double limit : {0.0, 0.5, std::numeric_limits<double>::infinity()}) {
        DistanceOptions options;
        options.tolerance = tolerance;
        options.limit = limit;
        const Distance found = distance(a, a, pose, options).value();
        SCOPED_TRACE(testing::Message() << "tolerance " << tolerance << ", limit " << limit << ", exact " << exact);
        expect_holds(found, exact, 10, options);
        EXPECT_GE(found.lower, std::min(limit, exact - tolerance) - rounding(10));
        if (tolerance == 0) {
          EXPECT_EQ(found.collision(), exact > 0 ? Collision::kFree : Collision::kHit);
        }
      }
    }
  }
}

TEST(Distance, AStartChangesNothing) {
  const Mesh mesh = make_l_shape(1, 0.3, 0.4);
  const Body a = body_of(mesh), b = body_of(make_cup(0.5, 0.1, 0.8, 24));
  Distance last;
  for (int i = 0; i < 200; ++i) {
    const Pose pose = make_pose({2 - 0.01 * i, 0.1, 0.2}, {0.02 * i, 0.3, 0.01 * i});
    last = distance(a, b, pose, {}, last).value();
    const Distance fresh = distance(a, b, pose).value();
    EXPECT_NEAR(last.lower, fresh.lower, rounding(10));
    EXPECT_NEAR(last.upper, fresh.upper, rounding(10));
    EXPECT_EQ(last.collision(), fresh.collision());
  }
  last.triangle_a = 100000;
  EXPECT_EQ(distance(a, b, Pose{}, {}, last).value().upper, distance(a, b, Pose{}).value().upper);
}

/// With every budget, up to where it no longer matters.
void expect_narrowing(const Body& a, const Body& b, const Pose& pose, double exact, DistanceOptions options) {
  const double tolerance = options.tolerance;
  Distance before;
  for (std::uint64_t most = 0; most < 3000; most = most < 40 ? most + 1 : most * 5 / 4) {
    options.most_comparisons = most;
    options.tolerance = tolerance;
    const Distance found = distance(a, b, pose, options).value();
    SCOPED_TRACE(testing::Message() << most << " comparisons, tolerance " << tolerance << ", exact " << exact);
    EXPECT_GE(found.lower, before.lower);
    EXPECT_LE(found.upper, before.upper);
    options.tolerance = std::numeric_limits<double>::max();  // no limit of the width
    expect_holds(found, exact, 10, options);
    before = found;
  }
  options.tolerance = tolerance;
  options.most_comparisons = 1'000'000;  // enough
  expect_holds(distance(a, b, pose, options).value(), exact, 10, options);
}

TEST(Distance, NarrowsWithItsBudget) {
  Random random(5);
  const Mesh torus = make_torus(0.5, 0.2, 20, 30), large = make_sphere(1, 300);
  const Body a = body_of(torus), b = body_of(large);
  for (const double far : {0.1, 0.5, 1.2, 2.0}) {
    for (int i = 0; i < 4; ++i) {
      const Pose pose = any_pose(random, point_in_cube(random, far));
      const double exact = exact_distance(torus, large, pose, false);
      expect_narrowing(a, b, pose, exact, {});
      expect_narrowing(a, b, pose, exact, {.tolerance = 0.1});
      expect_narrowing(a, b, pose, exact_distance(torus, large, pose, true), {.surfaces_only = true});
    }
  }
  // Some comparisons are enough for much, and fewer than for all.
  const Pose apart = make_pose({2.5, 0.3, 0.1}, {0.3, 0.2, 0.1});
  const Distance none = distance(a, b, apart, {.most_comparisons = 0}).value();
  const Distance some = distance(a, b, apart, {.most_comparisons = 20}).value();
  const Distance all = distance(a, b, apart).value();
  EXPECT_LE(none.lower, some.lower);  // what the first way down passes by is known without a comparison
  EXPECT_LT(none.upper, 2 * all.upper);
  EXPECT_GT(some.lower, 0.7 * all.lower);
  EXPECT_LT(some.lower, all.lower);
}

// Of any size and at any place, faces on faces, and edges on edges.
TEST(Distance, OfTouchingSolidsIsZeroOrLittleMore) {
  for (const double size : {1e-9, 1.0, 1e9}) {
    const Mesh mesh = make_box({size, size, size});
    const Body a = body_of(mesh);
    for (const Point& at : {Point{1, 0, 0}, Point{1, 1, 0}, Point{1, 1, 1}, Point{1, 0.5, 0.25}, Point{0, 0, 0}}) {
      const Distance found = distance(a, a, make_pose(size * at, {0, 0, 0})).value();
      EXPECT_EQ(found.lower, 0);
      EXPECT_LE(found.upper, rounding(4 * size));
      EXPECT_NE(collide(a, a, make_pose(size * at, {0, 0, 0})), Collision::kFree);
    }
    for (const double apart : {1e-12, 1e-6, 1e-3}) {
      const Distance found = distance(a, a, make_pose({size * (1 + apart), 0, 0}, {0, 0, 0})).value();
      EXPECT_EQ(found.collision(), Collision::kFree) << apart;
      EXPECT_NEAR(found.upper, size * apart, rounding(4 * size));
    }
    const Distance within = distance(a, a, make_pose({size * (1 - 1e-6), 0.3 * size, 0.2 * size}, {0, 0, 0.1})).value();
    EXPECT_EQ(within.collision(), Collision::kHit);
  }
}

TEST(Distance, OfCoincidingSurfacesIsAHit) {
  const Mesh mesh = make_box({1, 1, 1});
  const std::vector<Ball> inside = {{{0.5, 0.5, 0.5}, 0.4}};
  const Body a = Body::create(indexed(prepare_mesh(mesh).value()), inside).value();
  const Distance found = distance(a, a, Pose{}).value();
  EXPECT_EQ(found.collision(), Collision::kHit);
  EXPECT_NEAR(length(found.on_a - Point{0.5, 0.5, 0.5}), 0, std::sqrt(0.75));
}

// Where a tolerance ends the search before triangles are known to cross, balls inside still decide.
TEST(Distance, BallsDecideWhereTheSearchEndsBefore) {
  const Mesh mesh = make_sphere(0.5, 180);
  const std::vector<Ball> inside = {{{0.4, 0, 0}, 0.04}, {{0, 0, 0}, 0.3}};
  const Body a = Body::create(indexed(prepare_mesh(mesh).value()), inside).value();
  const Pose pose = make_pose({0.25, 0.1, 0.2}, {0, 0.3, 0});
  const Distance found = distance(a, a, pose, {.tolerance = 1}).value();
  EXPECT_EQ(found.collision(), Collision::kHit);
  ASSERT_LT(found.inside_pair.a, inside.size());
  ASSERT_LT(found.inside_pair.b, inside.size());
  const Ball &of_a = inside[found.inside_pair.a], &of_b = inside[found.inside_pair.b];
  // Up to the rounding of coordinates below 1.
  EXPECT_LE(length(found.on_a - of_a.centre), of_a.radius + 0x1p-50);
  EXPECT_LE(length(found.on_a - pose * of_b.centre), of_b.radius + 0x1p-50);
  // Triangles decide all else, whatever the start names.
  EXPECT_EQ(distance(a, a, pose, {}, found).value().inside_pair, BallPair());
  EXPECT_EQ(distance(a, a, make_pose({2, 0.2, 0.1}, {0.1, 0, 0}), {}, found).value().inside_pair, BallPair());
  const Body without = Body::create(indexed(prepare_mesh(mesh).value())).value();
  EXPECT_EQ(distance(without, without, pose, {.tolerance = 1}).value().collision(), Collision::kUndecided);
}

TEST(Distance, OfFarSolidsHoldsTheirs) {
  const Mesh mesh = make_sphere(0.5, 100);
  const Body a = body_of(mesh);
  for (const double far : {1e3, 1e6, 1e12}) {
    const Pose pose = make_pose({far, -far, 0.5 * far}, {1, 2, 3});
    expect_holds(distance(a, a, pose).value(), exact_distance(mesh, mesh, pose, false), 3 * far);
  }
  const Distance beyond = distance(a, a, make_pose({1e300, 0, 0}, {0, 0, 0})).value();
  EXPECT_EQ(beyond.lower, 0);
  EXPECT_EQ(beyond.upper, std::numeric_limits<double>::infinity());
}

// Where the balls of the trees, in float, cannot tell one pair of nodes from another: there are 10^8 pairs of
// triangles.
TEST(Distance, OfFarSolidsTakesFewComparisons) {
  const Body a = body_of(make_torus(0.5, 0.2, 100, 50));
  DistanceOptions few;
  few.most_comparisons = 20'000;
  for (const double far : {1e4, 1e6, 1e9}) {
    const Distance found = distance(a, a, make_pose({far, -far, 0.5 * far}, {1, 2, 3}), few).value();
    EXPECT_LE(found.upper - found.lower, rounding(4 * far)) << far;
  }
}

TEST(Distance, OfManyPosesIsThatOfEach) {
  Random random(4);
  const Body a = body_of(make_torus(0.5, 0.2, 20, 30)), b = body_of(make_l_shape(1, 0.3, 0.4));
  std::vector<Pose> poses;
  for (int i = 0; i < 300; ++i) poses.push_back(any_pose(random, point_in_cube(random, 2)));
  for (const unsigned threads : {1u, 3u}) {
    std::vector<Distance> many(poses.size());
    ASSERT_TRUE(distances(a, b, poses, many, {}, {.threads = threads}).ok());
    for (std::size_t i = 0; i < poses.size(); ++i) {
      EXPECT_NEAR(many[i].upper, distance(a, b, poses[i]).value().upper, rounding(10));
    }
  }
}

Mesh tetrahedron(const std::array<Point, 4>& corners) {
  Mesh mesh;
  mesh.vertices.assign(corners.begin(), corners.end());
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {0, 2, 3}};
  return mesh;
}

// Two tetrahedra, each with a face that is a sliver. Their surfaces are 1.329129154951412e-09 apart, in arithmetic of
// 113 bits; a foot on a sliver that is no convex combination of its corners is farther off than that.
TEST(Distance, OfSliversIsNotBelowTheTrueOne) {
  const Mesh of_a = tetrahedron({{{-0.1136739039777708, 0.18020679516951321, -0.37063618316229247},
                                  {0.1128680034743041, -0.1789292042553827, 0.36800852742015144},
                                  {-0.012048985439830644, 0.019101209470901503, -0.03928597345813338},
                                  {0.25651362280930495, -0.54236909231431818, -0.3609656875236732}}});
  const Mesh of_b = tetrahedron({{{-0.064497802308539617, 0.10224811383683179, -0.2102964547514613},
                                  {0.22964708174041368, -0.36405861976636189, 0.74876919962977151},
                                  {0.1005299938411339, -0.15936980561330363, 0.32778018671665987},
                                  {-0.17223882703273474, 0.40876858859505094, 0.63574545498857171}}});
  DistanceOptions surfaces;
  surfaces.surfaces_only = true;
  const Distance found = distance(body_of(of_a), body_of(of_b), Pose{}, surfaces).value();
  EXPECT_LE(found.lower, 1.329129154951412e-09);
  EXPECT_GE(found.upper, 1.329129154951412e-09);
  EXPECT_LE(found.upper, 1.34e-09);
}

// In the frame of the other one, a triangle that is smaller than the rounding there is a point.
TEST(Distance, OfASolidSmallerThanRoundingIsThatOfAPoint) {
  Random random(6);
  const Mesh large = make_box({2, 0.01, 0.02}), small = make_box({1e-18, 1e-18, 1e-18});
  const Body a = body_of(large), b = body_of(small);
  for (int i = 0; i < 100; ++i) {
    const Pose pose = any_pose(random, point_in_cube(random, 1.5));
    expect_holds(distance(a, b, pose).value(), exact_distance(large, small, pose, false), 10);
    expect_holds(distance(b, a, pose).value(), exact_distance(small, large, pose, false), 10);
  }
}

// Of products of many rotations: their inverse is not their transpose to all digits.
TEST(Distance, RotationsNeedNotBePerfect) {
  Random random(9);
  const Body a = body_of(make_box({1, 1, 1}));
  for (int i = 0; i < 200; ++i) {
    Pose pose = any_pose(random, {8, 0, 0});
    for (Point& row : pose.rotation) row[0] += uniform(random, -1e-12, 1e-12);
    EXPECT_EQ(collide(a, a, pose), Collision::kFree);
    pose.shift = {0.5, 0.5, 0.5};
    EXPECT_EQ(collide(a, body_of(make_box({0.1, 0.1, 0.1})), pose), Collision::kHit);
  }
}

// A stick stands in a box without a lid: the winding number there is above 1/2, but an open mesh encloses nothing.
TEST(Distance, OfABoxWithoutALidAndAStickInIt) {
  Mesh box = make_box({1, 1, 1}), stick = make_box({0.1, 0.1, 2});
  std::erase_if(box.triangles, [&](const Triangle& t) {
    return std::ranges::all_of(t, [&](std::uint32_t v) { return box.vertices[v][2] == 1; });
  });
  const Body a = body_of(box), b = body_of(stick);
  expect_holds(distance(a, b, make_pose({0.4, 0.45, 0.3}, {0, 0, 0})).value(), 0.3, 10);
  expect_holds(distance(b, a, make_pose({-0.4, -0.45, -0.3}, {0, 0, 0})).value(), 0.3, 10);
}

TEST(Distance, OfAnOpenMeshIsThatOfItsSurface) {
  Mesh mesh = make_box({1, 1, 1});
  mesh.triangles.resize(10);
  const Body a = body_of(mesh), b = body_of(make_sphere(0.1, 100));
  EXPECT_NEAR(distance(a, b, make_pose({2, 0.5, 0.5}, {0, 0, 0})).value().upper, 0.9, 0.01);
}

TEST(Distance, RefusesWhatHasNoAnswer) {
  const Body with = body_of(make_box({1, 1, 1})), without = Body::create({{{{0, 0, 0}, 1}}}, {}).value();
  EXPECT_FALSE(without.has_mesh());
  EXPECT_THAT(distance(with, without, Pose{}).error().message, testing::HasSubstr("mesh"));
  DistanceOptions options;
  options.tolerance = -1;
  EXPECT_THAT(distance(with, with, Pose{}, options).error().message, testing::HasSubstr("`tolerance`"));
  options.tolerance = 0;
  options.limit = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(distance(with, with, Pose{}, options).error().message, testing::HasSubstr("`limit`"));
  EXPECT_FALSE(Body::create(indexed(prepare_mesh(make_box({1e19, 1, 1})).value())).ok());
}

}  // namespace
}  // namespace medial_vk
