// Polygons become triangles that cover them once, for any shape, and use all their corners.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "base/point_ops.h"
#include "input/polygon_soup.h"

namespace medial_vk {
namespace {

constexpr std::int64_t kPlenty = 1'000'000'000;

using Outline = std::vector<std::array<double, 2>>;

/// The outline in a tilted plane of 3-space.
std::vector<Point> lift(const Outline& outline, double tilt) {
  const double c = std::cos(tilt), s = std::sin(tilt);
  std::vector<Point> points;
  for (const auto& [x, y] : outline) points.push_back({c * x - s * y * 0.6, s * x + c * y * 0.6, 0.8 * y});
  return points;
}

double area_of(const Outline& outline) {
  double twice = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto &a = outline[i], &b = outline[(i + 1) % outline.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return twice / 2;
}

/// Area kept, n - 2 triangles (so every corner is used), all oriented as the polygon: they cover it once. And every
/// inner side is used exactly once in each direction.
void expect_covered(const Outline& outline, double tilt, std::size_t repeated = 0) {
  const std::vector<Point> points = lift(outline, tilt);
  std::vector<std::uint32_t> corners(points.size());
  for (std::uint32_t i = 0; i < corners.size(); ++i) corners[i] = i;
  std::vector<Triangle> triangles;
  std::int64_t work = kPlenty;
  ASSERT_TRUE(triangulate_polygon(points, corners.data(), static_cast<std::uint32_t>(corners.size()), work, triangles));
  EXPECT_EQ(triangles.size(), points.size() - 2 - repeated);
  Point normal = {0, 0, 0};
  double sum = 0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const Triangle& t : triangles) {
    const Point area = 0.5 * cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
    normal = normal + area;
    sum += length(area);
    EXPECT_GT(length(area), 0);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(++sides[std::pair(t[k], t[(k + 1) % 3])], 1);
  }
  EXPECT_NEAR(sum, std::abs(area_of(outline)), 1e-9 * sum);
  EXPECT_NEAR(length(normal), sum, 1e-9 * sum);
}

void expect_covered_in_all_positions(const Outline& outline) {
  Outline turned = outline;
  for (std::size_t start = 0; start < std::min<std::size_t>(outline.size(), 16); ++start) {
    expect_covered(turned, 0.0);
    expect_covered(turned, 0.4);
    expect_covered(Outline(turned.rbegin(), turned.rend()), 2.5);
    std::rotate(turned.begin(), turned.begin() + 1, turned.end());
  }
}

TEST(Polygon, Quads) {
  expect_covered_in_all_positions({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  expect_covered_in_all_positions({{0, 0}, {4, 0}, {1, 1}, {0, 4}});  // concave: only one diagonal is inside
}

TEST(Polygon, ConcaveShapes) {
  expect_covered_in_all_positions({{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}});  // L
  expect_covered_in_all_positions(
      {{0, 0}, {6, 0}, {6, 3}, {5, 3}, {5, 1}, {4, 1}, {4, 3}, {3, 3}, {3, 1}, {1, 1}, {1, 3}, {0, 3}});
  Outline star;
  for (int i = 0; i < 14; ++i) {
    const double r = i % 2 == 0 ? 3 : 0.7, phi = std::numbers::pi * i / 7;
    star.push_back({r * std::cos(phi), r * std::sin(phi)});
  }
  expect_covered_in_all_positions(star);
  Outline spiral;
  for (int i = 0; i <= 60; ++i)
    spiral.push_back({(1 + i * 0.1) * std::cos(i * 0.3), (1 + i * 0.1) * std::sin(i * 0.3)});
  for (int i = 60; i >= 0; --i)
    spiral.push_back({(1.3 + i * 0.1) * std::cos(i * 0.3), (1.3 + i * 0.1) * std::sin(i * 0.3)});
  expect_covered_in_all_positions(spiral);
}

TEST(Polygon, CornersOnStraightSides) {
  expect_covered({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 3}, {2, 3}, {1, 3}, {0, 3}, {0, 2}, {0, 1}}, 0.0);
  expect_covered({{0, 0}, {1, 0}, {2, 0}, {0, 2}}, 0.0);
  expect_covered({{0, 0}, {1, 0}, {2, 0}, {1, 1}, {0, 2}, {0, 1}}, 0.0);
}

TEST(Polygon, RepeatedPointsAreSkipped) {
  expect_covered({{0, 0}, {0, 0}, {1, 0}, {1, 1}, {1, 1}, {1, 1}, {0, 1}, {0, 0}}, 0.3, 4);
}

TEST(Polygon, BridgeToAHole) {
  // A square with a square hole, joined by a bridge that is walked both ways.
  expect_covered_in_all_positions({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}});
}

TEST(Polygon, SidesThatCrossGiveAFan) {
  const std::vector<Point> points = lift({{0, 0}, {2, 2}, {2, 0}, {0, 1}}, 0.2);
  const std::vector<Point> bow = lift({{0, 0}, {1, 1}, {1, 0}, {0, 1}}, 0.2);  // both halves cancel
  for (const auto& p : {points, bow}) {
    const std::uint32_t corners[] = {0, 1, 2, 3};
    std::vector<Triangle> triangles;
    std::int64_t work = kPlenty;
    EXPECT_FALSE(triangulate_polygon(p, corners, 4, work, triangles));
    EXPECT_EQ(triangles.size(), 2u);
  }
  PolygonSoup soup;
  soup.vertices = points;
  soup.corners = {0, 1, 2, 3, 0, 1, 2, 0, 1};
  soup.sizes = {4, 3, 2, 0};
  const Mesh mesh = triangulate(std::move(soup));
  EXPECT_EQ(mesh.fallback_polygons, 1u);
  EXPECT_EQ(mesh.short_polygons, 2u);
  EXPECT_EQ(mesh.triangles.size(), 3u);
}

TEST(Polygon, WildOnesEndAndStayInRange) {
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    std::vector<Point> points(3 + random() % 80);
    for (Point& p : points) {  // few positions: many coincide, lie on lines, cross
      for (double& x : p) x = static_cast<double>(random() % 5);
    }
    if (i % 10 == 0) points[0] = {1e300, -1e308, 1e308};
    std::vector<std::uint32_t> corners(points.size());
    for (std::uint32_t& c : corners) c = static_cast<std::uint32_t>(random() % points.size());
    std::vector<Triangle> triangles;
    std::int64_t work = kPlenty;
    (void)triangulate_polygon(points, corners.data(), static_cast<std::uint32_t>(corners.size()), work, triangles);
    EXPECT_LE(triangles.size(), corners.size());
    for (const Triangle& t : triangles) {
      for (const std::uint32_t v : t) EXPECT_LT(v, points.size());
    }
  }
}

TEST(Polygon, WithoutTimeLeftItBecomesAFan) {
  const std::vector<Point> points = lift({{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}}, 0.2);
  const std::uint32_t corners[] = {0, 1, 2, 3, 4};
  std::vector<Triangle> triangles;
  std::int64_t work = 2;
  EXPECT_FALSE(triangulate_polygon(points, corners, 5, work, triangles));
  EXPECT_EQ(triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
}

TEST(Polygon, LargeOnes) {
  // A comb and a wheel of 20,000 corners: the grid over the corners keeps this far from quadratic.
  Outline comb = {{0, -1}, {10000, -1}};
  for (int i = 9999; i > 0; --i) comb.push_back({static_cast<double>(i), i % 2 == 0 ? 0.0 : 5.0});
  expect_covered(comb, 0.1);
  Outline wheel;
  for (int i = 0; i < 20000; ++i) {
    const double phi = 2 * std::numbers::pi * i / 20000;
    wheel.push_back({std::cos(phi), std::sin(phi)});
  }
  expect_covered(wheel, 0.1);
}

}  // namespace
}  // namespace medial_vk
