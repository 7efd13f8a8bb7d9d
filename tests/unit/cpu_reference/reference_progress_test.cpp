// The reference reports its progress, stops, and estimates its time.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "cpu_reference/extract.h"
#include "support/reference_mesh.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

reference::Mesh torus() { return test::to_reference(test::make_torus(1.0, 0.4, 24, 12, 0.5)); }

reference::Options coarse() {
  reference::Options options;
  options.resolution = 8;
  options.extra_levels = 1;
  return options;
}

TEST(ReferenceProgress, IsFinerThanTopCellsAndEndsWithAll) {
  std::vector<double> shares;
  const reference::Result result = reference::extract(torus(), coarse(), [&](double share) {
    shares.push_back(share);
    return true;
  });
  ASSERT_GT(result.found, 0u);
  EXPECT_GE(shares.size(), result.found);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.back(), 1.0);
}

TEST(ReferenceProgress, AStopEndsTheSearchWithinATopCell) {
  int calls = 0;
  const reference::Result result = reference::extract(torus(), coarse(), [&](double) { return ++calls < 5; });
  EXPECT_TRUE(result.interrupted);
  EXPECT_EQ(calls, 5);
}

TEST(ReferenceProgress, TheTimeIsEstimatedOnceBeforeTheSearch) {
  int estimates = 0, calls = 0;
  const auto progress = [&](double) {
    EXPECT_EQ(estimates, 1);
    ++calls;
    return true;
  };
  const reference::Result with = reference::extract(torus(), coarse(), progress, [&](const reference::TimeEstimate& e) {
    ++estimates;
    EXPECT_GT(e.seconds, 0);
    EXPECT_GE(e.voxels, 1);
    EXPECT_EQ(calls, 0);
  });
  EXPECT_EQ(estimates, 1);
  EXPECT_GT(calls, 0);
  const reference::Result without = reference::extract(torus(), coarse());
  ASSERT_EQ(with.spheres.size(), without.spheres.size());
  for (std::size_t i = 0; i < with.spheres.size(); ++i) EXPECT_EQ(with.spheres[i].centre, without.spheres[i].centre);
  EXPECT_EQ(with.queries, without.queries);
}

TEST(ReferenceProgress, OfThePublishedMethodNoTimeIsEstimated) {
  reference::Options options = coarse();
  options.certified = false;
  bool estimated = false;
  reference::extract(torus(), options, {}, [&](const reference::TimeEstimate&) { estimated = true; });
  EXPECT_FALSE(estimated);
}

}  // namespace
}  // namespace medial_vk
