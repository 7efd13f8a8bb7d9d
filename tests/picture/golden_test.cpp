// Pictures keep their appearance: drawn on the CPU and on a device, against files in tests/golden. The files are
// redrawn by the CPU if MEDIAL_VK_UPDATE_GOLDEN is set; inspect them before they are committed.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>

#include "output/picture/panels/panel.h"
#include "output/picture/vulkan/device_painter.h"
#include "picture/perceptual.h"
#include "picture/tolerance.h"
#include "support/device/device.h"
#include "support/solids/smooth_solids.h"
#include "support/solids/solids.h"
#include "support/source_folder.h"

namespace medial_vk {
namespace {

struct GoldenScene {
  const char* name;
  Mesh mesh;
  std::vector<MedialSphere> spheres;
  double voxel_size;
  PictureOptions options;
};

/// Names a failure in the output of the tests.
void PrintTo(const GoldenScene& scene, std::ostream* out) { *out << scene.name; }

MedialSphere sphere_of(const test::SmoothMedialPoint& point, std::int32_t sheet) {
  MedialSphere sphere;
  const Eigen::Vector3d across = point.on_curve ? point.spoke : point.spoke.dot(point.axis) * point.axis;
  for (int k = 0; k < 3; ++k) {
    sphere.centre[k] = point.point[k];
    sphere.spoke_a[k] = static_cast<float>(point.spoke[k]);
    sphere.spoke_b[k] = static_cast<float>(point.spoke[k] - 2 * across[k]);
  }
  sphere.radius = point.radius;
  sphere.object_angle = static_cast<float>(point.object_angle());
  sphere.sheet = sheet;
  return sphere;
}

GoldenScene scene_of(const char* name, const test::SmoothSolid& solid, double spacing, const PictureOptions& options) {
  GoldenScene scene = {name, solid.mesh(4000), {}, spacing, options};
  for (const test::SmoothMedialPoint& point : solid.medial_points(spacing)) {
    scene.spheres.push_back(sphere_of(point, point.point[0] < 0 ? 0 : 1));
  }
  return scene;
}

GoldenScene points_by_angle() {
  return scene_of("points_by_angle", *test::smooth_ellipsoid(1.5, 1, 0.5), 0.05, {.size = {240, 180}});
}

GoldenScene both_by_radius() {
  return scene_of(
      "both_by_radius", *test::smooth_pear(0.3, 0.7, 1.6), 0.05,
      {.size = {320, 180}, .view = {{1, 0.4, 0.3}}, .show = PictureShow::kBoth, .colour = PictureColour::kRadius});
}

GoldenScene balls_by_sheet() {
  return scene_of(
      "balls_by_sheet", *test::smooth_torus(1, 0.4), 0.3,
      {.size = {240, 180}, .view = {{0.3, -0.5, 1}}, .show = PictureShow::kBalls, .colour = PictureColour::kSheet});
}

/// A box with creases, seen from above, where another direction is up.
GoldenScene box_from_above() {
  GoldenScene scene = {"box_from_above", test::make_box({2, 1, 1}), {}, 0.1, {.size = {240, 180}, .view = {{0, 1, 0}}}};
  for (int i = 0; i < 100; ++i) {
    MedialSphere sphere;
    sphere.centre = {0.55 + 0.1 * (i % 10), 0.5, 0.1 + 0.08 * (i / 10)};
    sphere.radius = 0.1;
    sphere.spoke_a = {0, 1, 0};
    sphere.spoke_b = {0, -1, 0};
    sphere.object_angle = 0.6f + 0.1f * static_cast<float>(i % 10);
    scene.spheres.push_back(sphere);
  }
  return scene;
}

Picture on_cpu(const GoldenScene& scene) {
  return draw_picture(scene.mesh, scene.spheres, scene.voxel_size, scene.options);
}

std::string golden_file(const GoldenScene& scene) {
  return test::source_folder() / "tests" / "golden" / (scene.name + std::string(".png"));
}

Picture golden(const GoldenScene& scene) {
  if (std::getenv("MEDIAL_VK_UPDATE_GOLDEN") != nullptr) {
    const Result<std::string> png = encode_png(on_cpu(scene));
    std::ofstream(golden_file(scene), std::ios::binary) << png.value();
  }
  Result<Picture> picture = test::read_png(golden_file(scene));
  EXPECT_TRUE(picture.ok()) << picture.error().message;
  return picture.ok() ? std::move(picture).value() : Picture{};
}

class Golden : public testing::TestWithParam<GoldenScene> {};

TEST_P(Golden, OnTheCpu) { test::expect_same_look(on_cpu(GetParam()), golden(GetParam()), test::kSameSamples); }

/// Draws on the device of the tests, with validation if the layer is installed.
Picture on_device(const GoldenScene& scene, std::uint32_t samples) {
  Picture picture = {scene.options.size[0], scene.options.size[1], {}};
  picture.rgb.resize(std::size_t{3} * picture.width * picture.height);
  const Result<Context> context = Context::create({.device = "", .validation = false, .cache_folder = "/dev/null"});
  Result<picture::DevicePainter> painter = picture::DevicePainter::open(
      context.value().device(), {.samples = samples, .validation = test::no_validation_reason().empty()});
  EXPECT_TRUE(painter.ok()) << painter.error().message;
  if (!painter.ok()) return picture;
  const picture::Scene drawn = picture::make_scene(scene.mesh, scene.spheres, scene.voxel_size, scene.options);
  const Status status =
      painter.value().draw(drawn, picture::panels_of(scene.options.show, picture.width), scene.options.view, picture);
  EXPECT_TRUE(status.ok()) << status.error().message;
  EXPECT_EQ(painter.value().validation_messages(), 0u);
  draw_legend(drawn, picture);
  return picture;
}

TEST_P(Golden, OnTheDevice) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  for (const std::uint32_t samples : {2u, 4u}) {
    SCOPED_TRACE(samples);
    const Picture picture = on_device(GetParam(), samples);
    test::expect_same_look(picture, golden(GetParam()), samples == 2 ? test::kSameSamples : test::kOtherSamples);
    EXPECT_EQ(picture.rgb, on_device(GetParam(), samples).rgb) << "the second picture differs";
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Golden,
                         testing::Values(points_by_angle(), both_by_radius(), balls_by_sheet(), box_from_above()),
                         [](const auto& scene) { return std::string(scene.param.name); });

/// Picture `b` is one with a fault.
void expect_found(const char* fault, const GoldenScene& faulty) {
  const test::LookDifference difference = test::look_difference(on_cpu(faulty), golden(points_by_angle()));
  EXPECT_TRUE(test::kOtherSamples.exceeded_by(difference))
      << fault << ": mean " << difference.mean << ", worst " << difference.worst;
}

TEST(GoldenTolerance, EverySmallFaultIsFound) {
  GoldenScene colours = points_by_angle();
  colours.options.colour = PictureColour::kRadius;
  expect_found("another value is shown", colours);

  GoldenScene range = points_by_angle();
  range.options.least_angle = 0.5;
  expect_found("colours begin at 0.5 instead of 0.6", range);

  GoldenScene no_points = points_by_angle();
  no_points.spheres.clear();
  expect_found("no points", no_points);

  GoldenScene no_mesh = points_by_angle();  // the corners stay, so that the camera does
  for (Triangle& triangle : no_mesh.mesh.triangles) triangle = {triangle[0], triangle[0], triangle[0]};
  expect_found("no mesh", no_mesh);

  GoldenScene turned = points_by_angle();  // by 3 degrees
  const double angle = 3 * std::numbers::pi / 180;
  const std::array<double, 3> view = turned.options.view.towards;
  turned.options.view.towards = {view[0] * std::cos(angle) + view[2] * std::sin(angle), view[1],
                                 view[2] * std::cos(angle) - view[0] * std::sin(angle)};
  expect_found("a camera turned by 3 degrees", turned);

  GoldenScene discs = points_by_angle();
  discs.voxel_size *= 0.6;
  expect_found("discs of 0.6 of their size", discs);
}

TEST(GoldenTolerance, AShiftByTwoPixelsIsFound) {
  const Picture wanted = golden(points_by_angle());
  Picture shifted = wanted;
  for (std::size_t i = 6; i < shifted.rgb.size(); ++i) shifted.rgb[i] = wanted.rgb[i - 6];
  const test::LookDifference difference = test::look_difference(shifted, wanted);
  EXPECT_TRUE(test::kOtherSamples.exceeded_by(difference))
      << "mean " << difference.mean << ", worst " << difference.worst;
}

Picture on_cpu_in_bands(const GoldenScene& scene, std::uint64_t samples_at_once) {
  Picture out = {scene.options.size[0], scene.options.size[1], {}};
  out.rgb.resize(std::size_t{3} * out.width * out.height);
  const picture::Scene drawn = picture::make_scene(scene.mesh, scene.spheres, scene.voxel_size, scene.options);
  for (const picture::Panel& panel : picture::panels_of(scene.options.show, out.width))
    draw_panel(drawn, panel, scene.options.view, out, samples_at_once);
  return out;
}

// Drawings in a band differ by the rounding of positions in it.
TEST(CpuPicture, BandsMeetWithoutASeam) {
  for (const GoldenScene& scene : {points_by_angle(), both_by_radius(), balls_by_sheet(), box_from_above()}) {
    const Picture at_once = on_cpu_in_bands(scene, std::uint64_t{1} << 40);
    for (const std::uint64_t samples : {20'000u, 60'000u}) {
      const Picture bands = on_cpu_in_bands(scene, samples);
      std::size_t differ = 0;
      for (std::size_t i = 0; i < bands.rgb.size(); ++i) differ += std::abs(bands.rgb[i] - at_once.rgb[i]) > 2 ? 1 : 0;
      EXPECT_LE(differ, bands.rgb.size() / 1000) << scene.name << ", " << samples << " samples at once";
    }
  }
}

TEST(DevicePicture, TilesAndPanelsMeetWithoutASeam) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  GoldenScene scene = both_by_radius();
  scene.options.size = {1400, 700};  // several tiles of 512 in each direction
  Picture picture = on_device(scene, 2);
  test::expect_same_look(picture, on_cpu(scene), test::kSameSamples);
}

TEST(DevicePicture, SaysWhoDrewIt) {
  const GoldenScene scene = points_by_angle();
  const DrawnPicture cpu = draw_picture(scene.mesh, scene.spheres, scene.voxel_size, scene.options, nullptr);
  EXPECT_EQ(cpu.drawn_by, "the CPU");
  EXPECT_EQ(cpu.picture.rgb, on_cpu(scene).rgb);
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  DeviceDescription device =
      Context::create({.device = "", .validation = false, .cache_folder = "/dev/null"}).value().device();
  EXPECT_EQ(draw_picture(scene.mesh, scene.spheres, scene.voxel_size, scene.options, &device).drawn_by.find("the CPU"),
            std::string::npos);
  device.name = "a device that was pulled out";
  const DrawnPicture instead = draw_picture(scene.mesh, scene.spheres, scene.voxel_size, scene.options, &device);
  EXPECT_EQ(instead.drawn_by, "the CPU: a device that was pulled out is gone");
  EXPECT_EQ(instead.picture.rgb, cpu.picture.rgb);
}

}  // namespace
}  // namespace medial_vk
