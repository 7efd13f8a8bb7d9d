// The colours of what was measured on the boundary, and the picture that shows them.
#include "output/boundary_colours/boundary_colours.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "output/colours/colour_map.h"
#include "output/picture/boundary_picture.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using Eigen::Vector3f;

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();
constexpr double kLarge = 1e12;

/// At every vertex the same.
BoundaryFields curved(std::size_t vertices, double kappa_1, double kappa_2) {
  VertexCurvature curvature;
  curvature.kappa = {kappa_1, kappa_2};
  curvature.directions = {Point{1, 0, 0}, Point{0, 1, 0}};
  BoundaryFields fields;
  add_curvature(fields, std::vector<VertexCurvature>(vertices, curvature), {});
  return fields;
}

void expect_colour(const Vector3f& colour, const Vector3f& expected) {
  // The arc cosine of doubles near -1 or 1 is off by the square root of their spacing, 2e-8; floats by 6e-8.
  EXPECT_LT((colour - expected).cwiseAbs().maxCoeff(), 1e-6f) << colour.transpose();
}

/// Figure 5-4: red, yellow, green, cyan, blue and white.
TEST(BoundaryColours, ShapesHaveThePublishedColours) {
  expect_colour(colour_of_shape(kLarge, kLarge, 1), {1, 0, 0});
  expect_colour(colour_of_shape(kLarge, 0, 1), {1, 1, 0});
  expect_colour(colour_of_shape(kLarge, -kLarge, 1), {0, 1, 0});
  expect_colour(colour_of_shape(0, -kLarge, 1), {0, 1, 1});
  expect_colour(colour_of_shape(-kLarge, -kLarge, 1), {0, 0, 1});
  expect_colour(colour_of_shape(0, 0, 1), {1, 1, 1});
}

TEST(BoundaryColours, OfShapesDoNotDependOnUnits) {
  EXPECT_EQ(colour_of_shape(2, -1, 3), colour_of_shape(2e-8, -1e-8, 3e8));
}

TEST(BoundaryColours, UnknownIsGreyInEveryColour) {
  const BoundaryFields fields = curved(2, kNotKnown, 1);
  for (const BoundaryColour by : {BoundaryColour::kKappa1, BoundaryColour::kShape}) {
    const BoundaryColours colours = colour_boundary(fields, by, 1);
    const Vector3f& grey = colours.of_vertices[0];
    EXPECT_EQ(grey[0], grey[1]);
    EXPECT_EQ(grey[1], grey[2]);
    EXPECT_LT(grey[0], 0.9f);
  }
  EXPECT_THAT(colour_boundary(fields, BoundaryColour::kKappa1, 1).title, testing::HasSubstr("grey: unknown"));
  EXPECT_EQ(colour_boundary(fields, BoundaryColour::kShape, 1).swatches.back().second, "unknown");
  EXPECT_THAT(colour_boundary(fields, BoundaryColour::kKappa2, 1).title, testing::Not(testing::HasSubstr("grey")));
}

TEST(BoundaryColours, NeedTheirFields) {
  EXPECT_TRUE(can_colour(curved(1, 1, 1), BoundaryColour::kShape));
  EXPECT_FALSE(can_colour(curved(1, 1, 1), BoundaryColour::kThickness));
  BoundaryFields thick;
  add_thickness(thick, std::vector<Thickness>(1));
  EXPECT_TRUE(can_colour(thick, BoundaryColour::kThickness));
  EXPECT_FALSE(can_colour(thick, BoundaryColour::kKappa2));
}

PictureOptions small_view() {
  PictureOptions options;
  options.size = {300, 200};
  options.view.towards = {0, 0, 1};
  return options;
}

/// Red, green and blue in the middle.
std::array<int, 3> middle_of(const Picture& picture) {
  const std::uint8_t* rgb = &picture.rgb[(std::size_t{picture.height} / 2 * picture.width + picture.width / 2) * 3];
  return {rgb[0], rgb[1], rgb[2]};
}

TEST(BoundaryPicture, ShowsTheColoursOfTheSurface) {
  const Mesh mesh = test::make_box({3, 2, 1});
  const auto middle = [&](double kappa_1, double kappa_2) {
    return middle_of(draw_boundary(mesh, curved(mesh.vertices.size(), kappa_1, kappa_2), BoundaryColour::kShape, false,
                                   small_view()));
  };
  const auto [red, of_red_green, of_red_blue] = middle(kLarge, kLarge);
  EXPECT_GT(red, 3 * of_red_green);
  EXPECT_GT(red, 3 * of_red_blue);
  const auto [of_blue_red, of_blue_green, blue] = middle(-kLarge, -kLarge);
  EXPECT_GT(blue, 3 * of_blue_red);
  EXPECT_GT(blue, 3 * of_blue_green);
  const auto [grey_red, grey_green, grey_blue] = middle(kNotKnown, kNotKnown);
  EXPECT_EQ(grey_red, grey_green);
  EXPECT_EQ(grey_green, grey_blue);
}

/// How many pixels have exactly the colour.
std::size_t count_pixels(const Picture& picture, const Vector3f& colour) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
    bool is_equal = true;
    for (std::size_t k = 0; k < 3; ++k) {
      is_equal = is_equal && picture.rgb[i + k] == picture::byte_of(colour[static_cast<Eigen::Index>(k)]);
    }
    count += is_equal ? 1 : 0;
  }
  return count;
}

/// A swatch has 7 x 7 pixels of the letters.
TEST(BoundaryPicture, ALegendThatIsTooWideHasSeveralRows) {
  const Mesh mesh = test::make_box({3, 2, 1});
  const BoundaryFields fields = curved(mesh.vertices.size(), kNotKnown, kNotKnown);
  for (const std::uint32_t width : {380u, 1200u}) {
    PictureOptions options = small_view();
    options.size = {width, 400};
    for (const bool strokes : {false, true}) {
      const Picture picture = draw_boundary(mesh, fields, BoundaryColour::kShape, strokes, options);
      for (const auto& [colour, name] : colour_boundary(fields, BoundaryColour::kShape, 1).swatches) {
        EXPECT_GE(count_pixels(picture, colour), 49u) << name << ", " << width;
      }
    }
  }
}

std::size_t differing_pixels(const Picture& a, const Picture& b, std::uint32_t rows) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < std::size_t{rows} * a.width; ++i) {
    count += a.rgb[3 * i] != b.rgb[3 * i] || a.rgb[3 * i + 1] != b.rgb[3 * i + 1] ? 1 : 0;
  }
  return count;
}

TEST(BoundaryPicture, StrokesAreOnTheSurfaceWhereDirectionsAreKnown) {
  const Mesh mesh = test::make_box({3, 2, 1});
  const std::uint32_t above_legend = 150;
  const BoundaryFields known = curved(mesh.vertices.size(), 1, 0);
  const Picture plain = draw_boundary(mesh, known, BoundaryColour::kShape, false, small_view());
  const Picture strokes = draw_boundary(mesh, known, BoundaryColour::kShape, true, small_view());
  EXPECT_GT(differing_pixels(plain, strokes, above_legend), 0u);
  VertexCurvature unknown;
  unknown.kappa = {1, 0};
  BoundaryFields without;
  add_curvature(without, std::vector<VertexCurvature>(mesh.vertices.size(), unknown), {});
  const Picture none = draw_boundary(mesh, without, BoundaryColour::kShape, true, small_view());
  EXPECT_EQ(differing_pixels(plain, none, above_legend), 0u);
}

}  // namespace
}  // namespace medial_vk
