// The picture: it is not empty, always the same, and shows the points.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <span>

#include "output/picture/picture.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

constexpr PictureOptions kSmall = {.size = {400, 300}};

/// A flat sheet of points half way up a box.
std::vector<MedialSphere> sheet_in_box() {
  std::vector<MedialSphere> spheres;
  for (int i = 0; i < 400; ++i) {
    MedialSphere sphere;
    sphere.centre = {0.3 + 0.07 * (i % 20), 0.5, 0.3 + 0.07 * (i / 20)};
    sphere.radius = 0.5;
    sphere.spoke_a = {0, 1, 0};
    sphere.spoke_b = {0, -1, 0};
    sphere.object_angle = 0.6f + 0.04f * static_cast<float>(i % 20);
    spheres.push_back(sphere);
  }
  return spheres;
}

std::size_t distinct_colours(const Picture& picture) {
  std::set<std::array<std::uint8_t, 3>> colours;
  for (std::size_t i = 0; i + 2 < picture.rgb.size(); i += 3) {
    colours.insert({picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2]});
  }
  return colours.size();
}

std::size_t different_pixels(const Picture& a, const Picture& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i + 2 < a.rgb.size(); i += 3) {
    count += std::equal(a.rgb.begin() + i, a.rgb.begin() + i + 3, b.rgb.begin() + i) ? 0 : 1;
  }
  return count;
}

TEST(PictureDraw, HasTheRequestedSizeAndIsNotEmpty) {
  const Picture picture = draw_picture(test::make_box({2, 1, 2}), sheet_in_box(), 0.07, kSmall);
  EXPECT_EQ(picture.width, 400u);
  EXPECT_EQ(picture.height, 300u);
  ASSERT_EQ(picture.rgb.size(), 400u * 300u * 3u);
  EXPECT_GT(distinct_colours(picture), 200u);
}

TEST(PictureDraw, IsDeterministic) {
  const Mesh mesh = test::make_box({2, 1, 2});
  EXPECT_EQ(draw_picture(mesh, sheet_in_box(), 0.07, kSmall).rgb, draw_picture(mesh, sheet_in_box(), 0.07, kSmall).rgb);
}

TEST(PictureDraw, PointsAndMeshAreBothSeen) {
  const Mesh mesh = test::make_box({2, 1, 2});
  const Picture both = draw_picture(mesh, sheet_in_box(), 0.07, kSmall);
  const Picture only_mesh = draw_picture(mesh, {}, 0.07, kSmall);
  const Picture nothing = draw_picture({}, {}, 0.07, kSmall);
  EXPECT_GT(different_pixels(both, only_mesh), 2000u);
  EXPECT_GT(different_pixels(only_mesh, nothing), 20000u);
}

TEST(PictureDraw, DoesNotDependOnUnitsOrPlace) {
  // A power of two and an offset that doubles represent exactly: only the rounding to float inside the camera remains.
  Mesh mesh = test::make_box({2, 1, 2});
  std::vector<MedialSphere> spheres = sheet_in_box();
  const Picture near = draw_picture(mesh, spheres, 0.07, kSmall);
  test::scale(mesh, 1024);
  test::translate(mesh, {1 << 20, 0, -(1 << 20)});
  for (MedialSphere& sphere : spheres) {
    for (double& x : sphere.centre) x *= 1024;
    sphere.centre[0] += 1 << 20;
    sphere.centre[2] -= 1 << 20;
    sphere.radius *= 1024;
  }
  const Picture far = draw_picture(mesh, spheres, 0.07 * 1024, kSmall);
  EXPECT_LT(different_pixels(near, far), 100u);
}

TEST(PictureDraw, PanelsShareThePicture) {
  PictureOptions options = kSmall;
  options.show = PictureShow::kBoth;
  const Picture both = draw_picture(test::make_box({2, 1, 2}), sheet_in_box(), 0.07, options);
  options.show = PictureShow::kBalls;
  options.size[0] /= 2;
  const Picture balls = draw_picture(test::make_box({2, 1, 2}), sheet_in_box(), 0.07, options);
  std::size_t different = 0;
  for (std::uint32_t y = 0; y < 200; ++y) {  // above the legend
    for (std::uint32_t x = 0; x < 600; ++x) {
      different += both.rgb[(y * 400 + 200) * 3 + x] == balls.rgb[y * 200 * 3 + x] ? 0 : 1;
    }
  }
  EXPECT_EQ(different, 0u);
}

/// Of the pixels at the sides of the picture.
std::size_t different_at_sides(const Picture& a, const Picture& b) {
  std::size_t count = 0;
  for (std::size_t y = 0; y < a.height; ++y) {
    const std::size_t step = y == 0 || y + 1 == a.height ? 1 : a.width - 1;
    for (std::size_t x = 0; x < a.width; x += step) {
      const auto at = static_cast<std::ptrdiff_t>(3 * (y * a.width + x));
      count += std::equal(a.rgb.begin() + at, a.rgb.begin() + at + 3, b.rgb.begin() + at) ? 0 : 1;
    }
  }
  return count;
}

TEST(PictureDraw, BallsOutsideAreInTheFrame) {
  PictureOptions options = kSmall;
  options.show = PictureShow::kBalls;
  MedialSphere beside;
  beside.centre = {5, 0.5, 1};
  beside.radius = 3;
  const Mesh box = test::make_box({2, 1, 2});
  const Picture nothing = draw_picture({}, {}, 0.07, options);
  EXPECT_GT(different_at_sides(draw_picture(box, std::span(&beside, 1), 0.07, options), nothing), 100u);
  options.frame_points = true;
  const Picture framed = draw_picture(box, std::span(&beside, 1), 0.07, options);
  EXPECT_EQ(different_at_sides(framed, nothing), 0u);
  EXPECT_GT(different_pixels(framed, nothing), 20000u);
}

TEST(PictureDraw, EveryViewIsDrawn) {
  const Mesh mesh = test::make_box({2, 1, 3});
  PictureOptions options = kSmall;
  std::set<std::string> pictures;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0, 1e-5}) {  // however short
      options.view.towards = {0, 0, 0};
      options.view.towards[axis] = sign;
      const Picture picture = draw_picture(mesh, sheet_in_box(), 0.07, options);
      pictures.emplace(picture.rgb.begin(), picture.rgb.end());
    }
  }
  // The points are not in the middle of the longest side; along the others they are.
  EXPECT_EQ(pictures.size(), 6u);
}

/// A box that was turned, with the same axis up as before, keeps its appearance, also from above and below.
TEST(PictureDraw, ATurnedShapeWithItsOwnUpLooksTheSame) {
  using Direction = std::array<double, 3>;
  for (const Direction& from : {PictureView().towards, Direction{0, 1, 0}, Direction{0, -1, 0}}) {
    PictureOptions options = kSmall;
    options.view.towards = from;
    const Picture upright = draw_picture(test::make_box({2, 1, 3}), sheet_in_box(), 0.07, options);
    for (const UpAxis up : {UpAxis::kX, UpAxis::kZ, UpAxis::kMinusX, UpAxis::kMinusY, UpAxis::kMinusZ}) {
      Mesh mesh = test::make_box({2, 1, 3});
      std::vector<MedialSphere> spheres = sheet_in_box();
      for (Point& vertex : mesh.vertices) vertex = in_mesh_axes(vertex, up);
      for (MedialSphere& sphere : spheres) {
        sphere.centre = in_mesh_axes(sphere.centre, up);
        const Direction spoke = in_mesh_axes({0, 1, 0}, up);
        for (int k = 0; k < 3; ++k) sphere.spoke_a[k] = static_cast<float>(spoke[k]);
        for (int k = 0; k < 3; ++k) sphere.spoke_b[k] = -sphere.spoke_a[k];
      }
      options.view = {in_mesh_axes(from, up), up};
      EXPECT_LT(different_pixels(draw_picture(mesh, spheres, 0.07, options), upright), 100u) << axis_name(up);
    }
  }
}

TEST(PictureDraw, DegenerateInputIsNoError) {
  Mesh point;
  point.vertices = {{1, 1, 1}};
  EXPECT_EQ(draw_picture(point, {}, 0, kSmall).rgb.size(), 400u * 300u * 3u);
  Mesh flat;
  flat.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  flat.triangles = {{0, 1, 2}};
  EXPECT_EQ(draw_picture(flat, {}, 0.1, {.size = {8, 8}}).rgb.size(), 8u * 8u * 3u);
}

TEST(PictureDraw, PngHasItsSignatureAndSize) {
  const Picture picture = draw_picture(test::make_box({1, 1, 1}), {}, 0.1, kSmall);
  const Result<std::string> png = encode_png(picture);
  ASSERT_TRUE(png.ok());
  ASSERT_GT(png.value().size(), 33u);
  EXPECT_EQ(png.value().substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(png.value().substr(12, 4), "IHDR");
  EXPECT_EQ(png.value().substr(16, 8), std::string("\0\0\x01\x90\0\0\x01\x2c", 8));  // 400 x 300, big-endian.
}

}  // namespace
}  // namespace medial_vk
