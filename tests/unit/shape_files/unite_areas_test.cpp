// The union of areas: each by its own rule, convex ones without preparation.
#include <random>

#include "shape_files/areas/shape_area.h"
#include "unit/shape_files/read_for_tests.h"

namespace medial_vk {
namespace {

double united_area(std::vector<ShapeArea> areas) {
  const Result<UnitedAreas> united = unite_areas(std::move(areas), 1, {});
  EXPECT_TRUE(united.ok());
  if (!united.ok()) return 0;
  const Result<PreparedShape> shape = prepare_shape(united.value().rings, united.value().rule);
  EXPECT_TRUE(shape.ok());
  return shape.ok() ? shape.value().report.area : 0;
}

PlaneRing regular(int corners, int step, double shift, bool reversed) {
  PlaneRing ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::acos(-1.0) * i * step / corners * (reversed ? -1 : 1);
    ring.push_back({shift + std::cos(angle), std::sin(angle)});
  }
  return ring;
}

const ShapeArea kFarSquare = {{{{50, 0}, {51, 0}, {51, 1}, {50, 1}}}, FillRule::kEvenOdd};

/// A hexagon of either sense, and two that overlap in half of each: by hand, 3/2 sqrt(3) is one.
TEST(UniteAreas, OfEitherSense) {
  const double hexagon = 1.5 * std::sqrt(3.0);
  for (const bool reversed : {false, true}) {
    const ShapeArea first = {{regular(6, 1, 0, reversed)}, FillRule::kNonZero};
    const ShapeArea second = {{regular(6, 1, 0, !reversed)}, FillRule::kNonZero};
    EXPECT_NEAR(united_area({first, second}), hexagon, 1e-14);
    EXPECT_NEAR(united_area({first, kFarSquare}), hexagon + 1, 1e-14);
  }
}

/// A star goes round twice with all corners to the left: it is not convex, and its rule matters.
TEST(UniteAreas, AStarIsNotTakenForConvex) {
  const PlaneRing star = regular(5, 2, 0, false);
  const double all = united_area({{{star}, FillRule::kNonZero}, kFarSquare}) - 1;
  const double tips = united_area({{{star}, FillRule::kEvenOdd}, kFarSquare}) - 1;
  const double inner = std::cos(0.4 * std::acos(-1.0)) / std::cos(0.2 * std::acos(-1.0));  // of the inner pentagon
  const double pentagon = 2.5 * inner * inner * std::sin(0.4 * std::acos(-1.0));
  EXPECT_NEAR(all - tips, pentagon, 1e-13);
  EXPECT_NEAR(all, 5 * inner * std::sin(0.2 * std::acos(-1.0)), 1e-13);
}

/// The same area as all rings of it prepared alone, for random rings: convex ones, and others.
TEST(UniteAreas, IsThatOfEachAreaWhereTheyAreApart) {
  std::mt19937 random(33);
  std::uniform_real_distribution<double> range(-1, 1);
  for (int i = 0; i < 300; ++i) {
    PlaneRing ring;
    for (int k = 0; k < 3 + i % 4; ++k) ring.push_back({range(random), range(random)});
    const FillRule rule = i % 2 == 0 ? FillRule::kNonZero : FillRule::kEvenOdd;
    const Result<PreparedShape> alone = prepare_shape(std::vector<PlaneRing>{ring}, rule);
    ASSERT_TRUE(alone.ok());
    EXPECT_NEAR(united_area({{{ring}, rule}, kFarSquare}), alone.value().report.area + 1, 1e-11) << i;
  }
}

TEST(UniteAreas, HolesThatTouchAtACornerStay) {
  const ShapeArea area = {
      {{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{1, 1}, {2, 1}, {2, 2}, {1, 2}}, {{2, 2}, {3, 2}, {3, 3}, {2, 3}}},
      FillRule::kEvenOdd};
  EXPECT_EQ(united_area({area, kFarSquare}), 15);
}

TEST(UniteAreas, NothingIsAnError) {
  for (const std::vector<ShapeArea>& areas :
       {std::vector<ShapeArea>{}, std::vector<ShapeArea>{{{{{0, 0}, {1, 1}}}, FillRule::kEvenOdd}},
        std::vector<ShapeArea>{{{}, FillRule::kEvenOdd}, {{{{0, 0}, {1, 1}, {2, 2}}}, FillRule::kNonZero}}}) {
    const Result<UnitedAreas> united = unite_areas(areas, 1, {});
    ASSERT_FALSE(united.ok());
    EXPECT_EQ(united.error().message, "no area of it encloses anything");
  }
}

}  // namespace
}  // namespace medial_vk
