// The roadmap of greatest clearance: widths that are proved, and widest paths.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "base/point_ops.h"
#include "medial_vk/site_roadmap.h"
#include "support/site_voronoi/arrangements.h"
#include "support/solids/solids.h"

namespace medial_vk::test {
namespace {

struct Mapped {
  std::vector<VoronoiSite> sites;
  SiteVoronoi voronoi;
  SiteRoadmap roadmap;
};

Mapped map_of(std::vector<VoronoiSite> sites, std::uint32_t resolution) {
  SiteVoronoiOptions options;
  options.resolution = resolution;
  SiteVoronoi voronoi = find_site_voronoi(sites, options).value();
  SiteRoadmap roadmap = SiteRoadmap::build(sites, voronoi).value();
  return {std::move(sites), std::move(voronoi), std::move(roadmap)};
}

double least_distance(const Point& p, const std::vector<VoronoiSite>& sites) {
  long double least = std::numeric_limits<long double>::infinity();
  for (const VoronoiSite& site : sites) least = std::min(least, distance_to_site(p, site));
  return static_cast<double>(least);
}

TEST(SiteRoadmaps, NoPointOfALinkIsNearerThanItsWidth) {
  const Mapped map = map_of(site_arrangements(12)[7].sites, 24);
  std::mt19937 random(3);
  ASSERT_GT(map.roadmap.links().size(), 1000u);
  double least_share = 1;
  for (int i = 0; i < 300; ++i) {
    const std::size_t at = std::uniform_int_distribution<std::size_t>(0, map.roadmap.links().size() - 1)(random);
    const RoadmapLink& link = map.roadmap.links()[at];
    const Point a = map.voronoi.points[link.points[0]].point, b = map.voronoi.points[link.points[1]].point;
    EXPECT_NEAR(link.length, length(b - a), 1e-14);
    EXPECT_GT(link.width, 0);
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= 32; ++k) least = std::min(least, least_distance(a + (k / 32.0) * (b - a), map.sites));
    EXPECT_GE(least, link.width - 1e-15);
    least_share = std::min(least_share, link.width / least);
  }
  // The proof gives away little.
  EXPECT_GT(least_share, 0.95);
}

/// A box as a surface, with both sides.
VoronoiSite shell_of(const Mesh& mesh) {
  VoronoiSite shell;
  for (const auto& [a, b, c] : mesh.triangles) {
    shell.triangles.push_back({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
  }
  return shell;
}

/// Plates across a room, with a gap of 0.4 between them, one of 0.2 above that, and cracks of 0.01 along the walls.
TEST(SiteRoadmaps, TheWidestPathTakesTheWideGap) {
  const std::vector<VoronoiSite> sites = {site_of_mesh(moved(make_box({0.1, 2, 0.8}), {0, -1, -1})),
                                          site_of_mesh(moved(make_box({0.1, 2, 0.8}), {0, -1, 0.2})),
                                          site_of_mesh(moved(make_box({0.1, 2, 0.5}), {0, -1, 1.2})),
                                          shell_of(moved(make_box({2.1, 2.02, 2.72}), {-1, -1.01, -1.01}))};
  const Mapped map = map_of(sites, 40);
  const Point from = {-0.4, 0, 0.3}, to = {0.5, 0.1, -0.2};
  const Result<std::optional<SitePath>> found = map.roadmap.widest_path(from, to);
  ASSERT_TRUE(found.ok()) << found.error().message;
  ASSERT_TRUE(found.value().has_value());
  const SitePath& path = *found.value();
  EXPECT_EQ(path.line.front(), from);
  EXPECT_EQ(path.line.back(), to);
  EXPECT_LE(path.width, 0.2 + 1e-12);
  // No more is lost than a hundredth of the width, and a line between points of the surface at the corners of plates.
  EXPECT_GT(path.width, 0.9 * 0.2);
  double sum = 0;
  for (std::size_t i = 1; i < path.line.size(); ++i) {
    const Point a = path.line[i - 1], b = path.line[i];
    sum += length(b - a);
    for (int k = 0; k <= 16; ++k) {
      const Point at = a + (k / 16.0) * (b - a);
      EXPECT_GE(least_distance(at, sites), path.width - 1e-14);
      EXPECT_TRUE(at[0] <= 0 || at[0] >= 0.1 || std::fabs(at[2]) < 0.2);
    }
  }
  EXPECT_NEAR(path.length, sum, 1e-12);
}

/// Kruskal's tree against a search that widens step by step, on the graph alone.
/// The rounding of distances around a place far away is of that end only: the other one may be near a site.
TEST(SiteRoadmaps, AnEndFarAwayLeavesTheOtherItsRounding) {
  const Mapped map = map_of({site_of_point({0, 0, 0}), site_of_point({1, 0, 0})}, 12);
  const Point near_site = {1e-4, 0, 0}, far_away = {0.5, 1e12, 0};
  const auto there = map.roadmap.widest_path(near_site, far_away), back = map.roadmap.widest_path(far_away, near_site);
  ASSERT_TRUE(there.ok()) << there.error().message;
  ASSERT_TRUE(back.ok()) << back.error().message;
}

TEST(SiteRoadmaps, NoPathOnTheGraphIsWider) {
  const Mapped map = map_of(site_arrangements(12)[2].sites, 16);
  const auto count = static_cast<std::uint32_t>(map.voronoi.points.size());
  std::vector<std::vector<std::pair<std::uint32_t, double>>> links(count);
  for (const RoadmapLink& link : map.roadmap.links()) {
    links[link.points[0]].emplace_back(link.points[1], link.width);
    links[link.points[1]].emplace_back(link.points[0], link.width);
  }
  // Widths of widest paths from the first point to all others, by relaxation until nothing changes.
  std::vector<double> widest(count, 0);
  widest[0] = map.voronoi.points[0].distance;
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (std::uint32_t i = 0; i < count; ++i) {
      for (const auto& [k, width] : links[i]) {
        const double through = std::min(widest[i], width);
        if (through <= widest[k]) continue;
        widest[k] = through;
        has_changed = true;
      }
    }
  }
  for (std::uint32_t k = 1; k < count; k += count / 20) {
    EXPECT_EQ(widest[k] > 0, map.roadmap.component_of_point()[k] == map.roadmap.component_of_point()[0]);
    const auto path = map.roadmap.widest_path(map.voronoi.points[0].point, map.voronoi.points[k].point);
    ASSERT_TRUE(path.ok());
    if (!(widest[k] > 0)) continue;
    ASSERT_TRUE(path.value().has_value());
    // The ends may be joined to the graph by wider lines than links.
    EXPECT_GE(path.value()->width, 0.999 * widest[k]);
  }
}

TEST(SiteRoadmaps, ASiteThatClosesTheWayLeavesNone) {
  // A point in a closed box, and one outside.
  const Mapped map =
      map_of({shell_of(make_box({1, 1, 1})), site_of_point({0.5, 0.5, 0.5}), site_of_point({1.5, 0.5, 0.5})}, 30);
  EXPECT_GE(map.roadmap.components(), 2u);
  const auto path = map.roadmap.widest_path({0.2, 0.2, 0.2}, {1.3, 0.8, 0.8});
  ASSERT_TRUE(path.ok());
  EXPECT_FALSE(path.value().has_value());
}

TEST(SiteRoadmaps, PlacesThatSitesHideAreJoinedByWaysAround) {
  // In open space, straight behind two boxes, which hide all points of the surface between them.
  const Mapped map =
      map_of({site_of_mesh(make_box({1, 1, 1})), site_of_mesh(moved(make_box({1, 1, 1}), {3, 0, 0}))}, 24);
  const std::array<std::array<Point, 2>, 3> ends = {{{Point{-2, 0.5, 0.5}, Point{6, 0.5, 0.5}},
                                                     {Point{-2, 0, 0}, Point{5, 0, 0}},
                                                     {Point{-0.3, 0.5, 0.5}, Point{2, 1, 1}}}};
  for (const auto& [from, to] : ends) {
    const auto path = map.roadmap.widest_path(from, to);
    ASSERT_TRUE(path.ok()) << path.error().message;
    ASSERT_TRUE(path.value().has_value()) << "from " << from[0];
    EXPECT_EQ(path.value()->line.front(), from);
    EXPECT_EQ(path.value()->line.back(), to);
    EXPECT_GT(path.value()->width, 0);
    for (std::size_t i = 1; i < path.value()->line.size(); ++i) {
      const Point a = path.value()->line[i - 1], b = path.value()->line[i];
      for (int k = 0; k <= 16; ++k) {
        EXPECT_GE(least_distance(a + (k / 16.0) * (b - a), map.sites), path.value()->width - 1e-13);
      }
    }
  }
}

TEST(SiteRoadmaps, PlacesOnSitesAndInSolidsAreRefused) {
  const Mapped map = map_of({site_of_mesh(make_box({1, 1, 1})), site_of_point({2, 0.5, 0.5})}, 12);
  const Point outside = {1.5, 0.5, 0.5};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Point& bad : {Point{0.5, 0.5, 0.5}, Point{1, 0.5, 0.5}, Point{2, 0.5, 0.5}, Point{nan, 0, 0}}) {
    EXPECT_FALSE(map.roadmap.widest_path(bad, outside).ok());
    EXPECT_FALSE(map.roadmap.widest_path(outside, bad).ok());
    EXPECT_FALSE(check_path_ends(map.sites, bad, outside).ok());
    EXPECT_FALSE(check_path_ends(map.sites, outside, bad).ok());
  }
  EXPECT_TRUE(map.roadmap.widest_path(outside, {1.2, 0.1, 0.1}).ok());
  EXPECT_TRUE(check_path_ends(map.sites, outside, {1.2, 0.1, 0.1}).ok());
}

}  // namespace
}  // namespace medial_vk::test
