// Sheets of points that are placed by hand.
#include "medial_vk/sheets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "base/point_ops.h"
#include "check_reports/check_sheets.h"

namespace medial_vk {
namespace {

using testing::ElementsAre;

const VoxelGrid kGrid = {{0, 0, 0}, 1.0, {64, 64, 64}};

/// A point in the middle of a voxel, of a sheet with the given normal (of unit length): spokes at right angles to it.
MedialSphere point_at(std::uint32_t x, std::uint32_t y, std::uint32_t z, std::array<float, 3> normal,
                      double radius = 4) {
  MedialSphere s;
  s.voxel = {x, y, z};
  s.centre = {x + 0.5, y + 0.5, z + 0.5};
  s.radius = radius;
  s.spoke_a = normal;
  s.spoke_b = {-normal[0], -normal[1], -normal[2]};
  s.object_angle = static_cast<float>(std::numbers::pi / 2);
  return s;
}

/// A square of n x n points across z, its normal tilted by an angle in degrees.
std::vector<MedialSphere> square(std::uint32_t n, double tilt = 0, std::uint32_t x = 1, std::uint32_t z = 8) {
  const double turn = tilt * std::numbers::pi / 180;
  const std::array<float, 3> normal = {static_cast<float>(std::sin(turn)), 0, static_cast<float>(std::cos(turn))};
  std::vector<MedialSphere> out;
  for (std::uint32_t j = 1; j <= n; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) out.push_back(point_at(x + i, j, z, normal));
  }
  return out;
}

std::vector<MedialSphere> together(std::vector<MedialSphere> a, const std::vector<MedialSphere>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// The options of the published test alone.
SheetOptions as_published(double angle = 5.7) {
  SheetOptions options;
  options.angle = angle;
  options.crease = options.width = 0;
  return options;
}

Sheets find(const std::vector<MedialSphere>& spheres, const SheetOptions& options) {
  return find_sheets(spheres, kGrid, ExtractionOptions(), options).value();
}

std::vector<std::uint64_t> sizes(const Sheets& sheets) {
  std::vector<std::uint64_t> out;
  for (const Sheet& sheet : sheets.sheets) out.push_back(sheet.points);
  return out;
}

TEST(Sheets, ASquareIsOneSheetOfItsArea) {
  const Sheets sheets = find(square(10), as_published());
  ASSERT_EQ(sheets.sheets.size(), 1u);
  EXPECT_EQ(sheets.sheets[0].points, 100u);
  // It ends somewhere in the 36 outermost voxels: half of each counts.
  EXPECT_NEAR(sheets.sheets[0].area, 64 + 36 / 2.0, 1e-6);
  EXPECT_NEAR(std::accumulate(sheets.areas.begin(), sheets.areas.end(), 0.0), 82, 1e-6);
  EXPECT_DOUBLE_EQ(sheets.sheets[0].mean_radius, 4);
  EXPECT_NEAR(sheets.sheets[0].mean_object_angle, std::numbers::pi / 2, 1e-6);
  EXPECT_FALSE(sheets.sheets[0].significance.has_value());
  EXPECT_EQ(sheets.seam_points, 0u);
  EXPECT_EQ(sheets.rim_points, 36u);  // the outermost ring
}

TEST(Sheets, NothingHasNoSheets) {
  const Sheets sheets = find({}, SheetOptions());
  EXPECT_TRUE(sheets.sheets.empty());
  EXPECT_TRUE(sheets.of_point.empty());
}

// Section 2.5: within tau, for either sign of the normal.
TEST(Sheets, TheAngleDecidesAndTheSignDoesNot) {
  const std::vector<MedialSphere> a = square(6);
  std::vector<MedialSphere> b = square(6, 5, 7);
  for (MedialSphere& s : b) std::swap(s.spoke_a, s.spoke_b);
  EXPECT_THAT(sizes(find(together(a, b), as_published(5.1))), ElementsAre(72));
  EXPECT_THAT(sizes(find(together(a, b), as_published(4.9))), ElementsAre(36, 36));
  EXPECT_EQ(find(together(a, b), as_published(4.9)).seam_points, 12u);
}

// A facet's crease turns both spokes by its angle.
TEST(Sheets, CreasesJoin) {
  const std::vector<MedialSphere> bent = together(square(6), square(6, 20, 7));
  SheetOptions options = as_published();
  EXPECT_EQ(sizes(find(bent, options)).size(), 2u) << "as published, normals alone decide";
  options.crease = 21;
  EXPECT_EQ(sizes(find(bent, options)).size(), 1u);
  // A border may join components that no link joins.
  options.crease = 10;
  options.border = 19;
  EXPECT_EQ(sizes(find(bent, options)).size(), 2u);
  options.border = 21;
  EXPECT_EQ(sizes(find(bent, options)).size(), 1u);
}

// Beside a flat strip of ten rows lies a twisted one, 20 to 65 degrees. The least turns of the points on the twisted
// side are these; those on the flat side also include the row before: 20, 20, 25, ... 60. None of these twenty has a
// repulsion above 4: together they have a repulsion of 5 for a limit of 31, and an attraction of 4 for one of 32. (The
// mean of their turns is 40.25. With 40 points each, 20 are no short border.)
TEST(Sheets, AllOfABorderDecides) {
  std::vector<MedialSphere> spheres;
  for (std::uint32_t row = 1; row <= 10; ++row) {
    const double turn = (15 + 5 * row) * std::numbers::pi / 180;
    const std::array<float, 3> twisted = {static_cast<float>(std::sin(turn)), 0, static_cast<float>(std::cos(turn))};
    for (std::uint32_t x = 1; x <= 4; ++x) spheres.push_back(point_at(x, row, 8, {0, 0, 1}));
    for (std::uint32_t x = 5; x <= 8; ++x) spheres.push_back(point_at(x, row, 8, twisted));
  }
  SheetOptions options;
  options.width = 0;
  options.border = 31;
  EXPECT_EQ(sizes(find(spheres, options)).size(), 2u);
  options.border = 32;
  EXPECT_EQ(sizes(find(spheres, options)).size(), 1u);
}

// The second square begins beside the last row of the first, so that two points of either are at the border. They turn
// by 20 degrees and have an attraction of 30 each, and their number is raised to 1.75 sqrt(points) with points of
// repulsion 4: 4 * 30 - 29.25 * 4 = 3 for squares of 19 by 19 points, 4 * 30 - 31 * 4 = -4 for 20 by 20.
TEST(Sheets, AShortBorderDoesNotJoinLargeComponents) {
  const auto touching = [](std::uint32_t n) {
    std::vector<MedialSphere> out = square(n);
    for (MedialSphere s : square(n, 20, n + 1)) {
      s.voxel[1] += n - 1;
      s.centre[1] += n - 1;
      out.push_back(s);
    }
    return out;
  };
  SheetOptions options;
  options.width = 0;
  EXPECT_EQ(sizes(find(touching(19), options)).size(), 1u);
  EXPECT_EQ(sizes(find(touching(20), options)).size(), 2u);
  options.border = 180;
  EXPECT_EQ(sizes(find(touching(20), options)).size(), 2u) << "nor does any limit";
}

// Between two that differ by 60 degrees lies one that differs from them by 29 and 31.
TEST(Sheets, ComponentsJoinUpToTheTurnOfABorder) {
  const std::vector<MedialSphere> spheres = together(together(square(6), square(6, 29, 7)), square(6, 60, 13));
  SheetOptions options;
  options.border = 28;
  EXPECT_THAT(sizes(find(spheres, options)), ElementsAre(36, 36, 36));
  options.border = 30;
  EXPECT_THAT(sizes(find(spheres, options)), ElementsAre(72, 36));
  options.border = 32;
  EXPECT_THAT(sizes(find(spheres, options)), ElementsAre(108));
}

// Normals that agree do not join two sheets if a salient sheet may pass between them: here two bisectors of a square
// prism's opposite edges, in one plane.
TEST(Sheets, OppositeBisectorsAreTwoSheets) {
  std::vector<MedialSphere> a = square(6), b = square(6, 0, 7);
  const auto root = static_cast<float>(std::sqrt(0.5));
  for (MedialSphere& s : a) s.spoke_a = {-root, 0, root}, s.spoke_b = {-root, 0, -root};
  for (MedialSphere& s : b) s.spoke_a = {root, 0, root}, s.spoke_b = {root, 0, -root};
  EXPECT_EQ(sizes(find(together(a, b), SheetOptions())).size(), 2u);
  EXPECT_EQ(sizes(find(together(a, b), as_published())).size(), 1u) << "as published, normals alone decide";
}

// Section 2.5: a sheet may turn by any angle along the way.
TEST(Sheets, ASheetMayTurnSlowly) {
  std::vector<MedialSphere> strip;
  for (std::uint32_t i = 0; i < 40; ++i) {
    const double turn = i * 5 * std::numbers::pi / 180;
    for (std::uint32_t j = 1; j < 4; ++j) {
      strip.push_back(
          point_at(i + 1, j, 5, {static_cast<float>(std::sin(turn)), 0, static_cast<float>(std::cos(turn))}));
    }
  }
  EXPECT_EQ(sizes(find(strip, as_published())).size(), 1u);
}

TEST(Sheets, DecreasingNumberOfPointsThenFirstVoxel) {
  // Apart from each other: 9, 16, 9 points.
  const std::vector<MedialSphere> spheres =
      together(together(square(3, 0, 1, 20), square(4, 0, 1, 10)), square(3, 0, 20, 10));
  const Sheets sheets = find(spheres, SheetOptions());
  EXPECT_THAT(sizes(sheets), ElementsAre(16, 9, 9));
  EXPECT_EQ(sheets.of_point.front(), 2) << "z = 20 comes after z = 10";
  EXPECT_EQ(sheets.of_point.back(), 1);
  EXPECT_EQ(sheets.fragments, 2u);
  EXPECT_EQ(sheets.fragment_points, 18u);
}

/// Patches of random tilts side by side, so that there are many decisions.
std::vector<MedialSphere> patchwork(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> tilts(0, 60);
  std::vector<MedialSphere> out;
  for (std::uint32_t k = 0; k < 12; ++k) out = together(out, square(5, tilts(random), 1 + 5 * k, 8));
  std::uniform_real_distribution<double> radii(1, 20);
  for (MedialSphere& s : out) s.radius = radii(random);
  return out;
}

TEST(Sheets, TheOrderOfPointsDoesNotMatter) {
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    const std::vector<MedialSphere> spheres = patchwork(seed);
    std::vector<std::uint32_t> order(spheres.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::mt19937 random(seed);
    std::shuffle(order.begin(), order.end(), random);
    std::vector<MedialSphere> shuffled;
    shuffled.reserve(order.size());
    for (const std::uint32_t i : order) shuffled.push_back(spheres[i]);

    for (const SheetOptions& options : {SheetOptions(), as_published(), SheetOptions{5.7, 20, 45, 0.2, 30}}) {
      const Sheets a = find(spheres, options), b = find(shuffled, options);
      ASSERT_EQ(a.sheets.size(), b.sheets.size());
      for (std::size_t i = 0; i < order.size(); ++i) {
        ASSERT_EQ(b.of_point[i], a.of_point[order[i]]) << "seed " << seed;
        ASSERT_EQ(b.marks[i], a.marks[order[i]]);
      }
      for (std::size_t i = 0; i < a.sheets.size(); ++i) {
        EXPECT_EQ(a.sheets[i].area, b.sheets[i].area);
        EXPECT_EQ(a.sheets[i].mean_radius, b.sheets[i].mean_radius);
      }
    }
  }
}

// Ten columns, a strip of three, five columns, all 13 high; bends of 60 degrees.
TEST(Sheets, SmallComponentsGoToThoseAroundThem) {
  std::vector<MedialSphere> spheres;
  for (const MedialSphere& s : square(18)) {
    if (s.voxel[1] > 13) continue;
    const bool strip = s.voxel[0] >= 11 && s.voxel[0] <= 13;
    const auto side = static_cast<float>(std::sin(std::numbers::pi / 3));
    spheres.push_back(strip ? point_at(s.voxel[0], s.voxel[1], s.voxel[2], {side, 0, 0.5f}) : s);
  }
  SheetOptions options;
  options.border = 55;
  options.width = 0;
  EXPECT_THAT(sizes(find(spheres, options)), ElementsAre(130, 65, 39));
  options.absorb_fragments = 40;
  const Sheets absorbed = find(spheres, options);
  EXPECT_EQ(absorbed.components, 3u);
  EXPECT_EQ(absorbed.absorbed_components, 1u);
  EXPECT_EQ(absorbed.absorbed_points, 39u);
  EXPECT_THAT(sizes(absorbed), ElementsAre(156, 78)) << "a column to either side, the middle one to the first";
  // Between the columns at its borders the strip is two voxels wide: 1/4 of the diameter. Between the border and the
  // rim of the columns beside it there are four.
  options.absorb_fragments = 0;
  options.width = 0.24;
  EXPECT_EQ(sizes(find(spheres, options)).size(), 3u);
  options.width = 0.26;
  EXPECT_THAT(sizes(find(spheres, options)), ElementsAre(156, 78));
}

// Six columns, and two of another sheet beside them, one at the border and one at the rim: those have depth 0.
// Narrowness is not tested where a quarter of the diameter is less than a voxel.
TEST(Sheets, NoComponentIsTooNarrowForBallsOfAFewVoxels) {
  SheetOptions options;
  options.width = 0.25;
  const auto sizes_with = [&](double radius) {
    std::vector<MedialSphere> spheres;
    for (std::uint32_t y = 1; y <= 12; ++y) {
      for (std::uint32_t x = 1; x <= 6; ++x) spheres.push_back(point_at(x, y, 8, {0, 0, 1}, radius));
      for (std::uint32_t x = 7; x <= 8; ++x) spheres.push_back(point_at(x, y, 8, {1, 0, 0}, radius));
    }
    return sizes(find(spheres, options));
  };
  EXPECT_THAT(sizes_with(1.9), ElementsAre(72, 24));
  EXPECT_THAT(sizes_with(2.1), ElementsAre(96));
}

// Two columns beside six: the points that were reassigned are marked, in their original order.
TEST(Sheets, MarksWhatIsSmall) {
  std::vector<MedialSphere> spheres;
  for (std::uint32_t x = 8; x >= 1; --x) {
    for (std::uint32_t y = 1; y <= 12; ++y) {
      spheres.push_back(point_at(x, y, 8, x > 6 ? std::array{1.f, 0.f, 0.f} : std::array{0.f, 0.f, 1.f}, 40));
    }
  }
  SheetOptions options;
  options.width = 0;
  options.absorb_fragments = 25;
  const Sheets sheets = find(spheres, options);
  EXPECT_THAT(sizes(sheets), ElementsAre(96));
  EXPECT_EQ(sheets.absorbed_points, 24u);
  for (std::size_t i = 0; i < spheres.size(); ++i) EXPECT_EQ((sheets.marks[i] & kSmall) != 0, i < 24) << i;
}

// Four columns, each turned by 80 degrees against those beside it: no component is wide enough to take the others.
TEST(Sheets, SmallComponentsAmongThemselvesAreOne) {
  std::vector<MedialSphere> spheres;
  for (MedialSphere s : square(4)) {
    const double turn = 80 * s.voxel[0] * std::numbers::pi / 180;
    spheres.push_back(point_at(s.voxel[0], s.voxel[1], s.voxel[2],
                               {static_cast<float>(std::sin(turn)), 0, static_cast<float>(std::cos(turn))}));
  }
  SheetOptions options;
  options.width = 0;
  EXPECT_THAT(sizes(find(spheres, options)), ElementsAre(4, 4, 4, 4));
  options.width = 0.3;
  const Sheets sheets = find(spheres, options);
  EXPECT_THAT(sizes(sheets), ElementsAre(16));
  EXPECT_EQ(sheets.absorbed_components, 3u);
  EXPECT_EQ(sheets.absorbed_points, 12u);
}

std::size_t small_points(const Sheets& sheets) {
  return static_cast<std::size_t>(std::ranges::count_if(sheets.marks, [](std::uint8_t m) { return m & kSmall; }));
}

// Eight columns, each turned by 80 degrees against those beside it, of balls of the diameter 8; 6 wide between rims.
TEST(Sheets, AbsorbedComponentsAreJudgedAgain) {
  std::vector<MedialSphere> spheres;
  for (const MedialSphere& s : square(8)) {
    const double turn = (s.voxel[0] % 2 == 0 ? 40 : -40) * std::numbers::pi / 180;
    spheres.push_back(point_at(s.voxel[0], s.voxel[1], s.voxel[2],
                               {static_cast<float>(std::sin(turn)), 0, static_cast<float>(std::cos(turn))}));
  }
  SheetOptions options;
  options.border = 60;
  for (const double width : {0.3, 1.0}) {
    SCOPED_TRACE(width);
    options.width = width;
    const Sheets sheets = find(spheres, options);
    EXPECT_EQ(sheets.components, 8u);
    EXPECT_THAT(sizes(sheets), ElementsAre(64));
    EXPECT_EQ(small_points(sheets), 8 * width > 6 ? 64u : 0u);
  }
}

// A sphere of radius 6 has neither borders nor rims.
TEST(Sheets, WhatIsClosedIsNotSmall) {
  std::vector<MedialSphere> spheres;
  for (std::uint32_t i = 0; i < 16 * 16 * 16; ++i) {
    const std::uint32_t x = i % 16, y = i / 16 % 16, z = i / 256;
    const Point from_centre = {x - 7.5, y - 7.5, z - 7.5};
    const double distance = length(from_centre);
    if (std::abs(distance - 6) > 0.6) continue;
    const Point out = 1 / distance * from_centre;
    spheres.push_back(
        point_at(x, y, z, {static_cast<float>(out[0]), static_cast<float>(out[1]), static_cast<float>(out[2])}));
  }
  SheetOptions options;
  options.width = 1;
  options.absorb_fragments = 10000;
  const Sheets sheets = find(spheres, options);
  EXPECT_EQ(sheets.sheets.size(), 1u);
  EXPECT_EQ(sheets.rim_points, 0u);
  EXPECT_EQ(small_points(sheets), 0u);
}

TEST(Sheets, AComponentWithoutNeighboursStays) {
  SheetOptions options;
  options.width = 1;
  options.absorb_fragments = 1000;
  const Sheets sheets = find(together(square(2), square(2, 0, 30)), options);
  EXPECT_EQ(sizes(sheets).size(), 2u);
  EXPECT_EQ(small_points(sheets), 8u);
}

TEST(Sheets, CheckFindsPartsAndWrongNumbers) {
  std::vector<MedialSphere> spheres = together(square(4), square(3, 0, 20));
  const Sheets sheets = find(spheres, SheetOptions());
  for (std::size_t i = 0; i < spheres.size(); ++i) spheres[i].sheet = sheets.of_point[i];
  for (const auto& line : check_sheets(spheres)) EXPECT_EQ(line.failed, 0u) << line.first_failure;
  for (MedialSphere& s : spheres) s.sheet = 0;
  EXPECT_EQ(check_sheets(spheres)[0].failed, 1u) << "two parts";
  for (std::size_t i = 0; i < spheres.size(); ++i) spheres[i].sheet = 1 - sheets.of_point[i];
  EXPECT_EQ(check_sheets(spheres)[1].failed, 1u) << "the smaller one first";
  for (MedialSphere& s : spheres) s.sheet = -1;
  EXPECT_EQ(check_sheets(spheres)[1].failed, 1u) << "none";
}

// Where a sheet lies in the wall between two layers of voxels, both have points of it.
TEST(Sheets, ASheetInAWallCountsOnce) {
  std::vector<MedialSphere> below = square(10), above = square(10, 0, 1, 9);
  for (MedialSphere& s : below) s.centre[2] = 9 - 0.003;
  for (MedialSphere& s : above) s.centre[2] = 9 + 0.003;
  const Sheets sheets = find(together(below, above), SheetOptions());
  ASSERT_EQ(sheets.sheets.size(), 1u);
  EXPECT_NEAR(sheets.sheets[0].area, 64 + 36 / 2.0, 1e-6);
}

}  // namespace
}  // namespace medial_vk
