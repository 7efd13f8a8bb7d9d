// Surfaces between sites that are known by formulas.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/point_ops.h"
#include "medial_vk/site_voronoi.h"
#include "support/site_voronoi/arrangements.h"
#include "support/solids/solids.h"

namespace medial_vk::test {
namespace {

SiteVoronoi surface_of(const std::vector<VoronoiSite>& sites, std::uint32_t resolution, double margin = 0) {
  SiteVoronoiOptions options;
  options.resolution = resolution;
  options.margin = margin;
  Result<SiteVoronoi> voronoi = find_site_voronoi(sites, options);
  EXPECT_TRUE(voronoi.ok()) << (voronoi.ok() ? "" : voronoi.error().message);
  return voronoi.ok() ? std::move(voronoi).value() : SiteVoronoi();
}

/// The extent of the grid along an axis.
double extent(const SiteGrid& grid, std::size_t axis) { return grid.size[axis] * grid.side; }

TEST(SiteSurfaces, OfTwoPointsAreThePlaneBetweenThem) {
  const SiteVoronoi found = surface_of({site_of_point({-1, 0.5, 0}), site_of_point({3, 0.5, 0})}, 40, 3);
  // A voxel for each one of the layer that the plane x = 1 passes, and a face for each inner edge across it.
  EXPECT_EQ(found.points.size(), std::size_t{found.grid.size[1]} * found.grid.size[2]);
  EXPECT_EQ(found.faces.size(), std::size_t{found.grid.size[1] - 1} * (found.grid.size[2] - 1));
  EXPECT_TRUE(found.undecided.empty());
  for (const SitePoint& p : found.points) {
    EXPECT_NEAR(p.point[0], 1, 1e-14);
    EXPECT_NEAR(p.distance, std::sqrt(4 + std::pow(p.point[1] - 0.5, 2) + std::pow(p.point[2], 2)), 1e-14);
    EXPECT_NEAR(p.object_angle, std::asin(2 / p.distance), 1e-12);
    EXPECT_LE(length(p.contacts[0] - Point{-1, 0.5, 0}), p.error);
    EXPECT_LE(length(p.contacts[1] - Point{3, 0.5, 0}), p.error);
  }
  // Faces reach into the outermost voxels and not beyond them, and fill the plane between without overlap.
  ASSERT_EQ(found.pieces.size(), 1u);
  EXPECT_LT(found.pieces[0].area, extent(found.grid, 1) * extent(found.grid, 2));
  EXPECT_GT(found.pieces[0].area,
            (extent(found.grid, 1) - 2 * found.grid.side) * (extent(found.grid, 2) - 2 * found.grid.side));
  for (const SiteFace& face : found.faces) {
    const auto at = [&](std::size_t i) { return found.points[face.corners[i]].point; };
    EXPECT_GT(cross(at(1) - at(0), at(2) - at(0))[0], 0)
        << "a face that does not look from its first site to its second";
  }
}

TEST(SiteSurfaces, OfAPointAndASegmentAreAParabolicCylinderAndMore) {
  // Where the segment is nearest by its inside, y^2 + z^2 = x^2 + y^2 + (z - 1)^2. Distances that differ by e have
  // squares that differ by 2 e d.
  const SiteVoronoi found = surface_of({site_of_segment({-5, 0, 0}, {5, 0, 0}), site_of_point({0, 0, 1})}, 60, 4);
  std::size_t beside = 0;
  for (const SitePoint& p : found.points) {
    const auto [x, y, z] = p.point;
    if (std::fabs(x) > 5) continue;
    ++beside;
    EXPECT_NEAR(z, (x * x + 1) / 2, 1.01 * p.error * p.distance);
    EXPECT_NEAR(p.distance, std::hypot(y, z), p.error);
    EXPECT_NEAR(p.contacts[0][0], x, 1e-13);
  }
  EXPECT_GT(beside, 500u);
}

/// A ball of radius r, as a polyhedron between it and a smaller one, and a point at distance a from its centre: a
/// hyperboloid of two sheets, where the distances from the centre and from the point differ by r.
TEST(SiteSurfaces, OfABallAndAPointAreAHyperboloid) {
  const double r = 0.8;
  const Mesh ball = make_sphere(r, 5000);
  const double inner = inner_radius(ball);
  const Point at = {2, 0.3, -0.2};
  const SiteVoronoi found = surface_of({site_of_mesh(ball), site_of_point(at)}, 50, 1);
  EXPECT_GT(found.points.size(), 1000u);
  for (const SitePoint& p : found.points) {
    const double difference = length(p.point) - length(p.point - at);
    EXPECT_GE(difference, inner - 1e-13);
    EXPECT_LE(difference, r + 1e-13);
  }
}

TEST(SiteSurfaces, OfTwoBoxesArePlanesAndParabolicCylinders) {
  // The boxes [0, 1]^3 and [3, 4] x [0, 1]^2: the plane x = 2.
  const SiteVoronoi found =
      surface_of({site_of_mesh(make_box({1, 1, 1})), site_of_mesh(moved(make_box({1, 1, 1}), {3, 0, 0}))}, 50, 1);
  for (const SitePoint& p : found.points) {
    EXPECT_NEAR(p.point[0], 2, 1e-14);
    const double y = std::max({0.0, -p.point[1], p.point[1] - 1}), z = std::max({0.0, -p.point[2], p.point[2] - 1});
    EXPECT_NEAR(p.distance, std::sqrt(1 + y * y + z * z), 1e-13);
  }
  EXPECT_EQ(found.points.size(), std::size_t{found.grid.size[1]} * found.grid.size[2]);
}

TEST(SiteSurfaces, OfThreePointsMeetInALine) {
  const std::vector<VoronoiSite> sites = {site_of_point({0, 0, 0}), site_of_point({6, 0, 0}), site_of_point({0, 8, 0})};
  const SiteVoronoi found = surface_of(sites, 40, 2);
  std::size_t on_line = 0;
  for (const SitePoint& p : found.points) {
    if (p.count != 3) continue;
    ++on_line;
    EXPECT_NEAR(p.point[0], 3, 1e-12);
    EXPECT_NEAR(p.point[1], 4, 1e-12);
    EXPECT_EQ(p.sites[2], 2u);
    EXPECT_NEAR(p.object_angle, std::numbers::pi / 2 * std::min(1.0, std::asin(5 / p.distance) * 2 / std::numbers::pi),
                1e-9);
  }
  // One in each voxel that the line passes.
  EXPECT_EQ(on_line, found.grid.size[2]);
  EXPECT_EQ(found.pieces.size(), 3u);
}

TEST(SiteSurfaces, OfFourPointsMeetInTheirCircumcentre) {
  const std::vector<VoronoiSite> sites = {site_of_point({1, 1, 1}), site_of_point({1, -1, -1}),
                                          site_of_point({-1, 1, -1}), site_of_point({-1, -1, 1})};
  const SiteVoronoi found = surface_of(sites, 33);
  const auto is_meeting = [](const SitePoint& p) { return p.count == 4; };
  ASSERT_EQ(std::ranges::count_if(found.points, is_meeting), 1);
  const SitePoint& centre = *std::ranges::find_if(found.points, is_meeting);
  EXPECT_LT(length(centre.point), 1e-13);
  EXPECT_NEAR(centre.distance, std::sqrt(3.0), 1e-13);
  EXPECT_EQ(found.pieces.size(), 6u);
}

TEST(SiteSurfaces, AreInvariantUnderPowersOfTwo) {
  const std::vector<VoronoiSite> sites = {site_of_point({0.1, 0.2, 0.3}), site_of_segment({1, 0, 0}, {1, 1, 0.5})};
  const std::vector<VoronoiSite> large = {site_of_point({102.4, 204.8, 307.2}),
                                          site_of_segment({1024, 0, 0}, {1024, 1024, 512})};
  const SiteVoronoi a = surface_of(sites, 24), b = surface_of(large, 24);
  ASSERT_EQ(a.points.size(), b.points.size());
  EXPECT_EQ(a.faces.size(), b.faces.size());
  for (std::size_t i = 0; i < a.points.size(); ++i)
    EXPECT_LT(length(1024 * a.points[i].point - b.points[i].point), 1e-9);
}

}  // namespace
}  // namespace medial_vk::test
