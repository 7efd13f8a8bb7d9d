// Shares of volumes that are exact, and of volumes that are measured at random points.
#include <gtest/gtest.h>

#include "output/fit_reports/fits_record.h"

namespace medial_vk {
namespace {

FittedSolid closed(double volume, double covered) {
  FittedSolid solid;
  solid.solid_volume = volume;
  solid.spheres_volume = covered;
  solid.measures.emplace();
  return solid;
}

FittedSolid open(double volume, double uncovered, double standard_error) {
  FittedSolid solid;
  solid.spheres_volume = volume - uncovered;
  solid.measures.emplace();
  solid.measures->volume.solid = volume;
  solid.measures->volume.uncovered = uncovered;
  solid.measures->volume.standard_error = standard_error;
  return solid;
}

TEST(UncoveredShare, OfAClosedMeshIsExact) {
  const Share share = uncovered_share(closed(4, 3), SphereContract::kInside).value();
  EXPECT_FALSE(share.is_estimate);
  EXPECT_EQ(share.value, 0.25);
  EXPECT_EQ(share.lower(), 0.25);
  EXPECT_EQ(share.upper(), 0.25);
}

TEST(UncoveredShare, OfAnOpenMeshIsAnInterval) {
  const Share share = uncovered_share(open(2, 0.5, 0.02), SphereContract::kInside).value();
  EXPECT_TRUE(share.is_estimate);
  EXPECT_DOUBLE_EQ(share.lower(), 0.23);
  EXPECT_DOUBLE_EQ(share.upper(), 0.27);
  EXPECT_EQ(uncovered_share(open(2, 0.01, 0.02), SphereContract::kInside)->lower(), 0);
}

TEST(UncoveredShare, IsAnEstimateEvenWhereAllPointsAgree) {
  EXPECT_TRUE(uncovered_share(open(2, 0, 0), SphereContract::kInside)->is_estimate);
}

TEST(UncoveredShare, OfARobotAddsVolumesAndVariances) {
  FitsRecord record;
  record.spheres.contract = SphereContract::kInside;
  record.solids = {closed(4, 3), open(2, 0.5, 0.03), open(2, 0.5, 0.04)};
  const Share share = uncovered_share(record).value();
  EXPECT_DOUBLE_EQ(share.value, 0.25);
  EXPECT_DOUBLE_EQ(share.standard_error, 0.05 / 8);
  EXPECT_TRUE(share.is_estimate);
}

TEST(UncoveredShare, ThereIsNoneWithoutAVolumeOrForOtherContracts) {
  EXPECT_FALSE(uncovered_share(open(0, 0, 0), SphereContract::kInside));
  EXPECT_FALSE(uncovered_share(closed(4, 3), SphereContract::kCover));
}

}  // namespace
}  // namespace medial_vk
