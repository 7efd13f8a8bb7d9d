// The contact sheet of a motion: a cell for each frame, in the same view, and balls in the colours of their states.
#include "output/picture/motion_picture.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "unit/output/motion_example.h"

namespace medial_vk {
namespace {

/// Pixels that are not white, in a cell above its legend.
long drawn_pixels(const Picture& sheet, std::uint32_t column, std::uint32_t row) {
  long drawn = 0;
  for (std::uint32_t y = 400 * row; y < 400 * row + 320; ++y) {
    for (std::uint32_t x = 480 * column; x < 480 * (column + 1); ++x) {
      const std::uint8_t* rgb = &sheet.rgb[(std::size_t{y} * sheet.width + x) * 3];
      drawn += rgb[0] + rgb[1] + rgb[2] < 3 * 250;
    }
  }
  return drawn;
}

/// From the leftmost dark pixel of a cell to the rightmost one, above its legend.
double outlined_width(const Picture& sheet, std::uint32_t column, std::uint32_t row) {
  std::uint32_t left = 480, right = 0;
  for (std::uint32_t y = 400 * row; y < 400 * row + 320; ++y) {
    for (std::uint32_t x = 0; x < 480; ++x) {
      const std::uint8_t* rgb = &sheet.rgb[(std::size_t{y} * sheet.width + 480 * column + x) * 3];
      if (rgb[0] + rgb[1] + rgb[2] > 3 * 190) continue;
      left = std::min(left, x);
      right = std::max(right, x);
    }
  }
  return static_cast<double>(right) - left;
}

TEST(MotionPicture, ACellPerFrameInTheSameView) {
  const MotionRecord record = test::motion_example();
  const Picture sheet = draw_motion(record, PictureView());
  EXPECT_EQ(sheet.width, 960u) << "two in a row";
  EXPECT_EQ(sheet.height, 800u);
  ASSERT_EQ(sheet.rgb.size(), std::size_t{960} * 800 * 3);
  const long rest = drawn_pixels(sheet, 0, 0), last = drawn_pixels(sheet, 0, 1);
  EXPECT_GT(rest, 1000);
  EXPECT_GT(last, rest);
  EXPECT_NEAR(outlined_width(sheet, 0, 1) / outlined_width(sheet, 0, 0), 1.25, 0.08) << "but for the perspective";
  EXPECT_EQ(drawn_pixels(sheet, 1, 1), 0) << "there is no fourth frame";
}

TEST(MotionPicture, ACoverIsDrawnWithoutItsUnusedBalls) {
  const MotionRecord cover = test::cover_motion_example();
  const Picture sheet = draw_motion(cover, PictureView());
  EXPECT_EQ(sheet.width, 960u);
  // The same balls as those of the record of balls inside, of which the one that is lost there is unused here.
  const Picture inside = draw_motion(test::motion_example(), PictureView());
  for (const std::uint32_t row : {0u, 1u}) EXPECT_EQ(drawn_pixels(sheet, 0, row), drawn_pixels(inside, 0, row));
  EXPECT_NE(sheet.rgb, inside.rgb) << "the words of the legend";
}

TEST(MotionPicture, FramesWithoutVerticesAreLeftOut) {
  MotionRecord record = test::motion_example();
  record.frames[1].vertices.clear();
  record.frames[2].vertices.clear();
  const Picture sheet = draw_motion(record, PictureView());
  EXPECT_EQ(sheet.width, 480u);
  EXPECT_EQ(sheet.height, 400u);
}

TEST(MotionPicture, OfManyFramesTwelveAreShown) {
  MotionRecord record = test::motion_example();
  record.frames.resize(2);
  for (int i = 0; i < 100; ++i) record.frames.push_back(record.frames[1]);
  const Picture sheet = draw_motion(record, PictureView());
  EXPECT_EQ(sheet.width, 1920u);
  EXPECT_EQ(sheet.height, 1200u);
}

}  // namespace
}  // namespace medial_vk
