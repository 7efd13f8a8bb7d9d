// The admissible difference of two pictures without a fault.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "picture/perceptual.h"

namespace medial_vk::test {

struct LookTolerance {
  double mean, worst;

  bool exceeded_by(const LookDifference& d) const { return d.mean > mean || d.worst > worst; }
};

// Measured on all scenes of golden_test.cpp without faults, also with vectors of 128 bits on Mesa's CPU device: a
// device with 4 samples per pixel differs from the CPU, which has as many, by up to 0.05 on average and 0.41 in the
// worst hundredth; with 16 samples by 0.12 and 1.06. The tolerances are three and two times these values. Faults to be
// found: a picture without its thin outlines differs by 2.5 or more in the worst hundredth, the torus of balls without
// soft shadows by 0.16 and 2.0, the faults of EverySmallFaultIsFound by 1.6 and 9.1 or more.
constexpr LookTolerance kSameSamples = {0.15, 1.25}, kOtherSamples = {0.24, 2.2};

inline void expect_same_look(const Picture& drawn, const Picture& wanted, const LookTolerance& tolerance) {
  ASSERT_EQ(drawn.width, wanted.width);
  ASSERT_EQ(drawn.height, wanted.height);
  const LookDifference difference = look_difference(drawn, wanted);
  EXPECT_LE(difference.mean, tolerance.mean);
  EXPECT_LE(difference.worst, tolerance.worst);
  testing::Test::RecordProperty("mean", fmt::format("{:.3f}", difference.mean));  // for changes of the tolerance
  testing::Test::RecordProperty("worst", fmt::format("{:.3f}", difference.worst));
}

}  // namespace medial_vk::test
