// Branches of axes in the plane that are pruned.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "medial_vk/plane_centre_line.h"
#include "unit/plane_centre_lines/axes_of_shapes.h"

namespace medial_vk {
namespace {

using test::axis_of;
using test::axis_of_graph;
using test::length_of;
using test::rectangle_ring;

PlaneAxis pruned(const PlaneAxis& axis, const PlanePruning& pruning) {
  auto result = prune_plane_axis(axis, pruning);
  EXPECT_TRUE(result) << result.error().message;
  return std::move(result).value();
}

// A rectangle of 3 x 1.5: four branches to the corners, of length 0.75 sqrt(2), and one of 1.5 in the middle.
TEST(PlanePruning, OfARectangleLeavesTheMiddle) {
  const PlaneAxis axis = axis_of({rectangle_ring(0, 0, 3, 1.5)});
  ASSERT_EQ(axis.branches.size(), 5u);
  const double corner = 0.75 * std::sqrt(2.0), thickness = corner - 0.75, middle = 1.5;
  for (const AxisBranch& branch : axis.branches) {
    if (!is_end_branch(axis, branch)) continue;
    EXPECT_NEAR(branch.length, corner, 1e-9);
    EXPECT_NEAR(significance_of(axis, branch), thickness, 1e-9);
  }
  EXPECT_EQ(pruned(axis, {0, 0}).branches.size(), 5u);
  EXPECT_EQ(pruned(axis, {corner - 1e-6, 0}).branches.size(), 5u);
  EXPECT_EQ(pruned(axis, {0, thickness - 1e-6}).branches.size(), 5u);
  for (const PlanePruning& pruning :
       {PlanePruning{corner + 1e-6, 0}, PlanePruning{0, thickness + 1e-6}, PlanePruning{corner + middle - 1e-6, 0},
        PlanePruning{0, thickness + middle - 1e-6}}) {
    const PlaneAxis left = pruned(axis, pruning);
    ASSERT_EQ(left.branches.size(), 1u);
    EXPECT_NEAR(left.branches.front().length, middle, 1e-9);
    EXPECT_EQ(left.junctions(), 0u);
  }
  for (const PlanePruning& pruning :
       {PlanePruning{corner + middle + 1e-6, 0}, PlanePruning{0, thickness + middle + 1e-6}}) {
    const PlaneAxis left = pruned(axis, pruning);
    EXPECT_TRUE(left.branches.empty());
    ASSERT_EQ(left.nodes.size(), 1u);
    EXPECT_NEAR(left.nodes.front().radius, 0.75, 1e-9);
  }
}

// Two ends of length 1 meet at 2, from where 5 leads to 3; the ways outwards from 3 are 6 and, along another end, 2.
TEST(PlanePruning, CountsTheWayToTheEnds) {
  const PlaneAxis axis =
      axis_of_graph({0, 0, 0, 0, 0, 0}, {{{0, 2}, 1}, {{1, 2}, 1.5}, {{2, 3}, 5}, {{3, 4}, 2}, {{3, 5}, 9}});
  EXPECT_EQ(length_of(pruned(axis, {1.2, 0})), 17.5);
  EXPECT_EQ(pruned(axis, {1.2, 0}).branches.size(), 3u);  // 1.5 and 5 are one now
  EXPECT_EQ(length_of(pruned(axis, {3, 0})), 14);
  EXPECT_EQ(length_of(pruned(axis, {6.4, 0})), 14);
  EXPECT_EQ(length_of(pruned(axis, {6.6, 0})), 9);
  EXPECT_EQ(pruned(axis, {100, 0}).nodes.size(), 1u);
}

TEST(PlanePruning, KeepsLoopsAndBordersAndParts) {
  const std::vector<PlaneRing> rings = {rectangle_ring(0, 0, 4, 4), rectangle_ring(1, 1, 2, 2),
                                        rectangle_ring(6, 0, 1, 3)};
  const PlaneAxis axis = axis_of(rings);
  const PlaneAxis left = pruned(axis, {100, 100});
  // The loop of the frame, which had branches to four corners, and a point.
  ASSERT_EQ(left.branches.size(), 1u);
  EXPECT_EQ(left.branches.front().ends[0], left.branches.front().ends[1]);
  EXPECT_EQ(std::ranges::count_if(left.nodes, [](const AxisNode& n) { return n.degree == 0; }), 1);
  // Outside, four branches of two squares leave the box, and are as they were.
  const PlaneAxis outside =
      axis_of({rectangle_ring(0, 0, 1, 1), rectangle_ring(3, 0.1, 1, 1)}, 0.2, PlaneSide::kOutside);
  const auto borders = [](const PlaneAxis& a) {
    return std::ranges::count_if(a.nodes, [](const AxisNode& n) { return n.kind == AxisNodeKind::kBorder; });
  };
  EXPECT_GT(borders(outside), 0);
  EXPECT_EQ(borders(pruned(outside, {100, 100})), borders(outside));
}

// Every disc that is lost is within the significance of one that is left: its centre is no farther from that one's than
// the difference of the radii and the significance.
TEST(PlanePruning, TheSignificanceBoundsWhatIsLost) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const PlaneAxis axis = axis_of({test::star_ring(seed, 60)}, 0.02);
    for (const double significance : {0.01, 0.05, 0.2}) {
      const PlaneAxis left = pruned(axis, {0, significance});
      ASSERT_LE(left.branches.size(), axis.branches.size());
      std::vector<AxisSample> kept;
      for (const AxisBranch& branch : left.branches) {
        for (const AxisSample& sample : sample_branch(left, branch, 1e-3)) kept.push_back(sample);
      }
      for (const AxisNode& node : left.nodes) kept.push_back({node.point, node.radius, node.object_angle});
      double worst = 0;
      for (const AxisBranch& branch : axis.branches) {
        for (const AxisSample& lost : sample_branch(axis, branch, 1e-2)) {
          double least = std::numeric_limits<double>::infinity();
          for (const AxisSample& s : kept) {
            const double off = std::hypot(s.point[0] - lost.point[0], s.point[1] - lost.point[1]);
            least = std::min(least, off + lost.radius - s.radius);
          }
          worst = std::max(worst, least);
        }
      }
      EXPECT_LE(worst, significance + 2e-3) << seed;  // both steps of the samples that are kept
    }
  }
}

TEST(PlanePruning, IsTheSameForTurnedBranchesAndRefusesWhatIsNoLength) {
  const PlaneAxis axis = axis_of({test::star_ring(3, 40)}, 0.1);
  PlaneAxis turned = axis;
  std::ranges::reverse(turned.branches);
  for (AxisBranch& branch : turned.branches) std::swap(branch.ends[0], branch.ends[1]);
  EXPECT_EQ(length_of(pruned(axis, {0.1, 0.05})), length_of(pruned(turned, {0.1, 0.05})));
  for (const double wrong : {-1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    EXPECT_EQ(prune_plane_axis(axis, {wrong, 0}).error().code, ErrorCode::kUsage);
    EXPECT_EQ(prune_plane_axis(axis, {0, wrong}).error().code, ErrorCode::kUsage);
  }
}

}  // namespace
}  // namespace medial_vk
