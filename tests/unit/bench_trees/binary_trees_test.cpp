// The binary trees of bench/trees against all pairs of balls, and their volumes against points.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "../../../bench/trees/binary_tree.h"
#include "../../../bench/trees/likelihood.h"
#include "base/point_ops.h"
#include "support/random_poses.h"

namespace medial_vk {
namespace {

using namespace test;

/// Rounding of some tens of operations on lengths up to `size`.
double rounding(double size) { return 1e-14 * size; }

std::vector<Ball> balls_of_tree(Random& random, std::size_t count, double size, double radius) {
  std::vector<Ball> balls;
  for (std::size_t i = 0; i < count; ++i) {
    balls.push_back({point_in_cube(random, size), uniform(random, 0, radius * size)});
  }
  return balls;
}

double least_of_pairs(const std::vector<Ball>& a, const std::vector<Ball>& b, const Pose& pose) {
  double least = std::numeric_limits<double>::infinity();
  for (const Ball& of_b : b) {
    const Point centre = pose * of_b.centre;
    for (const Ball& of_a : a) least = std::min(least, length(of_a.centre - centre) - of_a.radius - of_b.radius);
  }
  return least;
}

template <class Volume>
void expect_closest_pairs(const std::vector<Ball>& a, const std::vector<Ball>& b, const bench::Pairing& pairing_a,
                          const bench::Pairing& pairing_b, double size, Random& random) {
  const bench::BinaryTree<Volume> tree_a(a, pairing_a), tree_b(b, pairing_b);
  bench::ClosestPair last;
  for (int i = 0; i < 8; ++i) {
    const Pose pose = any_pose(random, point_in_cube(random, 4 * size));
    const double least = least_of_pairs(a, b, pose);
    // The second query starts from the answer of another pose.
    for (const BallPair& start : {BallPair{}, last.balls}) {
      const bench::ClosestPair found = bench::closest_pair(tree_a, tree_b, pose, start);
      const Ball &of_a = a[found.balls.a], &of_b = b[found.balls.b];
      EXPECT_NEAR(found.separation, length(of_a.centre - pose * of_b.centre) - of_a.radius - of_b.radius,
                  rounding(20 * size));
      EXPECT_NEAR(std::max(0.0, found.separation), std::max(0.0, least), rounding(20 * size));
      EXPECT_GT(found.tests, 0u);
      last = found;
    }
  }
}

TEST(BinaryTrees, FindTheClosestOfAllPairs) {
  Random random(1);
  for (const std::size_t count : {1, 2, 3, 17, 200}) {
    for (const double size : {1e-6, 1.0, 1e6}) {
      SCOPED_TRACE(testing::Message() << count << " balls of size " << size);
      const std::vector<Ball> a = balls_of_tree(random, count, size, 0.2);
      const std::vector<Ball> b = balls_of_tree(random, count / 2 + 1, size, 0.1);
      const bench::Pairing down_a = bench::pair_top_down(a), down_b = bench::pair_top_down(b);
      const bench::Pairing up_a = bench::pair_bottom_up(a), up_b = bench::pair_bottom_up(b);
      expect_closest_pairs<bench::BoundingBall>(a, b, down_a, down_b, size, random);
      expect_closest_pairs<bench::BoundingBall>(a, b, up_a, up_b, size, random);
      expect_closest_pairs<bench::SweptRectangle>(a, b, down_a, down_b, size, random);
      expect_closest_pairs<bench::SweptRectangle>(a, b, up_a, up_b, size, random);
    }
  }
}

// Equal balls, points on a line and in a plane, and a ball that holds all others.
TEST(BinaryTrees, TakeDegenerateSets) {
  Random random(2);
  std::vector<Ball> equal(9, Ball{{1, 2, 3}, 0.5}), line, plane, nested = balls_of_tree(random, 30, 1, 0.1);
  for (int i = 0; i < 20; ++i) line.push_back({{0.1 * i, 0.2 * i, -0.1 * i}, 0});
  for (int i = 0; i < 25; ++i) plane.push_back({{1.0 * (i % 5), 1.0 * (i / 5), 0}, 0.25});
  nested.push_back({{0, 0, 0}, 3});
  for (const std::vector<Ball>& a : {equal, line, plane, nested}) {
    for (const std::vector<Ball>& b : {equal, line, plane, nested}) {
      expect_closest_pairs<bench::BoundingBall>(a, b, bench::pair_bottom_up(a), bench::pair_top_down(b), 5, random);
      expect_closest_pairs<bench::SweptRectangle>(a, b, bench::pair_bottom_up(a), bench::pair_top_down(b), 5, random);
    }
  }
}

TEST(BinaryTrees, FindTheSameByLikelihood) {
  Random random(7);
  for (const std::size_t count : {1, 2, 17, 200}) {
    const std::vector<Ball> balls = balls_of_tree(random, count, 1, 0.2);
    const std::vector<double> likelihoods = bench::likelihoods_of(balls, 0.5);
    EXPECT_NEAR(std::accumulate(likelihoods.begin(), likelihoods.end(), 0.0), 1, 1e-12);
    for (const bench::Pairing& pairing :
         {bench::pair_by_likelihood(balls, likelihoods), bench::pair_bottom_up(balls)}) {
      const bench::BinaryTree<bench::BoundingBall> tree(balls, pairing, likelihoods);
      EXPECT_NEAR(tree.node(tree.root()).likelihood, 1, 1e-12);
      for (int i = 0; i < 20; ++i) {
        const Pose pose = any_pose(random, point_in_cube(random, 4));
        const double found = bench::closest_pair(tree, tree, pose, BallPair{}, bench::PartOrder::kLikelier).separation;
        EXPECT_NEAR(std::max(0.0, found), std::max(0.0, least_of_pairs(balls, balls, pose)), rounding(20));
      }
    }
  }
}

// Of three balls in a row the likeliest is one step from the root, at either end.
TEST(BinaryTrees, LikelyBallsAreNearTheRoot) {
  const std::vector<Ball> balls = {{{0, 0, 0}, 1}, {{3, 0, 0}, 1}, {{6, 0, 0}, 1}};
  for (const std::uint32_t likeliest : {0u, 2u}) {
    std::vector<double> likelihoods(3, 0.1);
    likelihoods[likeliest] = 0.8;
    const bench::Pairing pairing = bench::pair_by_likelihood(balls, likelihoods);
    EXPECT_EQ(std::ranges::count(pairing.pairs.back(), likeliest), 1);
  }
}

/// Every node is in one pair, except the root.
void expect_tree(const bench::Pairing& pairing) {
  std::vector<int> uses(pairing.nodes(), 0);
  for (std::size_t i = 0; i < pairing.pairs.size(); ++i) {
    for (const std::uint32_t node : pairing.pairs[i]) {
      ASSERT_LT(node, pairing.balls + i);
      ++uses[node];
    }
  }
  EXPECT_EQ(std::ranges::count(uses, 1), static_cast<std::ptrdiff_t>(pairing.nodes() - 1));
  EXPECT_EQ(uses.back(), 0);
}

TEST(BinaryTrees, EveryBallIsInThem) {
  Random random(3);
  for (const std::size_t count : {1, 2, 5, 64, 301}) {
    const std::vector<Ball> balls = balls_of_tree(random, count, 1, 0.1);
    const std::vector<double> likelihoods = bench::likelihoods_of(balls, 0.1);
    for (const bench::Pairing& pairing :
         {bench::pair_top_down(balls), bench::pair_bottom_up(balls), bench::pair_by_likelihood(balls, likelihoods)}) {
      EXPECT_EQ(pairing.nodes(), 2 * count - 1);
      expect_tree(pairing);
    }
  }
}

/// Two groups far apart: the root has one of them on each side.
TEST(BinaryTrees, TheRootDividesTwoGroups) {
  Random random(4);
  std::vector<Ball> balls = balls_of_tree(random, 40, 1, 0.1);
  for (std::size_t i = 0; i < balls.size(); i += 2) balls[i].centre[1] += 20;
  for (const bench::Pairing& pairing : {bench::pair_top_down(balls), bench::pair_bottom_up(balls)}) {
    const bench::BinaryTree<bench::BoundingBall> tree(balls, pairing);
    for (const std::uint32_t node : tree.node(tree.root()).below) EXPECT_LT(tree.node(node).volume.radius, 3);
  }
}

TEST(BoundingBall, HoldsItsBallsTightly) {
  const std::vector<Ball> two = {{{0, 0, 0}, 1}, {{4, 0, 0}, 2}};
  const std::vector<std::uint32_t> both = {0, 1};
  // From x = -1 to 6.
  EXPECT_NEAR(bench::BoundingBall::around(two, both).radius, 3.5, 0.0035);
  Random random(5);
  const std::vector<Ball> balls = balls_of_tree(random, 50, 1, 0.3);
  std::vector<std::uint32_t> all(balls.size());
  std::iota(all.begin(), all.end(), 0u);
  const bench::BoundingBall around = bench::BoundingBall::around(balls, all);
  for (const Ball& ball : balls) {
    EXPECT_LE(length(ball.centre - around.centre) + ball.radius, around.radius + rounding(2));
  }
}

TEST(SweptRectangle, HoldsItsBalls) {
  Random random(6);
  for (const std::size_t count : {1, 2, 3, 10, 100}) {
    std::vector<Ball> balls = balls_of_tree(random, count, 1, 0.2);
    for (Ball& ball : balls) ball.centre[2] *= 0.1;
    std::vector<std::uint32_t> all(count);
    std::iota(all.begin(), all.end(), 0u);
    const bench::SweptRectangle swept = bench::SweptRectangle::around(balls, all);
    for (const Ball& ball : balls) {
      EXPECT_LE(bench::distance_to_rectangle(swept, ball.centre) + ball.radius, swept.radius + rounding(2));
    }
    EXPECT_GT(swept.volume(), 0);
  }
}

// The balls of a flat grid: the radius is theirs, and the rectangle joins the outer centres.
TEST(SweptRectangle, OfAFlatGridIsTheLeast) {
  std::vector<Ball> balls;
  for (int i = 0; i < 12; ++i) balls.push_back({{1.0 * (i % 4), 1.5 * (i / 4), 7}, 0.25});
  std::vector<std::uint32_t> all(balls.size());
  std::iota(all.begin(), all.end(), 0u);
  const bench::SweptRectangle swept = bench::SweptRectangle::around(balls, all);
  EXPECT_NEAR(swept.radius, 0.25, 1e-12);
  EXPECT_NEAR(std::min(swept.sides[0], swept.sides[1]), 3, 1e-12);
  EXPECT_NEAR(std::max(swept.sides[0], swept.sides[1]), 3, 1e-12);
}

bench::SweptRectangle any_rectangle(Random& random, double size) {
  bench::SweptRectangle rectangle;
  const Pose pose = any_pose(random, point_in_cube(random, 0.2 * size));
  for (std::size_t k = 0; k < 3; ++k) rectangle.axes[k] = pose.rotation[k];
  rectangle.corner = pose.shift;
  rectangle.sides = {uniform(random, 0, size), uniform(random, 0, size)};
  return rectangle;
}

Pose inverse_of(const Pose& pose) {
  Pose inverse;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) inverse.rotation[i][j] = pose.rotation[j][i];
  }
  inverse.shift = -1 * (inverse * pose.shift);
  return inverse;
}

Point point_of_rectangle(const bench::SweptRectangle& r, double s, double t) {
  return r.corner + s * r.sides[0] * r.axes[0] + t * r.sides[1] * r.axes[1];
}

/// By alternating projections from many starts: each step moves to the nearest point of the other rectangle. For two
/// convex sets the distances fall to the least one.
double distance_by_projections(const bench::SweptRectangle& a, const bench::SweptRectangle& b, const Pose& pose) {
  bench::SweptRectangle there = b;
  there.corner = pose * b.corner;
  for (Point& axis : there.axes) axis = Pose{pose.rotation, {0, 0, 0}} * axis;
  const auto nearest = [](const bench::SweptRectangle& r, const Point& p) {
    const Point from = p - r.corner;
    const double s = std::clamp(dot(r.axes[0], from), 0.0, r.sides[0]);
    const double t = std::clamp(dot(r.axes[1], from), 0.0, r.sides[1]);
    return r.corner + s * r.axes[0] + t * r.axes[1];
  };
  Point p = point_of_rectangle(a, 0.5, 0.5);
  double last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 20000; ++i) {
    const Point q = nearest(there, p);
    p = nearest(a, q);
    const double now = length(p - q);
    if (last - now < 1e-17) break;
    last = now;
  }
  return last;
}

TEST(RectangleDistance, IsTheLeastOfAllPoints) {
  Random random(7);
  int meeting = 0;
  for (int i = 0; i < 3000; ++i) {
    const double size = i % 2 == 0 ? 1 : 3;
    const bench::SweptRectangle a = any_rectangle(random, size), b = any_rectangle(random, 1);
    const Pose pose = any_pose(random, point_in_cube(random, 0.5));
    const double found = bench::distance_of_rectangles(a, b, pose);
    EXPECT_NEAR(bench::distance_of_rectangles(b, a, inverse_of(pose)), found, rounding(30));
    // Projections come down to the distance slowly where rectangles meet at a small angle.
    const double expected = distance_by_projections(a, b, pose);
    EXPECT_LE(found, expected + rounding(30));
    EXPECT_NEAR(found, expected, 1e-3);
    meeting += found == 0 || found < rounding(30);
  }
  EXPECT_GT(meeting, 50);
  EXPECT_LT(meeting, 2500);
}

TEST(RectangleDistance, OfKnownCases) {
  bench::SweptRectangle square;
  square.sides = {2, 2};
  const auto distance = [&](const Pose& pose) { return bench::distance_of_rectangles(square, square, pose); };
  EXPECT_NEAR(distance({}), 0, 1e-15);
  EXPECT_NEAR(distance(make_pose({0.5, 0.5, 3}, {0, 0, 0})), 3, 1e-15);       // one above the other
  EXPECT_NEAR(distance(make_pose({5, 6, 0}, {0, 0, 0})), 5, 1e-15);           // corner to corner
  EXPECT_NEAR(distance(make_pose({1, 1, -1}, {0, -1.5707963, 0})), 0, 1e-7);  // one through the other
  EXPECT_NEAR(distance(make_pose({4, 1, -1}, {0, -1.5707963, 0})), 2, 1e-7);  // edge to face
  bench::SweptRectangle point, line;
  point.corner = {1, 1, 4};
  line.sides = {3, 0};
  EXPECT_NEAR(bench::distance_of_rectangles(square, point, {}), 4, 1e-15);
  EXPECT_NEAR(bench::distance_of_rectangles(point, point, {}), 0, 1e-15);
  EXPECT_NEAR(bench::distance_of_rectangles(line, point, {}), std::sqrt(17), 1e-15);
}

}  // namespace
}  // namespace medial_vk
