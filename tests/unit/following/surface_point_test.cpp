// Points and directions that triangles carry, and the sides of balls.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "following/ball_sides.h"
#include "following/surface/surface_point.h"
#include "medial_vk/prepare.h"
#include "support/indexed.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

class CarriedDirection : public testing::Test {
 protected:
  Point random_point() { return {normal_(random_), normal_(random_), normal_(random_)}; }
  Point random_direction() {
    const Point p = random_point();
    return (1 / length(p)) * p;
  }
  Corners3 random_triangle() { return {random_point(), random_point(), random_point()}; }

  static Point inward_normal(const Corners3& c) {
    const Point area = cross(c[1] - c[0], c[2] - c[0]);
    return (-1 / length(area)) * area;
  }

  std::mt19937_64 random_{11};
  std::normal_distribution<double> normal_;
};

TEST_F(CarriedDirection, TheNormalOfATriangleBecomesItsNewNormal) {
  for (int i = 0; i < 1000; ++i) {
    const Corners3 from = random_triangle(), to = random_triangle();
    const Point carried = carried_direction(inward_normal(from), from, 1, to, 1).value();
    EXPECT_LE(length(carried - inward_normal(to)), 1e-9);
  }
}

TEST_F(CarriedDirection, APlaneThroughAPointStaysThePlaneThroughItsImage) {
  // F^-T of a normal is the normal of the image of a plane under F: products with images of vectors in it are 0.
  for (int i = 0; i < 1000; ++i) {
    const Corners3 from = random_triangle(), to = random_triangle();
    const Point direction = random_direction(), carried = carried_direction(direction, from, 1, to, 1).value();
    const Point in_plane = cross(direction, inward_normal(from));  // in the plane, and in that of the triangle
    // The coordinates of in_plane along the edges.
    const Point ab = from[1] - from[0], ac = from[2] - from[0];
    const double aa = dot(ab, ab), ac_ab = dot(ab, ac), cc = dot(ac, ac), det = aa * cc - ac_ab * ac_ab;
    if (det < 1e-2) continue;
    const double v = (dot(in_plane, ab) * cc - dot(in_plane, ac) * ac_ab) / det;
    const double w = (dot(in_plane, ac) * aa - dot(in_plane, ab) * ac_ab) / det;
    const Point image = v * (to[1] - to[0]) + w * (to[2] - to[0]);
    EXPECT_NEAR(dot(carried, image), 0, 1e-9 * (1 + length(image) / det));
    EXPECT_NEAR(length(carried), 1, 1e-12);
  }
}

TEST_F(CarriedDirection, WithoutAnAreaThereIsNone) {
  const Corners3 flat = {Point{0, 0, 0}, Point{1, 0, 0}, Point{2, 0, 0}};
  const Point direction = random_direction();
  EXPECT_FALSE(carried_direction(direction, random_triangle(), 1, flat, 1));
  EXPECT_FALSE(carried_direction(direction, flat, 1, random_triangle(), 1));
}

TEST_F(CarriedDirection, PointsKeepTheirCoordinates) {
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 1000; ++i) {
    const Corners3 corners = random_triangle();
    const double v = unit(random_), w = (1 - v) * unit(random_);
    const Point p = point_at({0, v, w}, corners);
    EXPECT_LE(length(point_at(surface_point_at(p, 0, corners), corners) - p), 1e-9);
  }
  const std::array<Point, 3> along = {Point{0, 0, 0}, Point{1, 0, 0}, Point{3, 0, 0}};
  for (std::size_t first = 0; first < 3; ++first) {
    const Corners3 line = {along[first], along[(first + 1) % 3], along[(first + 2) % 3]};
    for (const double x : {0.5, 2.0}) {
      EXPECT_LE(length(point_at(surface_point_at({x, 0, 0}, 0, line), line) - Point{x, 0, 0}), 1e-12);
    }
  }
  const Corners3 point = {};
  EXPECT_EQ(point_at(surface_point_at({0, 0, 0}, 0, point), point), (Point{0, 0, 0}));
}

TEST(BallSides, OnePointDecidesForEachComponent) {
  const IndexedMesh mesh = test::indexed(prepare_mesh(test::make_box({8, 1, 1})).value());
  const MovingSurface surface = MovingSurface::build(mesh).value();
  std::vector<Ball> balls;
  for (int i = 0; i < 8; ++i) balls.push_back({{0.75 + 0.5 * i, 0.5, 0.5}, 0.4});
  balls.push_back({{6, 0.5, 0.5}, 0.4});
  balls.push_back({{7.5, 0.5, 0.5}, 0.3});
  BallSides sides = BallSides::build(balls, 1).value();
  std::vector<std::uint8_t> is_inside(balls.size());
  sides.find(surface, balls, is_inside);
  EXPECT_EQ(sides.queries(), 3u);
  EXPECT_EQ(std::ranges::count(is_inside, 1), 10);
  balls[3].radius = 0;  // cuts the row in two
  balls[9].centre[1] = 5;
  sides.find(surface, balls, is_inside);
  EXPECT_EQ(sides.queries(), 4u);
  EXPECT_EQ(is_inside[3], 0);
  EXPECT_EQ(is_inside[9], 0);
  EXPECT_EQ(std::ranges::count(is_inside, 1), 8);
}

}  // namespace
}  // namespace medial_vk
