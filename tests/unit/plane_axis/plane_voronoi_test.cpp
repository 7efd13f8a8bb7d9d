// Voronoi diagrams of sites in the plane: against formulas, and against distances by brute force.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "medial_vk/plane_axis.h"

namespace medial_vk::test {
namespace {

PlaneAxis diagram_of(const PlaneSites& sites, double margin = 0) {
  PlaneVoronoiOptions options;
  options.margin = margin;
  Result<PlaneAxis> diagram = find_plane_voronoi(sites, options);
  EXPECT_TRUE(diagram.ok()) << (diagram.ok() ? "" : diagram.error().message);
  return diagram.ok() ? std::move(diagram.value()) : PlaneAxis();
}

void add_point(PlaneSites& sites, PlanePoint p, std::uint32_t site) {
  sites.points.push_back(p);
  sites.site_of_point.push_back(site);
}

void add_segment(PlaneSites& sites, PlanePoint a, PlanePoint b, std::uint32_t site) {
  const auto first = static_cast<std::uint32_t>(sites.points.size());
  add_point(sites, a, site);
  add_point(sites, b, site);
  sites.segments.push_back({first, first + 1});
  sites.site_of_segment.push_back(site);
}

TEST(PlaneVoronoi, OfTwoPointsIsALine) {
  PlaneSites sites;
  add_point(sites, {-1, 0}, 0);
  add_point(sites, {1, 0}, 1);
  const PlaneAxis diagram = diagram_of(sites, 3);
  ASSERT_EQ(diagram.arcs.size(), 1u);
  EXPECT_NEAR(diagram.branches[0].length, 8, 1e-12);  // the square reaches 3 beyond a longest side of 2
  for (const AxisNode& node : diagram.nodes) {
    EXPECT_EQ(node.kind, AxisNodeKind::kBorder);
    EXPECT_NEAR(node.point[0], 0, 1e-12);
  }
}

TEST(PlaneVoronoi, OfThreePointsMeetsInTheCircumcentre) {
  PlaneSites sites;
  add_point(sites, {0, 0}, 0);
  add_point(sites, {6, 0}, 1);
  add_point(sites, {0, 8}, 2);
  const PlaneAxis diagram = diagram_of(sites);
  EXPECT_EQ(diagram.branches.size(), 3u);
  const auto centre = std::ranges::find_if(diagram.nodes, [](const AxisNode& n) { return n.degree == 3; });
  ASSERT_NE(centre, diagram.nodes.end());
  EXPECT_NEAR(std::hypot(centre->point[0] - 3, centre->point[1] - 4), 0, 1e-12);
  EXPECT_NEAR(centre->radius, 5, 1e-12);
}

TEST(PlaneVoronoi, HasNothingBetweenPartsOfOneSite) {
  PlaneSites sites;
  add_point(sites, {0, 0}, 7);
  add_point(sites, {0, 1}, 7);
  add_point(sites, {5, 0.5}, 8);
  const PlaneAxis diagram = diagram_of(sites);
  for (const AxisNode& node : diagram.nodes) EXPECT_GT(node.point[0], 2);
}

/// Each point lies at the distance of its arc from two sites, and no site is nearer; and where the nearest site changes
/// along a line, the diagram is crossed.
TEST(PlaneVoronoi, OfSegmentsIsThatOfTheirDistances) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<> share(0, 1);
  for (int trial = 0; trial < 30; ++trial) {
    SCOPED_TRACE(trial);
    PlaneSites sites;
    for (std::uint32_t s = 0; s < 9; ++s) {  // in cells of their own, so that they do not cross
      const double x = s % 3, y = s / 3;
      const auto anywhere = [&] {
        const double dx = 0.8 * share(random);
        return PlanePoint{x + dx, y + 0.8 * share(random)};
      };
      const PlanePoint from = anywhere();
      add_segment(sites, from, anywhere(), s);
    }
    const auto distance = [&](std::uint32_t s, PlanePoint x) {
      const PlanePoint &a = sites.points[2 * s], &b = sites.points[2 * s + 1];
      const double dx = b[0] - a[0], dy = b[1] - a[1];
      const double t = std::clamp(((x[0] - a[0]) * dx + (x[1] - a[1]) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
      return std::hypot(x[0] - a[0] - t * dx, x[1] - a[1] - t * dy);
    };
    const auto two_nearest = [&](PlanePoint x) {
      std::array<std::pair<double, std::uint32_t>, 9> all;
      for (std::uint32_t s = 0; s < 9; ++s) all[s] = {distance(s, x), s};
      std::ranges::sort(all);
      return std::pair(all[0], all[1]);
    };
    const PlaneAxis diagram = diagram_of(sites);
    double crossings = 0;
    for (const AxisArc& arc : diagram.arcs) {
      for (const double u : {0.2, 0.5, 0.8}) {
        const double t = arc.t[0] + u * (arc.t[1] - arc.t[0]);
        const auto [first, second] = two_nearest(arc.curve.point_at(t));
        EXPECT_NEAR(first.first, arc.curve.radius_at(t), 1e-12);
        EXPECT_NEAR(second.first, arc.curve.radius_at(t), 1e-12);
      }
    }
    for (int k = 0; k < 40; ++k) {
      PlanePoint a = {3 * share(random), 0}, b = {3 * share(random), 0};
      a[1] = 3 * share(random);
      b[1] = 3 * share(random);
      if (two_nearest(a).first.second == two_nearest(b).first.second) continue;
      const std::uint32_t at_a = two_nearest(a).first.second;
      for (int i = 0; i < 60; ++i) {
        const PlanePoint m = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
        (two_nearest(m).first.second == at_a ? a : b) = m;
      }
      double best = std::numeric_limits<double>::infinity();
      for (const AxisArc& arc : diagram.arcs) {
        for (int i = 0; i <= 400; ++i) {
          const PlanePoint x = arc.curve.point_at(arc.t[0] + (arc.t[1] - arc.t[0]) * i / 400);
          best = std::min(best, std::hypot(x[0] - a[0], x[1] - a[1]));
        }
      }
      EXPECT_LT(best, 0.01);  // an arc is at most 4 long, and 400 steps are at most 0.01 apart
      ++crossings;
    }
    EXPECT_GT(crossings, 10);
  }
}

double turn(PlanePoint a, PlanePoint b, PlanePoint c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Of two segments in general position.
bool cross(const PlaneSites& sites, std::size_t i, std::size_t k) {
  const PlanePoint a = sites.points[sites.segments[i][0]], b = sites.points[sites.segments[i][1]];
  const PlanePoint c = sites.points[sites.segments[k][0]], d = sites.points[sites.segments[k][1]];
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

TEST(PlaneVoronoi, SitesThatCrossAreRefused) {
  std::mt19937 random(3);
  const auto uniform = [&] { return static_cast<double>(random()) * 0x1p-32; };
  int refused = 0;
  for (int trial = 0; trial < 60; ++trial) {
    PlaneSites sites;
    std::vector<std::string> crossing;
    for (std::uint32_t site = 0; site < 12; ++site) {
      const double x = 5 * uniform(), y = 5 * uniform(), along = uniform(), up = uniform();
      add_segment(sites, {x, y}, {x + along, y + up - 0.5}, site);
    }
    for (std::size_t i = 0; i < sites.segments.size(); ++i) {
      for (std::size_t k = i + 1; k < sites.segments.size(); ++k) {
        if (!cross(sites, i, k)) continue;
        crossing.push_back("sites " + std::to_string(i) + " and " + std::to_string(k) +
                           " cross or touch; sites in the plane must be apart");
      }
    }
    const Result<PlaneAxis> diagram = find_plane_voronoi(sites);
    ASSERT_EQ(diagram.ok(), crossing.empty()) << "trial " << trial;
    if (diagram.ok()) continue;
    ++refused;
    EXPECT_EQ(diagram.error().code, ErrorCode::kInvalidMesh);
    EXPECT_NE(std::ranges::find(crossing, diagram.error().message), crossing.end()) << diagram.error().message;
  }
  EXPECT_TRUE(10 < refused && refused < 50) << refused;
}

TEST(PlaneVoronoi, ALineMayCrossItself) {
  PlaneSites sites;
  add_segment(sites, {0, 0}, {2, 2}, 0);
  add_segment(sites, {0, 2}, {2, 0}, 0);
  add_point(sites, {5, 1}, 1);
  const PlaneAxis diagram = diagram_of(sites);
  ASSERT_FALSE(diagram.arcs.empty());
  for (const AxisNode& node : diagram.nodes) {
    EXPECT_NEAR(std::hypot(node.point[0] - 5, node.point[1] - 1), node.radius, 1e-9);
  }
}

// So many boxes overlap that cells find what meets.
TEST(PlaneVoronoi, SitesThatTouchAmongThousandsOfLongOnesAreRefused) {
  PlaneSites sites;
  constexpr std::uint32_t kRays = 1 << 14;
  for (std::uint32_t i = 0; i < kRays; ++i) {
    const double angle = 6.283 * i / kRays;
    add_segment(sites, {std::cos(angle), std::sin(angle)}, {3 * std::cos(angle), 3 * std::sin(angle)}, i);
  }
  sites.points.push_back({2, 0});  // on the first ray
  sites.site_of_point.push_back(kRays);
  EXPECT_EQ(find_plane_voronoi(sites).error().message,
            "sites 0 and " + std::to_string(kRays) + " cross or touch; sites in the plane must be apart");
  sites.points.back() = {0, 0};
  EXPECT_TRUE(find_plane_voronoi(sites).ok());
}

TEST(PlaneVoronoi, BadSitesAreRefused) {
  PlaneSites sites;
  add_point(sites, {0, 0}, 0);
  EXPECT_EQ(find_plane_voronoi(sites).error().message, "at least two sites are needed");
  add_segment(sites, {1, 1}, {1, 1}, 1);
  EXPECT_EQ(find_plane_voronoi(sites).error().message, "segment 0 has no length");
  sites.segments[0] = {1, 9};
  EXPECT_EQ(find_plane_voronoi(sites).error().message, "segment 0 uses an index out of range");
  sites.site_of_segment.clear();
  EXPECT_EQ(find_plane_voronoi(sites).error().code, ErrorCode::kUsage);
}

}  // namespace
}  // namespace medial_vk::test
