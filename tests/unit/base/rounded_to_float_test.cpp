#include "base/rounded_to_float.h"

#include <gtest/gtest.h>

#include "medial_vk/ball.h"

namespace medial_vk {
namespace {

// Three at a time, as gcc 12.2 left two of them unrounded. In a function of its own, so that constants are not folded.
[[gnu::noinline]] Point all_rounded(const Point& p) {
  return {rounded_to_float(p[0]), rounded_to_float(p[1]), rounded_to_float(p[2])};
}

TEST(RoundedToFloat, EveryCoordinateIsAFloat) {
  EXPECT_EQ(all_rounded({1 + 0x1p-30, 3 - 0x1p-40, 1000.1}), (Point{1, 3, double{1000.1F}}));
}

}  // namespace
}  // namespace medial_vk
