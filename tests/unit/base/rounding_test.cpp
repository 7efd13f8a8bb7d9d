// That the compiler keeps the roundings to float to which bounds refer (cmake/ProjectOptions.cmake).
#include <gtest/gtest.h>

#include <cstddef>

#include "medial_vk/ball.h"

namespace medial_vk {
namespace {

// In functions of their own, so that constants are not folded. gcc 12.2 computes two of the three at a time, and leaves
// these two in double if it may.
[[gnu::noinline]] Point listed(const Point& p) {
  return {double{static_cast<float>(p[0])}, double{static_cast<float>(p[1])}, double{static_cast<float>(p[2])}};
}

[[gnu::noinline]] Point of_middle(const Point& a, const Point& b) {
  Point middle;
  for (std::size_t axis = 0; axis < 3; ++axis) middle[axis] = static_cast<float>(a[axis] + (b[axis] - a[axis]) / 2);
  return middle;
}

[[gnu::noinline]] Point left_over(const Point& p) {
  Point left;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto rounded = static_cast<float>(p[axis]);
    left[axis] = p[axis] - double{rounded};
  }
  return left;
}

TEST(RoundingToFloat, IsNotLeftOut) {
  const Point p = {1 + 0x1p-30, 3 - 0x1p-40, 1000 + 0x1p-20};
  EXPECT_EQ(listed(p), (Point{1, 3, 1000}));
  EXPECT_EQ(of_middle(p, p), (Point{1, 3, 1000}));
  EXPECT_EQ(left_over(p), (Point{0x1p-30, -0x1p-40, 0x1p-20}));
}

}  // namespace
}  // namespace medial_vk
