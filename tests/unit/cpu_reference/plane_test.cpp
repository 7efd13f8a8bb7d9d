// The reference in the plane, against what is known of a rectangle.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cpu_reference/plane.h"

namespace medial_vk::reference {
namespace {

using Eigen::Vector2d;

/// 4 x 2, counterclockwise, and a hole of 0.5 x 0.5 at (3, 0.5), clockwise.
PlaneSegments plate(bool with_hole) {
  const auto ring = [](std::initializer_list<Vector2d> corners, PlaneSegments& segments) {
    for (auto p = corners.begin(); p != corners.end(); ++p) {
      segments.push_back({*p, p + 1 == corners.end() ? *corners.begin() : *(p + 1)});
    }
  };
  PlaneSegments segments;
  ring({{0, 0}, {4, 0}, {4, 2}, {0, 2}}, segments);
  if (with_hole) ring({{3, 0.5}, {3, 1}, {3.5, 1}, {3.5, 0.5}}, segments);
  return segments;
}

TEST(ReferencePlane, DistancesOfSegments) {
  EXPECT_EQ(distance_to_segment({1, 3}, {0, 0}, {2, 0}), 3);
  EXPECT_EQ(distance_to_segment({5, 4}, {0, 0}, {2, 0}), 5);
  EXPECT_EQ(distance_to_segment({3, 4}, {0, 0}, {0, 0}), 5);
  EXPECT_EQ(distance_to_segments({1, 0.75}, plate(false)), 0.75);
  EXPECT_EQ(distance_to_segments({2.9, 0.75}, plate(false)), 0.75);
  EXPECT_NEAR(distance_to_segments({2.9, 0.75}, plate(true)), 0.1, 1e-15);
}

TEST(ReferencePlane, WhatIsInside) {
  EXPECT_TRUE(is_inside({1, 1}, plate(true)));
  EXPECT_TRUE(is_inside({3.25, 0.75}, plate(false)));
  EXPECT_FALSE(is_inside({3.25, 0.75}, plate(true)));
  EXPECT_FALSE(is_inside({5, 1}, plate(true)));
  EXPECT_FALSE(is_inside({-1, 0}, plate(true)));
}

TEST(ReferencePlane, TheGreatestDiscTouchesTwoPlaces) {
  // Between both long sides, of which the lower one is segment 0.
  const auto middle = greatest_disc({2, 0}, {0, 1}, 0, plate(false));
  ASSERT_TRUE(middle);
  EXPECT_EQ(middle->radius, 1);
  EXPECT_NEAR(middle->object_angle, std::numbers::pi / 2, 1e-15);
  // In a corner it touches the short side, at a right angle.
  const auto corner = greatest_disc({0.25, 0}, {0, 1}, 0, plate(false));
  ASSERT_TRUE(corner);
  EXPECT_NEAR(corner->radius, 0.25, 1e-15);
  EXPECT_NEAR(corner->object_angle, std::numbers::pi / 4, 1e-14);
  // Beside the hole it touches a corner of it, (3, 0.5): r = |c - p|^2 / (2 * 0.5).
  const auto point = greatest_disc({2.5, 0}, {0, 1}, 0, plate(true));
  ASSERT_TRUE(point);
  EXPECT_NEAR(point->radius, 0.5, 1e-15);
  EXPECT_NEAR((point->centre - Vector2d(3, 0.5)).norm(), 0.5, 1e-15);
  // Outside of a convex shape there is no greatest disc.
  EXPECT_FALSE(greatest_disc({2, 0}, {0, -1}, 0, plate(false)));
}

}  // namespace
}  // namespace medial_vk::reference
