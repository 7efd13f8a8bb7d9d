// Points against distances by brute force, and samples of the surface against the voxels of points.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/point_ops.h"
#include "medial_vk/site_voronoi.h"
#include "support/site_voronoi/arrangements.h"
#include "support/site_voronoi/site_sampler.h"

namespace medial_vk::test {
namespace {

class SiteArrangements : public testing::TestWithParam<std::size_t> {
 protected:
  void SetUp() override {
    arrangement_ = site_arrangements(16)[GetParam()];
    SiteVoronoiOptions options;
    options.resolution = 32;
    Result<SiteVoronoi> found = find_site_voronoi(arrangement_.sites, options);
    ASSERT_TRUE(found.ok()) << found.error().message;
    voronoi_ = std::move(found).value();
  }

  SiteArrangement arrangement_;
  SiteVoronoi voronoi_;
};

TEST_P(SiteArrangements, PointsAreEquallyFarFromTheirSitesAndNoOtherIsNearer) {
  ASSERT_FALSE(voronoi_.points.empty());
  const double slack = 1e-15 * voronoi_.grid.side * 32;
  const std::size_t step = std::max<std::size_t>(1, voronoi_.points.size() / 300);
  for (std::size_t i = 0; i < voronoi_.points.size(); i += step) {
    const SitePoint& p = voronoi_.points[i];
    for (std::uint32_t s = 0; s < arrangement_.sites.size(); ++s) {
      const auto distance = static_cast<double>(distance_to_site(p.point, arrangement_.sites[s]));
      const auto* const at = std::find(p.sites.begin(), p.sites.begin() + p.count, s);
      if (at == p.sites.begin() + p.count) {
        EXPECT_GT(distance, p.distance - p.error) << arrangement_.name;
        continue;
      }
      EXPECT_NEAR(distance, p.distance, p.error + slack) << arrangement_.name;
      EXPECT_NEAR(length(p.contacts[static_cast<std::size_t>(at - p.sites.begin())] - p.point), distance,
                  p.error + slack);
    }
    EXPECT_LT(p.error, 1e-12 * 32 * voronoi_.grid.side);
    for (std::size_t k = 0; k < 3; ++k) {
      const double at = (p.point[k] - voronoi_.grid.origin[k]) / voronoi_.grid.side - p.voxel[k];
      EXPECT_GE(at, -1e-9);
      EXPECT_LE(at, 1 + 1e-9);
    }
  }
}

TEST_P(SiteArrangements, NoSampleIsLost) {
  SiteSampler sampler(arrangement_.sites, voronoi_.grid, 5);
  const SampledVoxels voxels(voronoi_);
  std::size_t samples = 0, undecided = 0, left_out = 0;
  for (int i = 0; i < 4000; ++i) {
    const std::optional<SiteSample> sample = sampler.next();
    if (!sample || sample->object_angle < 0x1p-12) continue;
    ++samples;
    const SampleState state = voxels.state_of(*sample);
    EXPECT_NE(state, SampleState::kLost) << arrangement_.name << " at " << sample->point[0] << ' ' << sample->point[1]
                                         << ' ' << sample->point[2];
    if (state == SampleState::kUndecided) ++undecided;
    if (state == SampleState::kLeftOut) ++left_out;
  }
  EXPECT_GT(samples, 300u) << arrangement_.name;
  EXPECT_LE(undecided * 1000, samples);
  // In the last arrangement solids overlap.
  const bool has_overlap = GetParam() == 9;
  EXPECT_EQ(left_out > 0, has_overlap) << left_out;
}

TEST_P(SiteArrangements, FacesJoinPointsOfTheirSites) {
  std::vector<std::uint64_t> faces(voronoi_.pieces.size());
  for (const SiteFace& face : voronoi_.faces) {
    ASSERT_LT(face.piece, faces.size());
    ++faces[face.piece];
    EXPECT_EQ(face.sites, voronoi_.pieces[face.piece].sites);
    EXPECT_LT(face.sites[0], face.sites[1]);
    for (std::size_t i = 0; i < 4; ++i) {
      const Point side = voronoi_.points[face.corners[i]].point - voronoi_.points[face.corners[(i + 1) % 4]].point;
      // Corners in a row are in voxels that share a face.
      EXPECT_LE(length(side), std::sqrt(6.0) * voronoi_.grid.side * (1 + 1e-12));
    }
  }
  for (std::size_t i = 0; i < faces.size(); ++i) EXPECT_EQ(faces[i], voronoi_.pieces[i].faces);
}

INSTANTIATE_TEST_SUITE_P(All, SiteArrangements, testing::Range<std::size_t>(0, 10));

}  // namespace
}  // namespace medial_vk::test
