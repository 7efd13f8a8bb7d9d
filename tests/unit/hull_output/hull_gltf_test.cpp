// Hulls as glTF: meshes and implicit shapes, read back with the poses of their nodes.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/hulls/hull_samples.h"
#include "unit/hull_output/hull_expectations.h"
#include "unit/output/parsed_glb.h"

namespace medial_vk {
namespace {

using nlohmann::json;
using test::encoded;
using test::expect_ball_inside;
using test::expect_mesh_of;
using test::record_of;
using test::rotated;
using test::sample_hulls;

constexpr Point kPlaceOfGltf = {30, -20, 10};

/// The sum of the translations of a node and of those that lead to it.
class GltfNodes {
 public:
  explicit GltfNodes(const json& nodes) : nodes_(nodes), places_(nodes.size()) { place(0, {0, 0, 0}); }
  const Point& at(std::size_t node) const { return places_[node]; }

 private:
  void place(std::size_t node, const Point& parent) {
    places_[node] = parent + nodes_[node]["translation"].get<Point>();
    for (const json& child : nodes_[node].value("children", json::array())) place(child, places_[node]);
  }

  const json& nodes_;
  std::vector<Point> places_;
};

void expect_gltf_shape(const BallHull& hull, const json& shape, const json& node, const Point& at) {
  if (shape["type"] == "sphere") {
    expect_ball_inside(hull, at, shape["sphere"]["radius"]);
    return;
  }
  EXPECT_EQ(shape["type"], "capsule");
  const auto q = node["rotation"].get<std::array<double, 4>>();
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  const Point up = rotated({q[3] / length, q[0] / length, q[1] / length, q[2] / length}, {0, 1, 0});
  const json& capsule = shape["capsule"];
  const double half = capsule["height"].get<double>() / 2;
  EXPECT_GT(half, 0);
  expect_ball_inside(hull, at - half * up, capsule["radiusBottom"]);
  expect_ball_inside(hull, at + half * up, capsule["radiusTop"]);
  const double larger = std::max(hull.corners[0].radius, hull.corners[1].radius);
  EXPECT_GT(std::max(capsule["radiusBottom"].get<double>(), capsule["radiusTop"].get<double>()), larger - 1e-5);
}

TEST(HullGltf, GlbHasMeshesAndImplicitShapes) {
  const HullRecord record = record_of(sample_hulls(48, kPlaceOfGltf, 1, 6));
  const test::Glb glb = test::parse_glb(encoded(HullFormat::kGlb, record));
  const json& document = glb.document;
  EXPECT_EQ(document["extensionsUsed"], json({"KHR_implicit_shapes", "KHR_physics_rigid_bodies"}));
  EXPECT_FALSE(document.contains("extensionsRequired"));
  const json &nodes = document["nodes"], &shapes = document["extensions"]["KHR_implicit_shapes"]["shapes"];
  const GltfNodes places(nodes);
  EXPECT_EQ(shapes.size(), 40u);  // all but slabs
  ASSERT_EQ(nodes[0]["children"].size(), 48u);
  const char* names[] = {"USP_part_00", "UCP_part_01", "UCX_part_02", "UCX_part_03"};
  for (std::size_t i = 0; i < 48; ++i) {
    const BallHull& hull = record.fit.hulls[i];
    const std::size_t index = nodes[0]["children"][i];
    const json& node = nodes[index];
    if (i < 4) {
      EXPECT_EQ(node["name"], names[i]);
    }
    const json& primitive = document["meshes"][node["mesh"].get<std::size_t>()]["primitives"][0];
    std::vector<Point> vertices;
    for (const auto& v : test::vectors(glb, primitive["attributes"]["POSITION"])) {
      vertices.push_back(places.at(index) + Point{v[0], v[1], v[2]});
    }
    const json& accessor = document["accessors"][primitive["indices"].get<std::size_t>()];
    EXPECT_EQ(accessor["componentType"], 5125);
    const json& view = document["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    std::vector<Triangle> triangles(accessor["count"].get<std::size_t>() / 3);
    for (std::size_t k = 0; k < 3 * triangles.size(); ++k) {
      triangles[k / 3][k % 3] = test::glb_word(glb.buffer, view["byteOffset"].get<std::size_t>() + 4 * k);
    }
    expect_mesh_of(hull, vertices, triangles);
    EXPECT_EQ(node.contains("children"), kind_of(hull) != HullKind::kSlab);
    if (!node.contains("children")) continue;
    const std::size_t collider = node["children"][0];
    const json& extension = nodes[collider]["extensions"]["KHR_physics_rigid_bodies"];
    const std::size_t shape = extension["collider"]["geometry"]["shape"];
    expect_gltf_shape(hull, shapes[shape], nodes[collider], places.at(collider));
  }
}

TEST(HullGltf, GltfIsTheSameAsText) {
  const HullRecord record = record_of(sample_hulls(6, kPlaceOfGltf, 1, 7));
  const test::Glb glb = test::parse_glb(encoded(HullFormat::kGlb, record));
  json text = json::parse(encoded(HullFormat::kGltf, record));
  const std::string uri = text["buffers"][0]["uri"];
  const std::string head = "data:application/octet-stream;base64,";
  ASSERT_EQ(uri.substr(0, head.size()), head);
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0, known = 0;
  for (std::size_t i = head.size(); i < uri.size() && uri[i] != '='; ++i) {
    bits = bits << 6 | static_cast<std::uint32_t>(letters.find(uri[i]));
    known += 6;
    if (known < 8) continue;
    known -= 8;
    bytes += static_cast<char>(bits >> known & 0xff);
  }
  EXPECT_EQ(bytes, glb.buffer);
  text["buffers"][0].erase("uri");
  EXPECT_EQ(text, glb.document);
}

}  // namespace
}  // namespace medial_vk
