// How different two pictures may look although nothing is wrong.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "picture/perceptual.h"

namespace medial_vk::test {

// What differs although nothing is wrong, measured on all scenes of golden_test.cpp: a device with 4 samples per pixel
// from the CPU, which has as many, by 0.06 on average and 0.25 in the worst hundredth; with 16 samples by 0.12 and 1.1;
// the same with vectors of 128 bits on Mesa's CPU device. The tolerance is thrice that. The faults in
// EverySmallFaultIsFound, as small as somebody would notice, make 1.6 and 9.1 or more.
constexpr double kMeanTolerance = 0.36, kWorstTolerance = 3.3;

inline bool found(const LookDifference& d) { return d.mean > kMeanTolerance || d.worst > kWorstTolerance; }

inline void expect_same_look(const Picture& drawn, const Picture& wanted) {
  ASSERT_EQ(drawn.width, wanted.width);
  ASSERT_EQ(drawn.height, wanted.height);
  const LookDifference difference = look_difference(drawn, wanted);
  EXPECT_LE(difference.mean, kMeanTolerance);
  EXPECT_LE(difference.worst, kWorstTolerance);
  testing::Test::RecordProperty("mean", fmt::format("{:.3f}", difference.mean));  // for who changes the tolerance
  testing::Test::RecordProperty("worst", fmt::format("{:.3f}", difference.worst));
}

}  // namespace medial_vk::test
