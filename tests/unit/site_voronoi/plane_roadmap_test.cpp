// The roadmap between sites in the plane: widths that are proved and attained, and widest paths.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "cpu_reference/plane.h"
#include "medial_vk/plane_roadmap.h"

namespace medial_vk::test {
namespace {

using Corners = std::vector<PlanePoint>;

/// Epsilons by which a width is less than the least radius of its arc: 2 by proof, and what a node is beside its arc.
constexpr double kLostOfAWidth = 3;

/// Polygons, each one a site.
PlaneSites sites_of(const std::vector<Corners>& polygons) {
  PlaneSites sites;
  for (std::uint32_t s = 0; s < polygons.size(); ++s) {
    const auto first = static_cast<std::uint32_t>(sites.points.size());
    const auto count = static_cast<std::uint32_t>(polygons[s].size());
    for (std::uint32_t i = 0; i < count; ++i) {
      sites.points.push_back(polygons[s][i]);
      sites.segments.push_back({first + i, first + (i + 1) % count});
    }
    sites.site_of_point.resize(sites.points.size(), s);
    sites.site_of_segment.resize(sites.segments.size(), s);
  }
  return sites;
}

Corners square(double x, double y, double side = 1) {
  return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
}

struct PlaneMap {
  PlaneSites sites;
  PlaneAxis curves;
  PlaneRoadmap roadmap;

  double distance(const PlanePoint& p) const {
    reference::PlaneSegments segments;
    for (const auto& [a, b] : sites.segments) {
      segments.push_back({Eigen::Vector2d(sites.points[a].data()), Eigen::Vector2d(sites.points[b].data())});
    }
    return reference::distance_to_segments(Eigen::Vector2d(p.data()), segments);
  }

  /// The least distance found on a polyline.
  double least_distance(const std::vector<PlanePoint>& line) const {
    double least = distance(line.front());
    for (std::size_t i = 1; i < line.size(); ++i) {
      for (int k = 1; k <= 40; ++k) {
        const double share = k / 40.0;
        least = std::min(least, distance({line[i - 1][0] + share * (line[i][0] - line[i - 1][0]),
                                          line[i - 1][1] + share * (line[i][1] - line[i - 1][1])}));
      }
    }
    return least;
  }
};

PlaneMap map_of(const std::vector<Corners>& polygons) {
  PlaneSites sites = sites_of(polygons);
  PlaneAxis curves = find_plane_voronoi(sites).value();
  PlaneRoadmap roadmap = PlaneRoadmap::build(sites, curves).value();
  return {std::move(sites), std::move(curves), std::move(roadmap)};
}

/// Rotated squares in the cells of a grid, which keep them apart.
std::vector<Corners> scattered(unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&] { return static_cast<double>(random()) * 0x1p-32; };
  std::vector<Corners> polygons;
  for (int x = 0; x < 4; ++x) {
    for (int y = 0; y < 4; ++y) {
      const double middle_x = x + 0.3 * uniform(), middle_y = y + 0.3 * uniform();
      const double radius = 0.1 + 0.2 * uniform(), turn = 6 * uniform();
      Corners corners;
      for (int i = 0; i < 4; ++i) {
        const double angle = turn + 0.5 * 3.14159265358979 * i;
        corners.push_back({middle_x + radius * std::cos(angle), middle_y + radius * std::sin(angle)});
      }
      polygons.push_back(corners);
    }
  }
  return polygons;
}

TEST(PlaneRoadmaps, WidthsOfLinksAreTheLeastDistancesOfTheirArcs) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    const PlaneMap map = map_of(scattered(seed));
    ASSERT_EQ(map.roadmap.links().size(), map.curves.arcs.size());
    for (const PlaneRoadmapLink& link : map.roadmap.links()) {
      const AxisArc& arc = map.curves.arcs[link.arc];
      double least = map.distance(map.curves.nodes[arc.nodes[0]].point);
      for (int k = 0; k <= 200; ++k) {
        least = std::min(least, map.distance(arc.curve.point_at(arc.t[0] + (arc.t[1] - arc.t[0]) * k / 200)));
      }
      EXPECT_LE(link.width, least);
      // Attained, up to the samples: the radius changes by no more than the way, a four-hundredth of the arc.
      EXPECT_GE(link.width, least - link.length / 400 - kLostOfAWidth * map.curves.epsilon);
    }
    // Curves around sites that are apart are connected.
    EXPECT_EQ(map.roadmap.components(), 1u);
  }
}

TEST(PlaneRoadmaps, TheWayThroughAGapIsAsWideAsTheGap) {
  // A square in a room: all gaps are 2 wide, and there is more space in the corners, where the path begins and ends.
  PlaneSites sites = sites_of({{{-3, -3}, {-3, 3}, {3, 3}, {3, -3}}, square(-1, -1, 2)});
  PlaneAxis curves = find_plane_voronoi(sites).value();
  PlaneRoadmap roadmap = PlaneRoadmap::build(sites, curves).value();
  const auto path = roadmap.widest_path({1.8, 1.8}, {-1.8, -1.8}).value();
  ASSERT_TRUE(path.has_value());
  EXPECT_LE(path->width, 1);
  EXPECT_GE(path->width, 1 - 0x1p-10) << "less by a thousandth at most, since parabolas are polylines";
  EXPECT_EQ(path->line.front(), (PlanePoint{1.8, 1.8}));
  EXPECT_EQ(path->line.back(), (PlanePoint{-1.8, -1.8}));
  // Along one side of the room to another corner, and from there along a second one.
  EXPECT_GT(path->length, 2 * 3.6);
  EXPECT_LT(path->length, 2 * 4);
  // Without curves in between the width is exact.
  const auto straight = roadmap.widest_path({2, 0.5}, {2, -0.5}).value();
  ASSERT_TRUE(straight.has_value());
  EXPECT_LE(straight->width, 1);
  EXPECT_GE(straight->width, 1 - kLostOfAWidth * curves.epsilon);
}

TEST(PlaneRoadmaps, AWiderWayAroundIsTaken) {
  const PlaneMap map = map_of({square(0, 0), square(3, 0)});
  const auto path = map.roadmap.widest_path({2, -0.5}, {2, 1.5}).value();
  ASSERT_TRUE(path.has_value());
  // That of both ends; the gap has a width of 1.
  EXPECT_LE(path->width, std::hypot(1, 0.5));
  EXPECT_GE(path->width, std::hypot(1, 0.5) - kLostOfAWidth * map.curves.epsilon);
  EXPECT_GE(map.least_distance(path->line), path->width);
}

TEST(PlaneRoadmaps, OfTwoGapsTheWiderOneIsTaken) {
  // Gaps of 0.5 above and 0.8 below the middle square; the first one is on the shorter way.
  const PlaneMap map = map_of({square(0, -10, 4), square(0, -5.2, 4), square(0, -0.7, 4)});
  const auto path = map.roadmap.widest_path({-0.5, -1}, {4.5, -1}).value();
  ASSERT_TRUE(path.has_value());
  EXPECT_NEAR(path->width, 0.4, 1e-3);
  const auto is_below = [](const PlanePoint& p) { return p[1] < -5; };
  EXPECT_TRUE(std::ranges::any_of(path->line, is_below));
}

TEST(PlaneRoadmaps, NoPointOfAPathIsNearerThanItsWidth) {
  std::mt19937 random(7);
  const auto uniform = [&] { return static_cast<double>(random()) * 0x1p-32; };
  int found = 0;
  for (unsigned seed = 0; seed < 6; ++seed) {
    const PlaneMap map = map_of(scattered(seed));
    const double x = -0.4 - 0.2 * uniform(), y = 3 * uniform();
    const auto path = map.roadmap.widest_path({x, y}, {3.8, 3 - y}).value();
    if (!path) continue;
    ++found;
    EXPECT_GT(path->width, 0);
    EXPECT_GE(map.least_distance(path->line), path->width);
    double length = 0;
    for (std::size_t i = 1; i < path->line.size(); ++i) {
      length += std::hypot(path->line[i][0] - path->line[i - 1][0], path->line[i][1] - path->line[i - 1][1]);
    }
    EXPECT_NEAR(path->length, length, 1e-9);
  }
  EXPECT_GE(found, 5);
}

TEST(PlaneRoadmaps, EndsOnASiteAndNumbersOutOfRangeAreErrors) {
  const PlaneMap map = map_of({square(0, 0), square(3, 0)});
  EXPECT_EQ(map.roadmap.widest_path({1, 0.5}, {2, 2}).error().message, "`from` must be outside of all sites");
  EXPECT_EQ(map.roadmap.widest_path({2, 2}, {INFINITY, 0}).error().code, ErrorCode::kUsage);
  PlaneSites wrong = map.sites;
  wrong.segments[0] = {0, 99};
  EXPECT_EQ(PlaneRoadmap::build(wrong, map.curves).error().code, ErrorCode::kInvalidMesh);
}

}  // namespace
}  // namespace medial_vk::test
