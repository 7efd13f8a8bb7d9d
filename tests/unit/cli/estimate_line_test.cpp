// The line with the time that the CPU reference will take.
#include <gtest/gtest.h>

#include "cli/shared/reference_with_estimate.h"

namespace medial_vk::cli {
namespace {

TEST(EstimateLine, IsLeftOutForAFewSeconds) { EXPECT_EQ(estimate_line({9.9, 100, false}), ""); }

TEST(EstimateLine, HasTwoDigitsAndTheSizeOfTheSample) {
  EXPECT_EQ(estimate_line({43.21, 1234, false}),
            "  estimate  about 43 s on one thread, from 1,234 voxels chosen at random; a device is faster\n");
}

TEST(EstimateLine, SaysWhenAVoxelWasNotFinished) {
  EXPECT_EQ(estimate_line({1234, 1, true}),
            "  estimate  about 20 min 00 s, or much more, on one thread, from 1 voxel chosen at random; a device is "
            "faster\n");
}

}  // namespace
}  // namespace medial_vk::cli
