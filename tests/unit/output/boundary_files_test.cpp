// Meshes with what was measured at their vertices, as files. tests/formats reads them with other programs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "output/boundary_files/encode_boundary.h"
#include "parsed_glb.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using testing::HasSubstr;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Numbers between two floats, of which the ends of an interval are to be rounded outwards.
BoundaryFields some_fields(std::size_t vertices) {
  BoundaryFields fields;
  std::vector<Thickness> thickness(vertices);
  std::vector<VertexCurvature> curvature(vertices);
  for (std::size_t i = 0; i < vertices; ++i) {
    const double x = 1 + static_cast<double>(i) / 3;
    thickness[i].diameter = {x, x};
    if (i % 2 == 1) continue;
    curvature[i].kappa = {x, -x};
    curvature[i].state = CurvatureState::kKnown;
    curvature[i].directions = {Point{x, 0, 0}, Point{0, 0, -x}};
  }
  add_thickness(fields, thickness);
  add_curvature(fields, curvature, {});
  return fields;
}

std::vector<float> scalars(const test::Glb& glb, std::size_t accessor) {
  const nlohmann::json& description = glb.document["accessors"][accessor];
  EXPECT_EQ(description["componentType"], 5126);
  EXPECT_EQ(description["type"], "SCALAR");
  const nlohmann::json& view = glb.document["bufferViews"][description["bufferView"].get<std::size_t>()];
  std::vector<float> out(description["count"].get<std::size_t>());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::uint32_t bits = test::glb_word(glb.buffer, view["byteOffset"].get<std::size_t>() + 4 * i);
    std::memcpy(&out[i], &bits, 4);
  }
  return out;
}

TEST(BoundaryFiles, FloatsOfAnIntervalStillHoldIt) {
  const Mesh mesh = test::make_box({1, 2, 3});
  const BoundaryFields fields = some_fields(mesh.vertices.size());
  Result<std::string> bytes = encode_boundary("a.glb", mesh, fields, {});
  ASSERT_TRUE(bytes.ok());
  const test::Glb glb = test::parse_glb(bytes.value());
  const nlohmann::json& attributes = glb.document["meshes"][0]["primitives"][0]["attributes"];
  const std::vector<float> lower = scalars(glb, attributes["_THICKNESS_LOWER"]);
  const std::vector<float> upper = scalars(glb, attributes["_THICKNESS_UPPER"]);
  const std::vector<double>& exact = fields.find(field_names::kThicknessLower)->values;
  ASSERT_EQ(lower.size(), exact.size());
  for (std::size_t i = 0; i < exact.size(); ++i) {
    EXPECT_LE(double{lower[i]}, exact[i]);
    EXPECT_GE(double{upper[i]}, exact[i]);
    EXPECT_LE(upper[i], std::nextafter(lower[i], INFINITY));
  }
}

TEST(BoundaryFiles, GltfHasNoNaN) {
  const Mesh mesh = test::make_box({1, 2, 3});
  Result<std::string> bytes = encode_boundary("a.glb", mesh, some_fields(mesh.vertices.size()), {});
  ASSERT_TRUE(bytes.ok());
  const test::Glb glb = test::parse_glb(bytes.value());
  const nlohmann::json& attributes = glb.document["meshes"][0]["primitives"][0]["attributes"];
  EXPECT_EQ(scalars(glb, attributes["_KAPPA_1"])[1], 0);
  EXPECT_EQ(scalars(glb, attributes["_CURVATURE_STATE"])[1], 5);
  EXPECT_EQ(scalars(glb, attributes["_SHEET"])[1], -1);
  EXPECT_EQ(scalars(glb, attributes["_CURVATURE_ERROR"])[0], 0);
  for (const auto& vector : test::vectors(glb, attributes["_DIRECTION_2"])) {
    for (const float x : vector) EXPECT_TRUE(std::isfinite(x));
  }
  EXPECT_EQ(test::vectors(glb, attributes["_DIRECTION_1"])[0], (std::array<float, 3>{1, 0, 0}));
  EXPECT_TRUE(attributes.contains("COLOR_0"));
}

TEST(BoundaryFiles, TextOfAPlyHasAllNumbers) {
  Mesh mesh = test::make_box({1, 2, 3});
  const BoundaryFields fields = some_fields(mesh.vertices.size());
  Result<std::string> bytes = encode_boundary("a.ply", mesh, fields, {.ascii = true});
  ASSERT_TRUE(bytes.ok());
  EXPECT_THAT(bytes.value(), HasSubstr("property double kappa_1\n"));
  EXPECT_THAT(bytes.value(), HasSubstr("property double direction_2_z\n"));
  EXPECT_THAT(bytes.value(), HasSubstr("property int sheet\n"));
  std::istringstream rows(bytes.value().substr(bytes.value().find("end_header\n") + 11));
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    for (const double x : mesh.vertices[i]) {
      std::string word;
      rows >> word;
      EXPECT_EQ(std::stod(word), x);
    }
    for (const BoundaryField& field : fields.of_vertices) {
      for (std::size_t k = 0; k < field.components; ++k) {
        std::string word;
        rows >> word;
        const double value = field.values[i * field.components + k];
        if (std::isnan(value)) {
          EXPECT_EQ(word, "nan");
        } else {
          EXPECT_EQ(std::stod(word), value);
        }
      }
    }
  }
  std::string corners;
  rows >> corners;
  EXPECT_EQ(corners, "3");
}

TEST(PointTables, HaveWordsAndNoNaNInJson) {
  const Mesh mesh = test::make_box({1, 2, 3});
  const BoundaryFields fields = some_fields(mesh.vertices.size());
  BoundaryFileOptions options;
  options.delta = 0.25;
  const nlohmann::json all = nlohmann::json::parse(encode_boundary("a.json", mesh, fields, options).value());
  EXPECT_EQ(all["delta"], 0.25);
  ASSERT_EQ(all["points"].size(), mesh.vertices.size());
  EXPECT_EQ(all["triangles"].size(), mesh.triangles.size());
  EXPECT_EQ(all["triangles"][1][2], mesh.triangles[1][2]);
  const nlohmann::json& second = all["points"][1];
  EXPECT_EQ(second["at"].get<std::vector<double>>()[1], mesh.vertices[1][1]);
  EXPECT_EQ(second["thickness_kind"], "none");
  EXPECT_EQ(second["curvature_state"], "few");
  EXPECT_TRUE(second["kappa_1"].is_null());
  EXPECT_EQ(second["thickness_lower"], 1 + 1.0 / 3);
  EXPECT_EQ(second["ball_centre"].size(), 3u);
  EXPECT_EQ(all["points"][0]["curvature_state"], "known");
}

TEST(PointTables, CsvHasALineForEachPoint) {
  const std::vector<Point> points = {{1, 2, 3}, {4, 5, 0.1}};
  std::vector<Thickness> thickness(2);
  thickness[1].diameter = {0.5, 0.75};
  thickness[1].ball = {{7, 8, 9}, 0.25};
  thickness[1].object_angle = 1.5;
  thickness[1].contacts = {Point{10, 11, 12}, Point{13, 14, 15}};
  thickness[1].kind = ThicknessKind::kWall;
  BoundaryFields fields;
  add_thickness(fields, thickness);
  const std::string text = encode_point_table("-", {points, {}, fields, 1}).value();
  EXPECT_EQ(text,
            "x,y,z,thickness_lower,thickness_upper,object_angle,thickness_kind,ball_centre_x,ball_centre_y,"
            "ball_centre_z,ball_radius,contact_a_x,contact_a_y,contact_a_z,contact_b_x,contact_b_y,contact_b_z\n"
            "1,2,3,0,0,0,none,0,0,0,0,0,0,0,0,0,0\n"
            "4,5,0.1,0.5,0.75,1.5,wall,7,8,9,0.25,10,11,12,13,14,15\n");
}

TEST(BoundaryFiles, ANegativeNaNIsNaN) {
  const Mesh mesh = test::make_box({1, 2, 3});
  BoundaryFields fields;
  fields.of_vertices.push_back({.name = "x", .values = std::vector<double>(mesh.vertices.size(), -kUnknown)});
  EXPECT_THAT(encode_boundary_ply(mesh, fields, true), testing::Not(HasSubstr("-nan")));
}

}  // namespace
}  // namespace medial_vk
