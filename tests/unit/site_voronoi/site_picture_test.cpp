// The picture of a surface between sites: without gaps, in the colour of its pair, with or without faces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "medial_vk/site_voronoi.h"
#include "output/site_picture/site_picture.h"

namespace medial_vk::test {
namespace {

/// The plane x = 1 between two points, seen along x: a square around the middle of the picture.
class PictureOfAPlane : public testing::Test {
 protected:
  void SetUp() override {
    sites_.resize(2);
    sites_[0].points = {{0, 0, 0}};
    sites_[1].points = {{2, 0, 0}};
    record_.sites = {{"left", "point", 1}, {"right", "point", 1}};
    record_.options.resolution = 40;
    record_.options.margin = 1;
    record_.voronoi = find_site_voronoi(sites_, record_.options).value();
    options_.size = {400, 400};
    options_.view.towards = {1, 0, 0};
  }

  /// The square has sides of 2 in a box with a diagonal of 4.9, which the picture holds: it is 0.28 of the picture wide
  /// at least. Within a fifth of the picture around its middle: the pixels whose red does not exceed their blue by half
  /// of what it does in the first colour of sheets, (230, 159, 0). Ground and glass are grey, or blue.
  int pixels_without_the_colour() const {
    const Picture picture = draw_sites(record_, sites_, options_);
    int others = 0;
    const std::uint32_t middle_x = picture.width / 2, reach = picture.width / 10;
    const std::uint32_t middle_y = middle_of_square(picture);
    for (std::uint32_t y = middle_y - reach; y < middle_y + reach; ++y) {
      // The site in front of the plane is drawn before it, in the middle: its height is below 0.06 of the box.
      if (y + 12 > middle_y && y < middle_y + 12) continue;
      for (std::uint32_t x = middle_x - reach; x < middle_x + reach; ++x) {
        const std::uint8_t* pixel = &picture.rgb[(std::size_t{y} * picture.width + x) * 3];
        if (pixel[0] - pixel[2] < 115) ++others;
      }
    }
    return others;
  }

  /// The middle of the coloured pixels in the column beside the sites, above the legend.
  static std::uint32_t middle_of_square(const Picture& picture) {
    std::uint32_t first = picture.height, last = 0;
    for (std::uint32_t y = 0; y < picture.height * 17 / 20; ++y) {
      const std::uint8_t* pixel = &picture.rgb[(std::size_t{y} * picture.width + picture.width / 2 + 20) * 3];
      if (pixel[2] > 215) continue;  // the ground
      first = std::min(first, y);
      last = y;
    }
    return (first + last) / 2;
  }

  std::vector<VoronoiSite> sites_;
  SiteRecord record_;
  PictureOptions options_;
};

TEST_F(PictureOfAPlane, FacesHaveTheColourOfTheirPairWithoutGaps) {
  ASSERT_FALSE(record_.voronoi.faces.empty());
  EXPECT_EQ(pixels_without_the_colour(), 0);
}

TEST_F(PictureOfAPlane, PointsWithoutFacesAreDiscsThatCloseTheGaps) {
  record_.voronoi.faces.clear();
  EXPECT_EQ(pixels_without_the_colour(), 0);
}

}  // namespace
}  // namespace medial_vk::test
