// The check of hulls by the reference: hulls inside pass, and each kind of wrong one fails its condition.
#include "reference_bridge/check_hulls.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "medial_vk/prepare.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

class CheckHulls : public testing::Test {
 protected:
  static PreparedMesh prepared(const Mesh& mesh) { return prepare_mesh(mesh, {}).value(); }

  /// The conditions that fail, as a word of the first letters of numbers, inside, balls, edges.
  static std::string failures(const PreparedMesh& mesh, const std::vector<BallHull>& hulls) {
    const CheckReport report = check_hulls_inside(mesh, hulls);
    std::string failed;
    for (std::size_t i = 0; i < report.lines.size(); ++i) {
      EXPECT_EQ(report.lines[i].failed > 0, !report.lines[i].first_failure.empty());
      if (report.lines[i].failed > 0) failed += "nibe"[i];
    }
    EXPECT_EQ(report.passed(), failed.empty());
    return failed;
  }
  std::string failures(const std::vector<BallHull>& hulls) const { return failures(box_, hulls); }

  const PreparedMesh box_ = prepared(test::make_box({1, 1, 1}));
};

constexpr Ball kLow = {{0.25, 0.25, 0.25}, 0.25};  // touches three faces
constexpr Ball kHigh = {{0.75, 0.75, 0.5}, 0.25};
constexpr Ball kSmall = {{0.25, 0.75, 0.75}, 0.125};

TEST_F(CheckHulls, HullsThatTouchPass) {
  EXPECT_EQ(failures({}), "");
  EXPECT_EQ(failures({hull_of(kLow), hull_of(kLow, kHigh), hull_of(kLow, kHigh, kSmall), hull_of(kHigh, kSmall)}), "");
  EXPECT_EQ(failures({hull_of(kLow, kLow, kLow), hull_of({{0.5, 0.5, 0.5}, 0}, kHigh)}), "");
}

TEST_F(CheckHulls, WhatSticksOutFails) {
  Ball larger = kHigh;
  larger.radius += 1e-9;
  EXPECT_EQ(failures({hull_of(larger)}), "b");
  EXPECT_EQ(failures({hull_of(kLow, larger)}), "be");
  EXPECT_EQ(failures({hull_of(kLow, kSmall, larger)}), "be");
  EXPECT_EQ(failures({hull_of(kLow, {{1.5, 0.5, 0.5}, 0.25})}), "ibe");
}

TEST_F(CheckHulls, NumbersMustBeFinite) {
  EXPECT_EQ(failures({hull_of({{0.5, 0.5, 0.5}, -0.1})}), "n");
  EXPECT_EQ(failures({hull_of({{0.5, 0.5, std::numeric_limits<double>::quiet_NaN()}, 0.1})}), "n");
  EXPECT_EQ(failures({hull_of(kLow, {{0.5, 0.5, 0.5}, std::numeric_limits<double>::infinity()})}), "n");
}

TEST_F(CheckHulls, AnAxisBetweenTheArmsOfASolidFails) {
  const PreparedMesh l_shape = prepared(test::make_l_shape(2, 0.5, 0.5));
  const Ball right = {{1.75, 0.25, 0.25}, 0.25}, up = {{0.25, 1.75, 0.25}, 0.25}, corner = {{0.25, 0.25, 0.25}, 0.25};
  EXPECT_EQ(failures(l_shape, {hull_of(right, corner), hull_of(corner, up)}), "");
  EXPECT_EQ(failures(l_shape, {hull_of(right, up)}), "ibe");
  EXPECT_EQ(failures(l_shape, {hull_of(right, corner, up)}), "ibe");
}

// The cavity is smaller than the way between random balls, whose radii are smaller still.
TEST_F(CheckHulls, TheEdgesFindWhatRandomBallsMiss) {
  constexpr double kSize = 1e-6;
  Mesh cavity = test::make_tetrahedron(
      {Point{kSize, 0, 0}, Point{-kSize, kSize, 0}, Point{-kSize, -kSize, 0}, Point{0, 0, kSize}});
  test::translate(cavity, {0.5, 0.5, 0.5 - kSize / 3});
  test::turn_over(cavity);
  Mesh mesh = test::make_box({1, 1, 1});
  test::append(mesh, cavity);
  const PreparedMesh hollow = prepared(mesh);
  ASSERT_EQ(hollow.mesh.triangles.size(), 16u);
  const Ball a = {{0.125, 0.5, 0.5}, 1e-8}, b = {{0.875, 0.5, 0.5}, 1e-8};
  EXPECT_EQ(failures(hollow, {hull_of(a, b)}), "e");
  const Ball c = {{0.875, 0.625, 0.5}, 1e-8};
  EXPECT_EQ(failures(hollow, {hull_of(a, c)}), "");
}

}  // namespace
}  // namespace medial_vk
