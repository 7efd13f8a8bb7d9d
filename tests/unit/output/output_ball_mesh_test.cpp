// Balls of triangles: the unit sphere, and the PLY of `--mesh-spheres`.
#include "output/medial_formats/ball_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>

#include "common/tool_errors.h"
#include "output/medial_formats/icosphere.h"
#include "support/medial_points.h"

namespace medial_vk {
namespace {

using test::some_header;
using test::some_spheres;
using testing::HasSubstr;

double length(const Point& p) { return std::hypot(p[0], p[1], p[2]); }

TEST(OutputIcosphere, IsClosedAndOnTheUnitSphere) {
  for (std::uint32_t detail = 0; detail <= 4; ++detail) {
    const Icosphere sphere = make_icosphere(detail);
    EXPECT_EQ(sphere.vertices.size(), icosphere_vertices(detail));
    EXPECT_EQ(sphere.triangles.size(), icosphere_triangles(detail));
    for (const Point& v : sphere.vertices) EXPECT_NEAR(length(v), 1, 4e-16);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& t : sphere.triangles) {
      for (std::size_t i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
    }
    EXPECT_EQ(edges.size(), 3 * sphere.triangles.size());  // every directed edge once
    for (const auto& [edge, count] : edges) EXPECT_TRUE(edges.contains({edge.second, edge.first}));
  }
}

// The numbers of docs/formats.md. A positive depth also implies that the triangles face outwards.
TEST(OutputIcosphere, FacetsAreAsDeepAsTheManualSays) {
  const double expected[] = {0.205, 0.066, 0.0177, 0.0045, 0.00113, 0.000283};
  for (std::uint32_t detail = 0; detail <= kGreatestSphereDetail; ++detail) {
    EXPECT_NEAR(facet_depth(make_icosphere(detail)), expected[detail], 0.01 * expected[detail]) << detail;
  }
}

TEST(OutputBallMesh, HeaderSaysWhatFollows) {
  const std::string ply = encode_ball_mesh_ply(some_header(), some_spheres(), false, 1).value();
  EXPECT_EQ(ply.substr(0, ply.find("end_header\n")),
            "ply\nformat binary_little_endian 1.0\n"
            "comment medial-vk 1.2.3\ncomment grid_origin -1 0.1 1e-09\ncomment voxel_size 0.00625\n"
            "comment epsilon 6.25e-05\ncomment object_angle 0.6\ncomment radius_threshold 0.125\n"
            "comment sphere_detail 1\n"
            "element vertex 126\n"
            "property double x\nproperty double y\nproperty double z\n"
            "property float radius\nproperty float object_angle\nproperty int sheet\n"
            "property uchar red\nproperty uchar green\nproperty uchar blue\n"
            "element face 240\nproperty list uchar int vertex_indices\n");
  EXPECT_EQ(ply.size(), ply.find("end_header\n") + 11 + 126 * 39 + 240 * 13);
}

// Computed in long double, which has eleven more bits and is practically exact here.
TEST(OutputBallMesh, NoVertexIsOutsideOfItsBall) {
  const std::vector<MedialSphere> spheres = some_spheres();
  std::istringstream body(encode_ball_mesh_ply(some_header(), spheres, true, 2).value());
  for (std::string line; line != "end_header";) ASSERT_TRUE(std::getline(body, line));
  for (const MedialSphere& sphere : spheres) {
    for (std::uint64_t i = 0; i < icosphere_vertices(2); ++i) {
      Point p;
      float radius = 0, object_angle = 0;
      int sheet = 0, red = 0, green = 0, blue = 0;
      ASSERT_TRUE(body >> p[0] >> p[1] >> p[2] >> radius >> object_angle >> sheet >> red >> green >> blue);
      const long double x = static_cast<long double>(p[0]) - sphere.centre[0];
      const long double y = static_cast<long double>(p[1]) - sphere.centre[1];
      const long double z = static_cast<long double>(p[2]) - sphere.centre[2];
      const auto exact = static_cast<long double>(sphere.radius);
      EXPECT_LE(x * x + y * y + z * z, exact * exact);
      EXPECT_NEAR(std::sqrt(static_cast<double>(x * x + y * y + z * z)), sphere.radius, 1e-9);
      EXPECT_EQ(radius, static_cast<float>(sphere.radius));
      EXPECT_EQ(object_angle, sphere.object_angle);
      EXPECT_EQ(sheet, sphere.sheet);
      EXPECT_TRUE(red >= 0 && red < 256 && green >= 0 && green < 256 && blue >= 0 && blue < 256);
    }
  }
}

TEST(OutputBallMesh, ColoursGoFromVioletToYellow) {
  const std::string text = encode_ball_mesh_ply(some_header(), some_spheres(), true, 0).value();
  EXPECT_THAT(text, HasSubstr(" -1 68 1 84\n"));  // at the threshold
  EXPECT_THAT(text, HasSubstr(" 1 205 22"));      // 1.5 of pi/2
}

std::uint64_t a_mebibyte_or_more(std::uint32_t detail) { return 1ull << (20 + 2 * detail); }

TEST(OutputBallMesh, DetailGivesWayToTheSizeOfTheFileUnlessItWasRequested) {
  EXPECT_EQ(choose_sphere_detail({}, 256, a_mebibyte_or_more).value(), 2u);
  EXPECT_EQ(choose_sphere_detail({}, 257, a_mebibyte_or_more).value(), 1u);
  EXPECT_EQ(choose_sphere_detail({}, 1025, a_mebibyte_or_more).value(), 0u);
  EXPECT_EQ(choose_sphere_detail(3, 64, a_mebibyte_or_more).value(), 3u);
  const auto refused = choose_sphere_detail(3, 65, a_mebibyte_or_more);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, kCannotWrite);
  EXPECT_THAT(refused.error().message, HasSubstr("65 balls as a mesh of sphere detail 3 take 4160 MiB"));
  EXPECT_THAT(refused.error().message, HasSubstr("lower --sphere-detail"));
  EXPECT_FALSE(choose_sphere_detail({}, 4097, a_mebibyte_or_more).ok());
  EXPECT_FALSE(choose_sphere_detail({}, UINT64_MAX, a_mebibyte_or_more).ok());
}

TEST(OutputBallMesh, NoBallsAreAMeshToo) {
  EXPECT_THAT(encode_ball_mesh_ply(some_header(), {}, false, {}).value(), HasSubstr("element vertex 0\n"));
}

}  // namespace
}  // namespace medial_vk
