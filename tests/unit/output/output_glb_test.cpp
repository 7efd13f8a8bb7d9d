// GLB: the container byte by byte, and the three ways to place balls.
#include "output/medial_formats/encode_glb.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "output/medial_formats/glb_balls.h"
#include "support/medial_points.h"
#include "unit/output/parsed_glb.h"

namespace medial_vk {
namespace {

using nlohmann::json;
using test::Glb;
using test::parse_glb;
using test::some_header;
using test::some_spheres;
using test::vectors;

constexpr GlbLayout kLayouts[] = {GlbLayout::kNodes, GlbLayout::kGpuInstances, GlbLayout::kOneMesh};

/// The distance of a point, given relative to the root, from the centre of a sphere.
long double distance(const MedialSphere& sphere, const json& root, const std::array<float, 3>& point) {
  long double squared = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const long double coordinate = root["translation"][axis].get<long double>() + point[axis];
    squared += (coordinate - sphere.centre[axis]) * (coordinate - sphere.centre[axis]);
  }
  return std::sqrt(squared);
}

/// Expects a ball inside the sphere, up to the rounding of floats.
void expect_ball(const MedialSphere& sphere, const json& root, const std::array<float, 3>& centre, float radius) {
  EXPECT_LE(distance(sphere, root, centre) + radius, static_cast<long double>(sphere.radius));
  EXPECT_NEAR(radius, sphere.radius, 1e-6);
}

TEST(OutputGlb, NodesHoldTheBallsInOrder) {
  const std::vector<MedialSphere> spheres = some_spheres();
  const Glb glb = parse_glb(encode_glb(some_header(), spheres, GlbLayout::kNodes, {}).value());
  const json& nodes = glb.document["nodes"];
  ASSERT_EQ(nodes.size(), 4u);
  EXPECT_EQ(glb.document["scenes"][0]["nodes"], json::array({0}));
  EXPECT_EQ(nodes[0]["children"], json({1, 2, 3}));
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const json& node = nodes[i + 1];
    EXPECT_EQ(node["name"], std::to_string(i));
    expect_ball(spheres[i], nodes[0], node["translation"].get<std::array<float, 3>>(), node["scale"][0].get<float>());
    EXPECT_EQ(node["scale"][1], node["scale"][0]);
    EXPECT_EQ(node["scale"][2], node["scale"][0]);
    EXPECT_EQ(node["extras"]["object_angle"].get<float>(), spheres[i].object_angle);
    EXPECT_EQ(node["extras"]["sheet"], spheres[i].sheet);
  }
  EXPECT_EQ(glb.document["meshes"].size(), 3u);  // three colours, one set of triangles
  EXPECT_EQ(glb.document["accessors"].size(), 2u);
  EXPECT_FALSE(glb.document.contains("extensionsUsed"));
  EXPECT_EQ(glb.document["asset"]["extras"]["voxel_size"], 0.00625);
}

TEST(OutputGlb, TheUnitBallIsInsideTheUnitSphere) {
  const Glb glb = parse_glb(encode_glb(some_header(), some_spheres(), GlbLayout::kNodes, 3).value());
  const json& primitive = glb.document["meshes"][0]["primitives"][0];
  const auto vertices = vectors(glb, primitive["attributes"]["POSITION"]);
  ASSERT_EQ(vertices.size(), 642u);
  for (const auto& v : vertices) {
    const double squared =
        static_cast<double>(v[0]) * v[0] + static_cast<double>(v[1]) * v[1] + static_cast<double>(v[2]) * v[2];
    EXPECT_LE(squared, 1);
    EXPECT_GT(squared, 1 - 4e-7);
  }
  const json& positions = glb.document["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
  EXPECT_LT(positions["min"][0], -0.99);
  EXPECT_GT(positions["max"][0], 0.99);
  const json& indices = glb.document["accessors"][primitive["indices"].get<std::size_t>()];
  EXPECT_EQ(indices["count"], 3 * 1280);
  EXPECT_EQ(indices["componentType"], 5123);
}

TEST(OutputGlb, InstancesAreListedByColour) {
  const std::vector<MedialSphere> spheres = some_spheres();
  const Glb glb = parse_glb(encode_glb(some_header(), spheres, GlbLayout::kGpuInstances, {}).value());
  EXPECT_EQ(glb.document["extensionsRequired"], json({"EXT_mesh_gpu_instancing"}));
  EXPECT_EQ(glb.document["extensionsUsed"], glb.document["extensionsRequired"]);
  const json& nodes = glb.document["nodes"];
  ASSERT_EQ(nodes.size(), 4u);  // three colours here
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const json& attributes = nodes[i + 1]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    const auto centres = vectors(glb, attributes["TRANSLATION"]);
    const auto sizes = vectors(glb, attributes["SCALE"]);
    ASSERT_EQ(centres.size(), 1u);
    ASSERT_EQ(sizes.size(), 1u);
    expect_ball(spheres[i], nodes[0], centres[0], sizes[0][0]);
  }
}

TEST(OutputGlb, OneMeshHoldsAllBallsAndTheirColours) {
  const std::vector<MedialSphere> spheres = some_spheres();
  const Glb glb = parse_glb(encode_glb(some_header(), spheres, GlbLayout::kOneMesh, 1).value());
  const json& primitive = glb.document["meshes"][0]["primitives"][0];
  const auto vertices = vectors(glb, primitive["attributes"]["POSITION"]);
  ASSERT_EQ(vertices.size(), 3u * 42u);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const long double from_centre = distance(spheres[i / 42], glb.document["nodes"][0], vertices[i]);
    EXPECT_LE(from_centre, static_cast<long double>(spheres[i / 42].radius));
    EXPECT_NEAR(static_cast<double>(from_centre), spheres[i / 42].radius, 1e-6);
  }
  const json& colours = glb.document["accessors"][primitive["attributes"]["COLOR_0"].get<std::size_t>()];
  EXPECT_EQ(colours["type"], "VEC4");
  EXPECT_EQ(colours["normalized"], true);
  EXPECT_EQ(colours["count"], vertices.size());
  EXPECT_EQ(glb.document["accessors"][primitive["indices"].get<std::size_t>()]["count"], 3 * 3 * 80);
}

// glTF allows no empty array: no meshes, no buffer, no children.
TEST(OutputGlb, NoBallsAreAValidScene) {
  for (const GlbLayout layout : kLayouts) {
    const Glb glb = parse_glb(encode_glb(some_header(), {}, layout, {}).value());
    EXPECT_EQ(glb.document["nodes"].size(), 1u);
    EXPECT_TRUE(glb.buffer.empty());
    for (const char* key : {"meshes", "materials", "accessors", "bufferViews", "buffers", "extensionsUsed"}) {
      EXPECT_FALSE(glb.document.contains(key)) << key;
    }
    EXPECT_FALSE(glb.document["nodes"][0].contains("children"));
  }
}

TEST(OutputGlb, SameBallsSameBytes) {
  for (const GlbLayout layout : kLayouts) {
    EXPECT_TRUE(encode_glb(some_header(), some_spheres(), layout, {}).value() ==
                encode_glb(some_header(), some_spheres(), layout, {}).value());
  }
}

TEST(OutputGlb, FloatsAreShortenedTowardsZero) {
  for (const double x : {0.1, -0.1, 1.0 / 3, 1.0, 0.0, -1e-50}) {
    EXPECT_LE(std::abs(static_cast<double>(shortened(x))), std::abs(x));
    EXPECT_NEAR(shortened(x), x, 1e-7);
  }
}

}  // namespace
}  // namespace medial_vk
