// Bad input, and sites that touch, overlap or hold one another.
#include <gtest/gtest.h>

#include <limits>
#include <stop_token>

#include "base/point_ops.h"
#include "medial_vk/site_voronoi.h"
#include "support/site_voronoi/arrangements.h"
#include "support/site_voronoi/site_sampler.h"
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
            "site 0 has a coordinate that is not finite, or beyond 1e75");
  EXPECT_EQ(message_of(find_at({site_of_segment({0, 0, 0}, {1e76, 0, 0}), site_of_point({0, 0, 0})}, 10)),
            "site 0 has a coordinate that is not finite, or beyond 1e75");
  EXPECT_EQ(message_of(find_at({site_of_point({0, 0, 0}), site_of_segment({1, 0, 0}, {0, 1, 0}),
                                site_of_segment({0, 1, 0}, {1, 0, 0})},
                               10)),
            "sites 1 and 2 have the same elements");
  EXPECT_EQ(message_of(find_at({site_of_point({1e9, 0, 0}), site_of_point({1e9 + 1e-6, 0, 0})}, 1000)),
            "the sites are too small for the size of their coordinates");
  EXPECT_EQ(message_of(find_at({site_of_point({0, 0, 0}), site_of_point({1e-170, 0, 0})}, 10)),
            "the sites are too small: the longest side of the box around them is below 1e-70");
}

TEST(SiteInputs, TheSmallestAndTheLargestScalesHaveASurface) {
  for (const double scale : {2e-70, 1.0, 9e74}) {
    const Result<SiteVoronoi> found = find_at({site_of_point({0, 0, 0}), site_of_point({scale, 0, 0})}, 10);
    ASSERT_TRUE(found.ok()) << found.error().message;
    ASSERT_EQ(found.value().pieces.size(), 1u);
    // The plane between both points, without half a voxel to a whole one at each end of the grid.
    const SiteGrid& grid = found.value().grid;
    EXPECT_GT(found.value().pieces[0].area / grid.side / grid.side, (grid.size[1] - 2.0) * (grid.size[2] - 2.0));
    EXPECT_LT(found.value().pieces[0].area / grid.side / grid.side, 1.0 * grid.size[1] * grid.size[2]);
    EXPECT_TRUE(found.value().tied.empty());
  }
}

TEST(SiteInputs, OptionsOutOfRangeAreRefused) {
  const std::vector<VoronoiSite> sites = {site_of_point({0, 0, 0}), site_of_point({1, 0, 0})};
  for (const std::uint32_t resolution : {0u, 2049u}) {
    const Result<SiteVoronoi> found = find_at(sites, resolution);
    ASSERT_FALSE(found.ok());
    EXPECT_EQ(found.error().code, ErrorCode::kUsage);
  }
  SiteVoronoiOptions options;
  for (const double margin : {-1.0, 1e76, std::numeric_limits<double>::infinity()}) {
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

/// One tile, so that only voxels and the steps after the search can notice it.
TEST(SiteInputs, AStopEndsTheSearchOfATile) {
  const std::vector<VoronoiSite> sites = {site_of_point({0, 0, 0}), site_of_point({1, 0, 0})};
  SiteVoronoiOptions options;
  options.resolution = 8;
  std::stop_source stop;
  const auto at_end = [&](double done) {
    EXPECT_EQ(done, 1);
    stop.request_stop();
  };
  const Result<SiteVoronoi> found = find_site_voronoi(sites, options, at_end, stop.get_token());
  ASSERT_FALSE(found.ok());
  EXPECT_EQ(found.error().code, ErrorCode::kInterrupted);
}

/// A bound by counts: without the budget of tiles, 4,000 cells for each of 6,000 voxels.
TEST(SiteInputs, SitesThatNearlyCoincideHaveABudget) {
  const Mesh ball = make_sphere(1, 512);
  const std::vector<VoronoiSite> sites = {site_of_mesh(ball), site_of_mesh(moved(ball, {0.001, 0, 0}))};
  const Result<SiteVoronoi> found = find_at(sites, 10), other = find_at(sites, 10, 1);
  ASSERT_TRUE(found.ok() && other.ok());
  const std::array<std::uint32_t, 3>& size = found.value().grid.size;
  const std::uint64_t voxels = std::uint64_t{size[0]} * size[1] * size[2];
  // Of a tile of n voxels: n of its voxels, at most n / 7 + 5 larger cubes, and 4,000 + 72 n divisions, with the last
  // ones of each voxel, which are begun below the bound: at most 8 for each of six levels.
  EXPECT_LT(found.value().cells, 8 * (4000 + 8) + (72 + 48 + 2) * voxels);
  EXPECT_EQ(found.value().cells, other.value().cells);
  EXPECT_EQ(found.value().undecided, other.value().undecided);
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

/// Whether all samples outside of both solids are found.
void expect_all_found(const std::vector<VoronoiSite>& sites, const SiteVoronoi& voronoi, int chords) {
  SiteSampler sampler(sites, voronoi.grid, 5);
  const SampledVoxels voxels(voronoi);
  std::size_t outside = 0, inside = 0;
  for (int i = 0; i < chords; ++i) {
    const std::optional<SiteSample> sample = sampler.next();
    if (!sample || sample->object_angle < 0x1p-12) continue;
    ++(sample->is_inside ? inside : outside);
    if (sample->is_inside) continue;
    EXPECT_EQ(voxels.state_of(*sample), SampleState::kFound)
        << "at " << sample->point[0] << ' ' << sample->point[1] << ' ' << sample->point[2];
  }
  EXPECT_GT(outside, 500u);
  EXPECT_GT(inside, 500u);
}

TEST(SiteInputs, TheSurfaceBeginsAtTheRimOfSolidsThatOverlap) {
  const std::vector<VoronoiSite> sites = {site_of_mesh(moved(make_box({2, 2, 2}), {-1, -1, -1})),
                                          site_of_mesh(moved(make_box({2, 2, 2}), {0.2, -0.4, -0.6}))};
  const Result<SiteVoronoi> found = find_at(sites, 40);
  ASSERT_TRUE(found.ok());
  expect_all_found(sites, found.value(), 40000);
  EXPECT_EQ(found.value().overlaps, (std::vector<std::array<std::uint32_t, 2>>{{0, 1}}));
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
