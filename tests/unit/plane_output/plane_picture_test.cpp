// Pictures of shapes in the plane.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "output/plane_picture/canvas.h"
#include "output/plane_picture/plane_picture.h"
#include "unit/plane_centre_lines/axes_of_shapes.h"

namespace medial_vk {
namespace {

using test::rectangle_ring;

PlaneRecord drawn_record(const std::vector<PlaneRing>& rings) {
  PlaneRecord record;
  record.shape = prepare_shape(rings, FillRule::kEvenOdd).value();
  record.axis = find_plane_axis(record.shape, record.options).value();
  for (const AxisBranch& branch : record.axis.branches)
    record.lines.push_back(sample_branch(record.axis, branch, 1e-3));
  return record;
}

std::array<int, 3> pixel(const Picture& picture, double x, double y) {
  const std::size_t at = (static_cast<std::size_t>(y) * picture.width + static_cast<std::size_t>(x)) * 3;
  return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}

bool is_white(const std::array<int, 3>& p) { return p == std::array<int, 3>{255, 255, 255}; }
/// Pale and a little blue.
bool is_glass(const std::array<int, 3>& p) { return p[0] >= 200 && p[2] > p[0] && !is_white(p); }
/// The end of the colours, where the radius is the greatest: more yellow than blue.
bool is_yellow(const std::array<int, 3>& p) { return p[0] > 150 && p[1] > 180 && p[2] < 120; }

TEST(PlanePicture, ShowsTheShapeItsHolesAndTheAxis) {
  // 1472 pixels for 4 units: 368 for one, from (64, 64).
  const Picture picture = draw_plane(drawn_record({rectangle_ring(0, 0, 4, 2), rectangle_ring(3, 0.5, 0.5, 0.5)}));
  ASSERT_EQ(picture.width, 1600u);
  ASSERT_EQ(picture.height, 2 * 368u + 2 * 64 + 170);
  const auto at = [&](double x, double y) { return pixel(picture, 64 + 368 * x, 64 + 368 * (2 - y)); };
  EXPECT_TRUE(is_white(at(-0.1, 1)));
  EXPECT_TRUE(is_white(at(3.25, 0.75)));  // the hole, and up is up
  EXPECT_TRUE(is_glass(at(3.25, 1.3)) || is_glass(at(3.4, 1.2)));
  EXPECT_TRUE(is_glass(at(0.7, 1)));
  EXPECT_TRUE(is_yellow(at(1.3, 1)));  // in the middle, of radius 1
}

TEST(PlanePicture, IsTheSameEveryTimeAndOfAnyProportion) {
  const auto record = drawn_record({rectangle_ring(0, 0, 0.01, 5)});
  const Picture tall = draw_plane(record), again = draw_plane(record);
  EXPECT_EQ(tall.rgb, again.rgb);
  EXPECT_EQ(tall.width, 1600u);
  EXPECT_LE(tall.height, 1500u);
  const Picture wide = draw_plane(drawn_record({rectangle_ring(1e9, -1e9, 5, 0.01)}));
  EXPECT_EQ(wide.height, 600u);
}

TEST(PlanePicture, DepthsAreDistancesFromTheOutside) {
  const std::vector<picture::AreaEdge> square = {
      {{3, 3}, {13, 3}}, {{13, 3}, {13, 13}}, {{13, 13}, {3, 13}}, {{3, 13}, {3, 3}}};
  const std::vector<bool> inside = picture::inside_of(square, 16, 16);
  EXPECT_EQ(std::ranges::count(inside, true), 100);
  const std::vector<float> depths = picture::depths_of(inside, 16, 16);
  for (std::size_t y = 0; y < 16; ++y) {
    for (std::size_t x = 0; x < 16; ++x) {
      float least = 1e9f;
      for (std::size_t k = 0; k < 256; ++k) {
        if (inside[k]) continue;
        const float dx = static_cast<float>(k % 16) - static_cast<float>(x),
                    dy = static_cast<float>(k / 16) - static_cast<float>(y);
        least = std::min(least, std::hypot(dx, dy));
      }
      EXPECT_NEAR(depths[y * 16 + x], inside[y * 16 + x] ? least : 0, 1e-5);
    }
  }
}

}  // namespace
}  // namespace medial_vk
