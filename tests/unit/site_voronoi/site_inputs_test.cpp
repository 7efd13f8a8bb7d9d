// Bad input, and sites that touch, overlap or hold one another.
#include <gtest/gtest.h>

#include <limits>
#include <stop_token>

#include "base/point_ops.h"
#include "medial_vk/site_voronoi.h"
#include "support/site_voronoi/arrangements.h"
#include "support/solids/solids.h"

namespace medial_vk::test {
namespace {

Result<SiteVoronoi> find_at(const std::vector<VoronoiSite>& sites, std::uint32_t resolution, unsigned threads = 0) {
  SiteVoronoiOptions options;
  options.resolution = resolution;
  options.threads = threads;
  return find_site_voronoi(sites, options);
}

std::string message_of(const Result<SiteVoronoi>& result) { return result.ok() ? "" : result.error().message; }

TEST(SiteInputs, FewerThanTwoSitesAreRefused) {
  EXPECT_EQ(message_of(find_at({}, 10)), "there are fewer than two sites");
  EXPECT_EQ(message_of(find_at({site_of_point({0, 0, 0})}, 10)), "there are fewer than two sites");
}

TEST(SiteInputs, EmptyInfiniteAndEqualSitesAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message_of(find_at({site_of_point({0, 0, 0}), VoronoiSite()}, 10)), "site 1 has no element");
  EXPECT_EQ(message_of(find_at({site_of_point({0, nan, 0}), site_of_point({0, 0, 0})}, 10)),
            "site 0 has a coordinate that is not finite, or beyond 1e150");
  EXPECT_EQ(message_of(find_at({site_of_segment({0, 0, 0}, {1e151, 0, 0}), site_of_point({0, 0, 0})}, 10)),
            "site 0 has a coordinate that is not finite, or beyond 1e150");
  EXPECT_EQ(message_of(find_at({site_of_point({0, 0, 0}), site_of_segment({1, 0, 0}, {0, 1, 0}),
                                site_of_segment({0, 1, 0}, {1, 0, 0})},
                               10)),
            "sites 1 and 2 have the same elements");
  EXPECT_EQ(message_of(find_at({site_of_point({1e9, 0, 0}), site_of_point({1e9 + 1e-6, 0, 0})}, 1000)),
            "the sites are too small for the size of their coordinates");
}

TEST(SiteInputs, OptionsOutOfRangeAreRefused) {
  const std::vector<VoronoiSite> sites = {site_of_point({0, 0, 0}), site_of_point({1, 0, 0})};
  for (const std::uint32_t resolution : {0u, 2049u}) {
    const Result<SiteVoronoi> found = find_at(sites, resolution);
    ASSERT_FALSE(found.ok());
    EXPECT_EQ(found.error().code, ErrorCode::kUsage);
  }
  SiteVoronoiOptions options;
  for (const double margin : {-1.0, std::numeric_limits<double>::infinity()}) {
    options.margin = margin;
    EXPECT_FALSE(find_site_voronoi(sites, options).ok());
  }
}

TEST(SiteInputs, AStopEndsTheSearch) {
  std::stop_source stop;
  stop.request_stop();
  const Result<SiteVoronoi> found = find_site_voronoi(
      std::vector<VoronoiSite>{site_of_point({0, 0, 0}), site_of_point({1, 0, 0})}, {}, {}, stop.get_token());
  ASSERT_FALSE(found.ok());
  EXPECT_EQ(found.error().code, ErrorCode::kInterrupted);
}

TEST(SiteInputs, ThreadsDoNotChangeTheResult) {
  const std::vector<VoronoiSite> sites = site_arrangements(16)[7].sites;
  const Result<SiteVoronoi> one = find_at(sites, 30, 1), four = find_at(sites, 30, 4);
  ASSERT_TRUE(one.ok() && four.ok());
  ASSERT_EQ(one.value().points.size(), four.value().points.size());
  for (std::size_t i = 0; i < one.value().points.size(); ++i) {
    EXPECT_EQ(one.value().points[i].point, four.value().points[i].point);
    EXPECT_EQ(one.value().points[i].sites, four.value().points[i].sites);
  }
  ASSERT_EQ(one.value().faces.size(), four.value().faces.size());
  for (std::size_t i = 0; i < one.value().faces.size(); ++i) {
    EXPECT_EQ(one.value().faces[i].corners, four.value().faces[i].corners);
  }
}

TEST(SiteInputs, PointsInsideOfSolidsAreNone) {
  // A ball in a larger one: between them is the inside of the larger one, where no point is.
  const std::vector<VoronoiSite> nested = {site_of_mesh(make_sphere(1, 320)), site_of_mesh(make_sphere(0.5, 320))};
  const Result<SiteVoronoi> found = find_at(nested, 20);
  ASSERT_TRUE(found.ok());
  EXPECT_TRUE(found.value().points.empty());
  EXPECT_GT(found.value().overlapping.size(), 100u);
  ASSERT_EQ(found.value().overlaps.size(), 1u);
  EXPECT_EQ(found.value().overlaps[0], (std::array<std::uint32_t, 2>{0, 1}));
  // As surfaces, they have one between them.
  std::vector<VoronoiSite> surfaces(2);
  for (std::size_t s = 0; s < 2; ++s) surfaces[s].triangles = elements_of_site(nested[s]);
  const Result<SiteVoronoi> between = find_at(surfaces, 20);
  ASSERT_TRUE(between.ok());
  EXPECT_GT(between.value().points.size(), 100u);
  // The polyhedra are between balls of radius r and r q, and so is the surface half way.
  const double q = inner_radius(make_sphere(1, 320));
  for (const SitePoint& p : between.value().points) {
    EXPECT_LE(length(p.point), 0.75 + 1e-12);
    EXPECT_GE(length(p.point), 0.75 * q - 1e-12);
  }
}

TEST(SiteInputs, SolidsThatOverlapHaveTheSurfaceOutsideOfBoth) {
  const std::vector<VoronoiSite> sites = {site_of_mesh(make_box({1, 1, 1})),
                                          site_of_mesh(moved(make_box({1, 1, 1}), {0.6, 0.3, 0.2}))};
  const Result<SiteVoronoi> found = find_at(sites, 24);
  ASSERT_TRUE(found.ok());
  EXPECT_EQ(found.value().overlaps.size(), 1u);
  EXPECT_GT(found.value().points.size(), 100u);
  for (const SitePoint& p : found.value().points) {
    const auto is_inside = [&](const Point& lower) {
      const Point off = p.point - lower;
      return std::ranges::all_of(off, [](double x) { return x > 0 && x < 1; });
    };
    EXPECT_FALSE(is_inside({0, 0, 0}) || is_inside({0.6, 0.3, 0.2}));
  }
}

TEST(SiteInputs, WhereSitesShareAPointItIsNoContactOfTwo) {
  // Two segments with a common end: behind it, a part of space is nearest to that end, and belongs to no surface.
  const std::vector<VoronoiSite> sites = {site_of_segment({0, 0, 0}, {1, 0, 0}), site_of_segment({0, 0, 0}, {0, 1, 0})};
  const Result<SiteVoronoi> found = find_at(sites, 40);
  ASSERT_TRUE(found.ok());
  EXPECT_GT(found.value().tied.size(), 0u);
  EXPECT_GT(found.value().points.size(), 100u);
  for (const SitePoint& p : found.value().points) {
    EXPECT_NEAR(p.point[0], p.point[1], 1e-12);
    EXPECT_GT(p.point[0], 0);
  }
}

}  // namespace
}  // namespace medial_vk::test
