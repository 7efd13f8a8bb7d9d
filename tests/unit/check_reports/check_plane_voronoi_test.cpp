// The check of curves between sites in the plane passes on what was found, and finds what is wrong.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "medial_vk/plane_roadmap.h"
#include "reference_bridge/check_plane_voronoi.h"

namespace medial_vk::test {
namespace {

/// A square and a triangle beside it.
class CheckOfPlaneCurves : public testing::Test {
 protected:
  void SetUp() override {
    sites_.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0.2}, {3, 0.4}, {2.5, 1.7}};
    sites_.segments = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 4}};
    sites_.site_of_point = {0, 0, 0, 0, 1, 1, 1};
    sites_.site_of_segment = {0, 0, 0, 0, 1, 1, 1};
    curves_ = find_plane_voronoi(sites_).value();
    ASSERT_GT(curves_.arcs.size(), 2u);
  }

  /// The numbers of failures by condition.
  std::vector<std::uint64_t> failures(const PlanePath* path = nullptr) const {
    const PlaneRoadmap roadmap = PlaneRoadmap::build(sites_, curves_).value();
    std::vector<std::uint64_t> failed;
    for (const CheckLine& line : check_plane_voronoi(sites_, curves_, &roadmap, path, [](double) {}).lines) {
      EXPECT_GT(line.tested, 0u) << line.condition;
      failed.push_back(line.failed);
    }
    return failed;
  }

  PlaneSites sites_;
  PlaneAxis curves_;
};

TEST_F(CheckOfPlaneCurves, WhatWasFoundPasses) {
  const auto path = PlaneRoadmap::build(sites_, curves_).value().widest_path({1.6, 0}, {1.6, 1.5}).value();
  ASSERT_TRUE(path.has_value());
  EXPECT_EQ(failures(&*path), (std::vector<std::uint64_t>{0, 0, 0, 0, 0}));
}

TEST_F(CheckOfPlaneCurves, WrongRadiiAreFound) {
  curves_.nodes[0].radius += 1e-6;
  EXPECT_EQ(failures()[0], 1u);
}

TEST_F(CheckOfPlaneCurves, WrongContactsAreFound) {
  curves_.arcs[0].contacts[0] = {true, 0};  // the lower left corner of the square, far from all curves
  EXPECT_GT(failures()[1], 0u);
}

TEST_F(CheckOfPlaneCurves, ContactsOfOneSiteAreFound) {
  curves_.arcs[0].contacts[0] = curves_.arcs[0].contacts[1];
  EXPECT_GT(failures()[2], 0u);
}

TEST_F(CheckOfPlaneCurves, MissingArcsAreFound) {
  curves_.arcs.erase(curves_.arcs.begin() + 1, curves_.arcs.end());
  EXPECT_GT(failures()[3], 0u);
}

TEST_F(CheckOfPlaneCurves, PathsThatAreNarrowerThanTheySayAreFound) {
  PlanePath path;
  path.line = {{1.2, -1}, {1.2, 2}};
  path.width = 0.201;  // the square is 0.2 beside it
  EXPECT_GT(failures(&path)[4], 0u);
  path.width = 0.2;
  EXPECT_EQ(failures(&path)[4], 0u);
}

}  // namespace
}  // namespace medial_vk::test
