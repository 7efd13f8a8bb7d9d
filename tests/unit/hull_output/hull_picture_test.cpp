// The picture of hulls: each in a colour of its own, in the place where it is, within the glass of the solid.
#include "output/hull_picture/hull_picture.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "support/hulls/hull_samples.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

/// Two capsules along z in a box of sides 2, seen along z: one left and one right of the middle of the picture.
class HullPicture : public testing::Test {
 protected:
  HullPicture() {
    options_.size = {300, 300};
    options_.view.towards = {0, 0, 1};
  }

  /// Red, green and blue of the middle of the picture, moved by a share of its width.
  std::array<int, 3> colour_at(const std::vector<BallHull>& hulls, double right) const {
    const Mesh box = test::make_box({2, 2, 2});
    const Picture picture = draw_hulls(test::record_of(hulls), test::view_of(box), options_).value();
    EXPECT_EQ(picture.width, 300u);
    const auto x = static_cast<std::size_t>((0.5 + right) * 300);
    const std::uint8_t* pixel = &picture.rgb[(std::size_t{130} * 300 + x) * 3];
    return {pixel[0], pixel[1], pixel[2]};
  }

  static BallHull capsule_at(double x) { return hull_of({{x, 1, 0.5}, 0.3}, {{x, 1, 1.5}, 0.3}); }

  PictureOptions options_;
};

TEST_F(HullPicture, EachHullHasItsColour) {
  const std::vector<BallHull> both = {capsule_at(0.6), capsule_at(1.4)};
  // The first colours are orange and sky blue: red, or blue, exceeds the other by far; glass and ground have neither.
  const std::array<int, 3> left = colour_at(both, -0.1), right = colour_at(both, 0.1);
  EXPECT_GT(left[0], left[2] + 80);
  EXPECT_GT(right[2], right[0] + 60);
  const std::array<int, 3> glass = colour_at({capsule_at(0.6)}, 0.1);
  EXPECT_LT(glass[2], glass[0] + 60);
  EXPECT_LT(glass[0], glass[2] + 60);
}

TEST_F(HullPicture, AHullWithoutVolumeIsNotSeen) {
  const BallHull needle = hull_of({{0.6, 1, 0.5}, 0}, {{0.6, 1, 1.5}, 0});
  EXPECT_EQ(colour_at({needle}, -0.1), colour_at({}, -0.1));
}

}  // namespace
}  // namespace medial_vk
