// The picture of two solids: each has its colour, and its name in the letters of the font.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "output/picture/pair_picture.h"
#include "output/picture/panels/text.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

void append(const Mesh& mesh, Mesh& all) {
  const auto first = static_cast<std::uint32_t>(all.vertices.size());
  all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
  for (const Triangle& t : mesh.triangles) all.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

/// A box to the left, and one to the right, seen from the front.
PairPicture two_boxes() {
  PairPicture pair;
  const Mesh left = test::make_box({1, 1, 1});
  Mesh right = left;
  test::translate(right, {1.5, 0, 0});
  append(left, pair.mesh);
  append(right, pair.mesh);
  pair.triangles_of_a = pair.triangles_of_b = left.triangles.size();
  return pair;
}

constexpr PictureView kFront = {{0, 0, 1}, UpAxis::kY};

/// The sum of red less blue over a half of the picture, above the legend.
long warmth(const Picture& picture, bool of_right) {
  long sum = 0;
  for (std::size_t y = 0; y < 700; ++y) {
    for (std::size_t x = of_right ? 600 : 0; x < (of_right ? 1200u : 600u); ++x) {
      const std::uint8_t* rgb = &picture.rgb[(y * picture.width + x) * 3];
      sum += long{rgb[0]} - long{rgb[2]};
    }
  }
  return sum;
}

TEST(PairPicture, EachSolidHasItsColour) {
  PairPicture pair = two_boxes();
  const Picture picture = draw_pair(pair, kFront);
  ASSERT_EQ(picture.width, 1200u);
  EXPECT_GT(warmth(picture, false), 100'000);
  EXPECT_LT(warmth(picture, true), -100'000);
  // The rest has the colour of glass, colder than the first solid and warmer than the second.
  pair.triangles_of_a = pair.triangles_of_b = 0;
  const Picture plain = draw_pair(pair, kFront);
  EXPECT_LT(warmth(plain, false), warmth(picture, false));
  EXPECT_GT(warmth(plain, true), warmth(picture, true));
}

TEST(PairPicture, NamesOfAnyLengthAndLettersAreDrawn) {
  PairPicture pair = two_boxes();
  std::set<std::vector<std::uint8_t>> pictures;
  for (const char* name : {"a", "\xc3\xa4", "a name that is much too long for the legend of a picture \xff\xfe"}) {
    pair.name_a = name;
    pictures.insert(draw_pair(pair, kFront).rgb);
  }
  EXPECT_EQ(pictures.size(), 3u);
}

/// The pixels above the legend that differ.
std::vector<std::array<std::size_t, 2>> changed_pixels(const Picture& before, const Picture& after) {
  std::vector<std::array<std::size_t, 2>> changed;
  for (std::size_t y = 0; y < 780; ++y) {
    for (std::size_t x = 0; x < before.width; ++x) {
      const std::size_t at = (y * before.width + x) * 3;
      if (!std::equal(&before.rgb[at], &before.rgb[at] + 3, &after.rgb[at])) changed.push_back({x, y});
    }
  }
  return changed;
}

/// The point is in the middle of two balls that cover each other, in the middle of the picture of a box.
TEST(PairPicture, ACommonPointShowsThroughBalls) {
  PairPicture pair;
  const Mesh box = test::make_box({1, 1, 1});
  append(box, pair.mesh);
  append(box, pair.mesh);
  pair.triangles_of_a = pair.triangles_of_b = pair.mesh.triangles.size() / 2;
  pair.inside_a = pair.inside_b = {{{0.5, 0.5, 0.5}, 0.5}};
  const Picture without = draw_pair(pair, kFront);
  pair.on_a = pair.on_b = {0.5, 0.5, 0.5};
  pair.has_points = pair.is_hit = true;
  const auto changed = changed_pixels(without, draw_pair(pair, kFront));
  // A disc of about a 57th of the width of the box, and its rims.
  EXPECT_GT(changed.size(), 100u);
  double x = 0, y = 0;
  for (const auto& pixel : changed) {
    x += static_cast<double>(pixel[0]) / static_cast<double>(changed.size());
    y += static_cast<double>(pixel[1]) / static_cast<double>(changed.size());
  }
  for (const auto& pixel : changed) {
    EXPECT_LT(std::hypot(static_cast<double>(pixel[0]) - x, static_cast<double>(pixel[1]) - y), 30);
  }
  EXPECT_NEAR(x, 600, 2);
}

/// A small ball of one solid in the middle of a large one of the other: it is seen as if it were alone, but for a few
/// wires in front of it.
TEST(PairPicture, ABallThatHoldsOneOfTheOtherSolidDoesNotHideIt) {
  PairPicture pair;
  const Mesh box = test::make_box({1, 1, 1});
  append(box, pair.mesh);
  append(box, pair.mesh);
  pair.triangles_of_a = pair.triangles_of_b = pair.mesh.triangles.size() / 2;
  const Picture without = draw_pair(pair, kFront);
  const std::vector<Ball> large = {{{0.5, 0.5, 0.5}, 0.45}}, small = {{{0.5, 0.5, 0.5}, 0.1}};
  for (const bool is_a_large : {true, false}) {
    auto& outer = is_a_large ? pair.inside_a : pair.inside_b;
    auto& inner = is_a_large ? pair.inside_b : pair.inside_a;
    outer.clear();
    inner = small;
    const Picture alone = draw_pair(pair, kFront);
    outer = large;
    const Picture both = draw_pair(pair, kFront);
    std::size_t seen = 0, same = 0;
    for (const auto& [x, y] : changed_pixels(without, alone)) {
      const std::size_t at = (y * alone.width + x) * 3;
      ++seen;
      same += std::equal(&alone.rgb[at], &alone.rgb[at] + 3, &both.rgb[at]) ? 1 : 0;
    }
    EXPECT_GT(seen, 5000u);
    EXPECT_GT(same, seen / 2);
    EXPECT_GT(changed_pixels(alone, both).size(), 1000u);  // there are wires
  }
}

/// Small balls of large solids are not hidden by the point.
TEST(PairPicture, PointsAreSmallerThanBalls) {
  PairPicture pair = two_boxes();
  pair.on_a = pair.on_b = {0.5, 0.5, 0.5};
  const auto pixels_of_point = [&](double radius) {
    pair.inside_a = pair.inside_b = {{{0.5, 0.5, 0.5}, radius}};
    pair.has_points = pair.is_hit = false;
    const Picture before = draw_pair(pair, kFront);
    pair.has_points = pair.is_hit = true;
    return changed_pixels(before, draw_pair(pair, kFront)).size();
  };
  const std::size_t of_large = pixels_of_point(0.4), of_small = pixels_of_point(0.03);
  EXPECT_GT(of_small, 20u);
  EXPECT_LT(3 * of_small, of_large);
}

/// The legend says which balls are solid and which are rings, if there are any, and whether they decided.
TEST(PairPicture, TheLegendNamesTheBallsThatAreDrawn) {
  PairPicture pair = two_boxes();
  const std::vector<Ball> one = {{{0.5, 0.5, 0.5}, 0.4}};
  const auto legend_of = [&](const std::vector<Ball>& inside, const std::vector<Ball>& cover) {
    pair.inside_a = inside;
    pair.cover_a = cover;
    const std::vector<std::uint8_t> rgb = draw_pair(pair, kFront).rgb;
    return std::vector<std::uint8_t>(rgb.begin() + 850 * 1200 * 3, rgb.end());
  };
  const std::set<std::vector<std::uint8_t>> legends = {legend_of({}, {}), legend_of(one, {}), legend_of({}, one),
                                                       legend_of(one, one)};
  EXPECT_EQ(legends.size(), 4u);
  const auto decided = legend_of(one, one);
  pair.balls_decide = false;
  EXPECT_NE(legend_of(one, one), decided);
  const auto no_balls = legend_of({}, {});
  pair.balls_decide = true;
  EXPECT_EQ(legend_of({}, {}), no_balls);
}

std::set<std::pair<std::uint32_t, std::uint32_t>> pixels_of(const std::string& text) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> pixels;
  picture::draw_text(text, [&](std::uint32_t x, std::uint32_t y) { pixels.emplace(x, y); });
  return pixels;
}

TEST(PictureText, HasTheLettersOfAsciiAndABoxForOthers) {
  const auto box = pixels_of("\xc3\xa4");
  EXPECT_FALSE(box.empty());
  EXPECT_TRUE(pixels_of(" ").empty());
  std::set<std::set<std::pair<std::uint32_t, std::uint32_t>>> glyphs;
  const std::string letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_/:.,-+()%";
  for (const char letter : letters) {
    EXPECT_NE(pixels_of({letter}), box) << letter;
    glyphs.insert(pixels_of({letter}));
  }
  EXPECT_EQ(glyphs.size(), letters.size());  // no two are the same
}

TEST(PictureText, IsAsWideAsItsCharacters) {
  EXPECT_EQ(picture::text_width("ab"), 2 * picture::kGlyphWidth);
  EXPECT_EQ(picture::text_width("\xc3\xa4\xe2\x82\xac"), 2 * picture::kGlyphWidth);
  for (const auto& [x, y] : pixels_of("\xc3\xa4\xe2\x82\xac")) {
    EXPECT_LT(x, picture::text_width("\xc3\xa4\xe2\x82\xac"));
    EXPECT_LT(y, picture::kGlyphHeight);
  }
}

}  // namespace
}  // namespace medial_vk
