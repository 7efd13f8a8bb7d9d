// The picture of a body: the balls inside in the left half, those that cover in the right one, each in its colour.
#include <gtest/gtest.h>

#include <vector>

#include "output/picture/body_picture.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

constexpr PictureView kFromTheFront = {{0, 0, 1}, UpAxis::kY};

/// The sum of red less blue over a half of the picture, above the legend.
long warmth_of_half(const Picture& picture, bool right) {
  long sum = 0;
  const std::size_t half = picture.width / 2;
  for (std::size_t y = 0; y < 700; ++y) {
    for (std::size_t x = right ? half : 0; x < (right ? 2 * half : half); ++x) {
      const std::uint8_t* rgb = &picture.rgb[(y * picture.width + x) * 3];
      sum += long{rgb[0]} - long{rgb[2]};
    }
  }
  return sum;
}

TEST(BodyPicture, ShowsBothSets) {
  const Mesh box = test::make_box({1, 1, 1});
  const std::vector<Ball> inside = {{{0.5, 0.5, 0.5}, 0.5}}, cover = {{{0.5, 0.5, 0.5}, 0.9}};
  const Picture both = draw_body(box, inside, cover, kFromTheFront);
  ASSERT_EQ(both.width, 1800u);
  ASSERT_EQ(both.rgb.size(), std::size_t{1800} * 900 * 3);
  const Picture no_inside = draw_body(box, {}, cover, kFromTheFront);
  const Picture no_cover = draw_body(box, inside, {}, kFromTheFront);
  // The balls inside are orange, those of the cover blue, and the glass behind has hardly a colour.
  EXPECT_GT(warmth_of_half(both, false), warmth_of_half(no_inside, false) + 1'000'000);
  EXPECT_LT(warmth_of_half(both, true), warmth_of_half(no_cover, true) - 1'000'000);
  EXPECT_EQ(warmth_of_half(both, true), warmth_of_half(no_inside, true));
  EXPECT_EQ(warmth_of_half(both, false), warmth_of_half(no_cover, false));
}

}  // namespace
}  // namespace medial_vk
