// Significance of sheets (6.2), removal in both orders (6.3, 6.4.1), and the curve's files.
#include "sheets/significance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include "base/point_ops.h"
#include "medial_vk/sheets.h"
#include "medial_vk/significance.h"
#include "output/charts_and_tables/volume_curve.h"
#include "sheets/sheets_around.h"

namespace medial_vk {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const RemovalProgress kGoOn = [](double) { return true; };

/// Balls with sheets, filled one sheet after the other.
struct Parts {
  std::vector<Ball> balls;
  std::vector<std::int32_t> sheet_of;
  std::size_t sheets = 0;

  void add(const std::vector<Ball>& sheet) {
    balls.insert(balls.end(), sheet.begin(), sheet.end());
    sheet_of.resize(balls.size(), static_cast<std::int32_t>(sheets++));
  }
  SheetBalls view() const { return {balls, sheet_of, sheets}; }
};

std::vector<Ball> row(const Point& from, const Point& step, int count, double radius) {
  std::vector<Ball> balls;
  balls.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    balls.push_back({{from[0] + i * step[0], from[1] + i * step[1], from[2] + i * step[2]}, radius});
  }
  return balls;
}

Significance measure(const Parts& parts) {
  auto result = measure_significance(parts.view(), 2);
  EXPECT_TRUE(result.ok()) << result.error().message;
  return std::move(result).value();
}

SheetRemoval remove(const Parts& parts, RemovalRule rule, double least_volume = 0) {
  auto result = remove_sheets(parts.view(), measure(parts), rule, least_volume, 2, kGoOn);
  EXPECT_TRUE(result.ok()) << result.error().message;
  return std::move(result).value();
}

/// Two large balls and a thin bar between them.
Parts dumbbell() {
  Parts parts;
  parts.add({{{0, 0, 0}, 1}});
  parts.add(row({1, 0, 0}, {0.05, 0, 0}, 41, 0.1));
  parts.add({{{4, 0, 0}, 0.9}});
  return parts;
}

/// A ring in four arcs, with a spike.
Parts ring_with_spike() {
  Parts parts;
  for (int arc = 0; arc < 4; ++arc) {
    std::vector<Ball> balls;
    for (int i = 0; i < 10; ++i) {
      const double angle = 2 * std::numbers::pi * (10 * arc + i) / 40;
      balls.push_back({{std::cos(angle), std::sin(angle), 0}, 0.2 + 0.01 * arc});
    }
    parts.add(balls);
  }
  parts.add(row({1.3, 0, 0}, {0.1, 0, 0}, 40, 0.18));
  return parts;
}

TEST(Significance, IsTheShareOfTheVolume) {
  Parts parts;
  parts.add({{{0, 0, 0}, 1}});
  parts.add({{{3, 0, 0}, 0.5}, {{5, 0, 0}, 0.5}});
  const Significance found = measure(parts);
  EXPECT_NEAR(found.of_sheet[0], 1 / 1.25, 1e-14);
  EXPECT_NEAR(found.of_sheet[1], 0.25 / 1.25, 1e-14);
  EXPECT_NEAR(found.of_ball[1], 0.125 / 1.25, 1e-14);
}

TEST(Significance, SumsToOne) {
  const Significance found = measure(ring_with_spike());
  EXPECT_NEAR(std::accumulate(found.of_sheet.begin(), found.of_sheet.end(), 0.0), 1, 1e-13);
  EXPECT_NEAR(std::accumulate(found.of_ball.begin(), found.of_ball.end(), 0.0), 1, 1e-13);
}

TEST(Significance, OfComponentsDecreases) {
  Parts parts;
  parts.add(row({0, 0, 0}, {5, 0, 0}, 1, 0.5));
  parts.add(row({10, 0, 0}, {5, 0, 0}, 2, 1));
  parts.add(row({30, 0, 0}, {1e-3, 0, 0}, 3, 2));
  const Significance measured = measure(parts);
  const double all = 0.125 + 1 + 1 + 8;  // over that of a ball of radius 1; those of the last row almost coincide
  ASSERT_EQ(measured.of_component.size(), 4u);
  const std::array<double, 4> expected = {8 / all, 1 / all, 1 / all, 0.125 / all};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(measured.of_component[i], expected[i], 2e-3);
  EXPECT_NEAR(std::accumulate(measured.of_component.begin(), measured.of_component.end(), 0.0), 1, 1e-12);
}

// Four balls of one size in a row, apart, in two sheets: those at the seam count for both. With voxels of side 0.75
// sheets count up to 1.5 from a centre, so points a step away by 1/3.
TEST(Significance, BallsAtASeamAreOfAllSheetsThere) {
  std::vector<MedialSphere> spheres(4);
  Parts parts;
  for (std::uint32_t i = 0; i < 4; ++i) {
    spheres[i].voxel = {i + 1, 5, 5};
    parts.balls.push_back({{static_cast<double>(i), 0, 0}, 0.4});
  }
  parts.sheet_of = {0, 0, 0, 1};
  parts.sheets = 2;
  const VoxelGraph graph(spheres);
  SheetBalls sheets = parts.view();
  sheets.graph = &graph;
  sheets.voxel_size = 0.75;
  const Significance found = measure_significance(sheets, 1).value();
  EXPECT_NEAR(found.of_ball[2], 0.25, 1e-14);
  // The third has its own point and those to either side, the fourth its own and one.
  EXPECT_NEAR(found.of_sheet[0], 0.25 * (1 + 1 + 4.0 / 5 + 1.0 / 4), 1e-14);
  EXPECT_NEAR(found.of_sheet[1], 0.25 * (1.0 / 5 + 3.0 / 4), 1e-14);
}

// Beyond two voxels kSeamReach of the radius counts: 1.4 of a ball of radius 2.
TEST(Significance, LargeBallsReachFarther) {
  std::vector<MedialSphere> spheres(2);
  spheres[1].voxel = {10, 0, 0};
  Parts parts;
  parts.balls = {{{0, 0, 0}, 2}, {{1.05, 0, 0}, 2}};
  parts.sheet_of = {0, 1};
  parts.sheets = 2;
  const VoxelGraph graph(spheres);
  SheetBalls sheets = parts.view();
  sheets.graph = &graph;
  sheets.voxel_size = 0.1;
  // Both are equally large; each counts 1 - 1.05 / 1.4 against its own 1.
  EXPECT_NEAR(measure_significance(sheets, 1).value().of_sheet[0], 0.5, 1e-14);
  parts.balls[1].radius = 1;
  sheets.balls = parts.balls;
  const Significance uneven = measure_significance(sheets, 1).value();
  EXPECT_NEAR(uneven.of_sheet[0], uneven.of_ball[0] / 1.25, 1e-14) << "the small one does not reach the large one's";
}

// A chain of balls of one size, of which only the ends have a weight. The others are assigned to the ends within reach,
// two voxels here, by their weights, independently of their own sheets, and to their own sheets if there is none.
TEST(Significance, BallsWithoutWeightAreOfTheSheetsAround) {
  std::vector<MedialSphere> spheres(6);
  Parts parts;
  for (const double x : {0.0, 1.0, 2.0, 3.5, 5.0, 6.0}) {
    spheres[parts.balls.size()].voxel = {static_cast<std::uint32_t>(2 * x), 0, 0};
    parts.balls.push_back({{x, 0, 0}, 0.4});
  }
  parts.sheet_of = {0, 0, 1, 1, 0, 1};
  parts.sheets = 2;
  std::vector<double> weights = {2, 0, 0, 0, 0, 1};
  const VoxelGraph graph(spheres);
  SheetBalls sheets = parts.view();
  sheets.graph = &graph;
  sheets.weights = weights;
  const auto first_sheet = [&](double reach) {
    sheets.voxel_size = reach / 2;
    return measure_significance(sheets, 1).value().of_sheet[0];
  };
  EXPECT_NEAR(first_sheet(0.5), 3.0 / 6, 1e-14) << "each is of its own";
  EXPECT_NEAR(first_sheet(1.1), 2.0 / 6, 1e-14) << "the first and the one beside it";
  // The third is 2 and 4 away from the ends, the fourth 3.5 and 2.5.
  EXPECT_NEAR(first_sheet(4.2), (1 + 1 + 4.4 / 4.6 + 1.4 / 3.1) / 6, 1e-14);
  std::ranges::fill(weights, 0);
  EXPECT_NEAR(first_sheet(4.2), 3.0 / 6, 1e-14) << "without any weight, each is of its own";
}

// Equal balls; the second and third count as one, 4.25 from the first, which has no weight and reaches farther than the
// nearer of them, but not as far as their centre: its share must go to its own sheet, or it would be lost.
TEST(Significance, NothingIsLostBetweenAPointAndItsNode) {
  std::vector<MedialSphere> spheres(3);
  Parts parts;
  for (const double x : {0.0, 3.95, 4.55}) {
    spheres[parts.balls.size()].voxel = {static_cast<std::uint32_t>(x), 0, 0};
    parts.balls.push_back({{x, 0, 0}, 0.2});
  }
  parts.sheet_of = {0, 1, 1};
  parts.sheets = 2;
  const std::array<double, 3> weights = {0, 1, 1};
  const VoxelGraph graph(spheres);
  SheetBalls sheets = parts.view();
  sheets.graph = &graph;
  sheets.voxel_size = 2;  // two of them are 4
  sheets.weights = weights;
  const Significance found = measure_significance(sheets, 1).value();
  EXPECT_NEAR(found.of_sheet[0], 1.0 / 3, 1e-14);
  EXPECT_NEAR(found.of_sheet[1], 2.0 / 3, 1e-14);
}

TEST(Significance, EveryBallHasAWeight) {
  Parts parts;
  parts.add({{{0, 0, 0}, 1}, {{1, 0, 0}, 1}});
  SheetBalls sheets = parts.view();
  const std::array<double, 1> weights = {1};
  sheets.weights = weights;
  const auto result = measure_significance(sheets, 1);
  ASSERT_FALSE(result.ok());
  EXPECT_THAT(result.error().message, HasSubstr("2 balls have 1 weights"));
}

TEST(Significance, SeamWeightsAreAreasOfWhatIsNotSmall) {
  Sheets sheets;
  sheets.areas = {1, 2, 3};
  sheets.marks = {kSeam, kSmall | kRim, 0};
  EXPECT_THAT(seam_weights(sheets), ElementsAre(1, 0, 3));
}

TEST(SheetRemoval, TakesTheLeastSignificantFirst) {
  const Parts parts = dumbbell();
  const SheetRemoval removal = remove(parts, RemovalRule::kSignificance);
  EXPECT_THAT(removal.sheets, ElementsAre(1, 2));
  EXPECT_THAT(removal.kept, ElementsAre(0));
  // Without the bar the two balls remain, which are disjoint.
  const double balls = 4 * std::numbers::pi / 3 * (1 + 0.729);
  EXPECT_NEAR(removal.volume_left[0], balls / measure(parts).volume, 1e-13);
}

/// Without the bar the union would fall apart, so the smaller ball is removed first; then the bar may follow.
TEST(SheetRemoval, KeepsTheTopology) {
  const SheetRemoval removal = remove(dumbbell(), RemovalRule::kTopology);
  EXPECT_THAT(removal.sheets, ElementsAre(2, 1));
  EXPECT_THAT(removal.kept, ElementsAre(0));
}

TEST(SheetRemoval, DoesNotOpenARing) {
  const Parts parts = ring_with_spike();
  const SheetRemoval removal = remove(parts, RemovalRule::kTopology);
  EXPECT_THAT(removal.sheets, ElementsAre(4));
  EXPECT_EQ(removal.kept.size(), 4u);
  EXPECT_EQ(remove(parts, RemovalRule::kSignificance).sheets.size(), 4u);
}

TEST(SheetRemoval, StopsBeforeTooLittleIsLeft) {
  const Parts parts = dumbbell();
  const SheetRemoval all = remove(parts, RemovalRule::kSignificance);
  const SheetRemoval some = remove(parts, RemovalRule::kSignificance, all.volume_left[0] - 1e-9);
  EXPECT_THAT(some.sheets, ElementsAre(1));
  EXPECT_THAT(some.kept, ElementsAre(0, 2));
  EXPECT_TRUE(remove(parts, RemovalRule::kSignificance, all.volume_left[0] + 1e-9).sheets.empty());
  EXPECT_TRUE(remove(parts, RemovalRule::kTopology, 1).sheets.empty());
}

// The sheets removed for some volume are a first part of those removed for none, by either rule.
TEST(SheetRemoval, StopsWhereTheWholeOrderPassesTheVolume) {
  Parts parts = dumbbell();
  parts.add(row({0, 1, 0}, {0, 0.1, 0}, 12, 0.12));
  parts.add(row({4, -0.9, 0}, {0, -0.1, 0}, 10, 0.15));
  const Significance significance = measure(parts);
  for (const RemovalRule rule : {RemovalRule::kSignificance, RemovalRule::kTopology}) {
    const SheetRemoval all = remove(parts, rule);
    ASSERT_EQ(all.sheets.size(), 4u);
    for (const double least : {0.0, 0.3, 0.5, 0.7, 0.9, 0.97, 0.99, 1.0}) {
      SCOPED_TRACE(least);
      const SheetRemoval some = remove(parts, rule, least);
      const SheetRemoval first = stop_at_volume(all, significance, least);
      EXPECT_EQ(some.sheets, first.sheets);
      EXPECT_EQ(some.volume_left, first.volume_left);
      EXPECT_EQ(some.kept, first.kept);
      EXPECT_EQ(some.sheets.size() + some.kept.size(), parts.sheets);
    }
  }
}

// Sheets that must stay are tried, too: each of them counts as progress.
TEST(SheetRemoval, ProgressNeverFallsAndMovesWithEverySheet) {
  const Parts parts = ring_with_spike();
  for (const RemovalRule rule : {RemovalRule::kSignificance, RemovalRule::kTopology}) {
    std::vector<double> shares;
    const RemovalProgress note = [&](double done) {
      shares.push_back(done);
      return true;
    };
    ASSERT_TRUE(remove_sheets(parts.view(), measure(parts), rule, 0, 1, note).ok());
    ASSERT_GE(shares.size(), 4u);
    EXPECT_EQ(shares.front(), 0);
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_GE(std::set<double>(shares.begin(), shares.end()).size() + 2, shares.size());
    EXPECT_GT(shares.back(), 0.5);
    EXPECT_LT(shares.back(), 1);
  }
}

TEST(SheetRemoval, CanBeInterrupted) {
  const Parts parts = dumbbell();
  const auto result =
      remove_sheets(parts.view(), measure(parts), RemovalRule::kSignificance, 0, 2, [](double) { return false; });
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::kInterrupted);
}

TEST(VolumeCurve, AsATable) {
  const VolumeCurves curves = {{{2, 1}, {0.75, 0.5}, {0}}, {{1}, {0.625}, {0, 2}}};
  EXPECT_EQ(encode_curve_csv(curves),
            "order,sheets,volume,removed\n"
            "significance,3,1,2\nsignificance,2,0.75,1\nsignificance,1,0.5,\n"
            "topology,3,1,1\ntopology,2,0.625,\n");
}

TEST(VolumeCurve, AsADrawing) {
  const std::string svg = encode_curve_svg({{{2, 1}, {0.75, 0.5}, {0}}, {{1}, {0.625}, {0, 2}}});
  EXPECT_THAT(svg, HasSubstr("<svg xmlns="));
  // All of the volume at three sheets, half of it at one: the corners of the first curve.
  EXPECT_THAT(svg, HasSubstr("class=\"significance\" points=\"624.00,40.00 "));
  EXPECT_THAT(svg, HasSubstr("250.67,194.00\""));
}

}  // namespace
}  // namespace medial_vk
