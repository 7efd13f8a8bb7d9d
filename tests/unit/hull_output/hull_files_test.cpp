// Files of hulls: every format is read back by a parser of its own, and what it holds lies in the hulls.
#include "output/hull_files/hull_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "common/tool_errors.h"
#include "support/hulls/hull_samples.h"
#include "support/hulls/usd_text.h"
#include "unit/hull_output/hull_expectations.h"

namespace medial_vk {
namespace {

using nlohmann::json;
using test::encoded;
using test::expect_ball_inside;
using test::expect_mesh_of;
using test::record_of;
using test::rotated;
using test::sample_hulls;
using test::UsdPrim;
using testing::HasSubstr;

constexpr Point kPlace = {30, -20, 10};

void expect_same_balls(const BallHull& hull, const std::vector<Ball>& balls) {
  ASSERT_EQ(balls.size(), hull.count);
  for (std::size_t i = 0; i < balls.size(); ++i) {
    EXPECT_EQ(balls[i].centre, hull.corners[i].centre);
    EXPECT_EQ(balls[i].radius, hull.corners[i].radius);
  }
}

TEST(HullFiles, FormatsHaveWordsAndExtensions) {
  for (const HullFormat format : kHullFormats) {
    const Result<HullFormat> found = hull_format_of(std::string("A.b.") + name_of(format));
    ASSERT_TRUE(found.ok());
    EXPECT_EQ(found.value(), format);
  }
  EXPECT_EQ(hull_format_of("a.USDA").value(), HullFormat::kUsd);
  EXPECT_THAT(hull_format_of("a.ply").error().message, HasSubstr("ends in none of .json, .csv, .ma, .usda, .glb"));
}

TEST(HullFiles, JsonHasEveryNumber) {
  const HullRecord record = record_of(sample_hulls(24, kPlace, 1, 1), "a \"b\" \n\xff");
  const json file = json::parse(encoded(HullFormat::kJson, record));
  EXPECT_EQ(file["format"], 1);
  EXPECT_EQ(file["primitives"], "slabs");
  EXPECT_EQ(file["num_hulls"], 24);
  EXPECT_EQ(file["num_parameters"], 4 * (4 + 7 + 8 + 12 + 8 + 8));
  EXPECT_EQ(file["solid_volume"], 4.0);
  EXPECT_EQ(file["hulls_volume"], json({3.5, 3.625}));
  EXPECT_EQ(file["uncovered_share"], json({0.09375, 0.125}));
  EXPECT_EQ(file["gap"], json({0.1, 0.30000000000000004}));
  EXPECT_EQ(file["proof"], json({{"tested", 24}, {"failed", 0}, {"planes", 1234}, {"greatest_shrink", 1e-7}}));
  const char* kinds[] = {"ball", "capsule", "cone", "slab", "cone", "cone"};
  for (std::size_t i = 0; i < 24; ++i) {
    const json& hull = file["hulls"][i];
    EXPECT_EQ(hull["kind"], kinds[i % 6]);
    EXPECT_EQ(hull["volume"], volume_of(record.fit.hulls[i]));
    EXPECT_EQ(hull["volume_share"], volume_of(record.fit.hulls[i]) / 4);
    std::vector<Ball> balls;
    for (const json& ball : hull["balls"]) balls.push_back({ball["centre"].get<Point>(), ball["radius"].get<double>()});
    expect_same_balls(record.fit.hulls[i], balls);
  }
}

TEST(HullFiles, JsonOfAnOpenMeshHasNoShares) {
  HullRecord record = record_of(sample_hulls(1, kPlace, 1, 1));
  record.fit.solid_volume.reset();
  const json file = json::parse(encoded(HullFormat::kJson, record));
  EXPECT_TRUE(file["solid_volume"].is_null());
  EXPECT_TRUE(file["uncovered_share"].is_null());
  EXPECT_TRUE(file["hulls"][0]["volume_share"].is_null());
}

TEST(HullFiles, CsvHasARowForEachHull) {
  const HullRecord record = record_of(sample_hulls(24, kPlace, 1, 2));
  std::istringstream lines(encoded(HullFormat::kCsv, record));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "balls,x1,y1,z1,radius1,x2,y2,z2,radius2,x3,y3,z3,radius3");
  for (const BallHull& hull : record.fit.hulls) {
    ASSERT_TRUE(std::getline(lines, line));
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 12);
    std::istringstream cells(line);
    std::string cell;
    std::getline(cells, cell, ',');
    std::vector<Ball> balls(std::stoul(cell));
    for (Ball& ball : balls) {
      for (double* number : {&ball.centre[0], &ball.centre[1], &ball.centre[2], &ball.radius}) {
        std::getline(cells, cell, ',');
        *number = std::stod(cell);
      }
    }
    expect_same_balls(hull, balls);
    cell.clear();
    std::getline(cells, cell, '\0');
    EXPECT_EQ(cell.find_first_not_of(','), std::string::npos);  // the rest of a row is empty
  }
  EXPECT_FALSE(std::getline(lines, line));
  const HullRecord balls = record_of({sample_hulls(1, kPlace, 1, 2)});
  EXPECT_THAT(encoded(HullFormat::kCsv, balls), testing::StartsWith("balls,x1,y1,z1,radius1\n1,"));
}

TEST(HullFiles, MaHasBallsEdgesAndTriangles) {
  const HullRecord record = record_of(sample_hulls(12, kPlace, 1, 3));
  std::istringstream text(encoded(HullFormat::kMa, record));
  std::size_t vertices = 0, edges = 0, faces = 0;
  text >> vertices >> edges >> faces;
  EXPECT_EQ(vertices, 2u * (1 + 2 + 2 + 3 + 2 + 2));
  EXPECT_EQ(edges, 2u * (0 + 1 + 1 + 3 + 1 + 1));
  EXPECT_EQ(faces, 2u);
  std::vector<Ball> balls(vertices);
  std::string word;
  for (Ball& ball : balls) {
    text >> word >> ball.centre[0] >> ball.centre[1] >> ball.centre[2] >> ball.radius;
    EXPECT_EQ(word, "v");
  }
  std::vector<std::array<std::size_t, 2>> pairs(edges);
  for (auto& [a, b] : pairs) {
    text >> word >> a >> b;
    EXPECT_EQ(word, "e");
  }
  std::vector<std::array<std::size_t, 3>> corners(faces);
  for (auto& [a, b, c] : corners) {
    text >> word >> a >> b >> c;
    EXPECT_EQ(word, "f");
  }
  EXPECT_TRUE(text.good());
  std::size_t first = 0, edge = 0, face = 0;
  for (const BallHull& hull : record.fit.hulls) {
    expect_same_balls(hull, {balls.begin() + first, balls.begin() + first + hull.count});
    if (hull.count > 1) {
      EXPECT_EQ(pairs[edge++], (std::array<std::size_t, 2>{first, first + 1}));
    }
    if (hull.count > 2) {
      EXPECT_EQ(pairs[edge++], (std::array<std::size_t, 2>{first + 1, first + 2}));
      EXPECT_EQ(pairs[edge++], (std::array<std::size_t, 2>{first, first + 2}));
      EXPECT_EQ(corners[face++], (std::array<std::size_t, 3>{first, first + 1, first + 2}));
    }
    first += hull.count;
  }
}

TEST(HullFiles, ObjHasAMeshForEachHull) {
  const HullRecord record = record_of(sample_hulls(12, kPlace, 1, 4));
  std::istringstream lines(encoded(HullFormat::kObj, record));
  std::vector<std::string> names;
  std::vector<std::vector<Point>> vertices;
  std::vector<std::vector<Triangle>> triangles;
  std::uint32_t before = 1, count = 1;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "o") {
      before = count;
      words >> names.emplace_back();
      vertices.emplace_back();
      triangles.emplace_back();
    } else if (word == "v") {
      Point& p = vertices.back().emplace_back();
      words >> p[0] >> p[1] >> p[2];
      ++count;
    } else if (word == "f") {
      Triangle& t = triangles.back().emplace_back();
      words >> t[0] >> t[1] >> t[2];
      for (std::uint32_t& corner : t) {
        ASSERT_GE(corner, before);
        ASSERT_LT(corner, count);
        corner -= before;
      }
    } else {
      EXPECT_EQ(word, "#");
    }
  }
  ASSERT_EQ(names.size(), 12u);
  EXPECT_EQ(names[0], "ball_00");
  EXPECT_EQ(names[3], "slab_03");
  for (std::size_t i = 0; i < 12; ++i) expect_mesh_of(record.fit.hulls[i], vertices[i], triangles[i]);
}

void expect_usd_capsule(const BallHull& hull, const UsdPrim& prim) {
  const std::vector<double> q = prim.at("xformOp:orient").numbers(), at = prim.at("xformOp:translate").numbers();
  ASSERT_EQ(q.size(), 4u);
  EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1, 1e-15);
  EXPECT_EQ(prim.at("axis").text, "Y");
  const Point middle = {at[0], at[1], at[2]}, up = rotated(q, {0, 1, 0});
  const double height = prim.number("height");
  if (prim.type == "Capsule") {
    for (const double end : {-0.5, 0.5}) expect_ball_inside(hull, middle + end * height * up, prim.number("radius"));
    EXPECT_GT(prim.number("radius"), hull.corners[0].radius - 1e-11);
    return;
  }
  const double bottom = prim.number("radiusBottom"), top = prim.number("radiusTop");
  expect_ball_inside(hull, middle - (height / 2) * up, bottom);
  expect_ball_inside(hull, middle + (height / 2) * up, top);
  const double slope = (bottom - top) / height, secant = std::sqrt(1 + slope * slope);
  expect_ball_inside(hull, middle - (height / 2 + slope * bottom) * up, bottom * secant);
  expect_ball_inside(hull, middle + (height / 2 - slope * top) * up, top * secant);
}

TEST(HullFiles, UsdHasColliders) {
  const HullRecord record = record_of(sample_hulls(48, kPlace, 1, 5), "9 parts");
  const test::UsdLayer layer = test::parse_usd(encoded(HullFormat::kUsd, record));
  EXPECT_EQ(layer.metadata.at("defaultPrim").text, "_9_parts");
  EXPECT_EQ(layer.metadata.at("metersPerUnit").number, 1);
  ASSERT_EQ(layer.prims.size(), 1u);
  EXPECT_EQ(layer.prims[0].type, "Xform");
  EXPECT_EQ(layer.prims[0].name, "_9_parts");
  ASSERT_EQ(layer.prims[0].children.size(), 48u);
  std::map<std::string, int> types;
  for (std::size_t i = 0; i < 48; ++i) {
    const BallHull& hull = record.fit.hulls[i];
    const UsdPrim& prim = layer.prims[0].children[i];
    ++types[prim.type];
    EXPECT_EQ(prim.metadata.at("apiSchemas").items[0].text, "PhysicsCollisionAPI");
    EXPECT_TRUE(prim.properties.at("xformOpOrder").is_uniform);
    EXPECT_EQ(prim.properties.at("xformOp:translate").type, "double3");
    EXPECT_EQ(prim.properties.at("extent").type, "float3[]");
    const std::vector<double> at = prim.at("xformOp:translate").numbers();
    const Point middle = {at[0], at[1], at[2]};
    if (prim.type == "Sphere") {
      expect_ball_inside(hull, middle, prim.number("radius"));
      continue;
    }
    if (prim.type != "Mesh") {
      EXPECT_EQ(prim.type, kind_of(hull) == HullKind::kCapsule ? "Capsule" : "Capsule_1");
      expect_usd_capsule(hull, prim);
      continue;
    }
    EXPECT_EQ(prim.at("physics:approximation").text, "convexHull");
    std::vector<Point> vertices;
    for (const test::UsdValue& point : prim.at("points").items) {
      const std::vector<double> p = point.numbers();
      for (const double x : p) EXPECT_EQ(x, static_cast<double>(static_cast<float>(x)));
      vertices.push_back(middle + Point{p[0], p[1], p[2]});
    }
    const std::vector<double> corners = prim.at("faceVertexIndices").numbers();
    std::vector<Triangle> triangles(corners.size() / 3);
    for (std::size_t k = 0; k < corners.size(); ++k) triangles[k / 3][k % 3] = static_cast<std::uint32_t>(corners[k]);
    EXPECT_EQ(prim.at("faceVertexCounts").numbers(), std::vector<double>(triangles.size(), 3));
    expect_mesh_of(hull, vertices, triangles);
  }
  EXPECT_EQ(types["Mesh"], 8);
  EXPECT_EQ(types["Capsule"], 8);
  EXPECT_GT(types["Capsule_1"], 4);
  EXPECT_GE(types["Sphere"], 16);  // balls, and cones of which one ball holds the other
}

TEST(HullFiles, ARadiusThatDoesNotSufficeNamesTheFormat) {
  const HullRecord record = record_of({hull_of({{0, 0, 0}, 1}), hull_of({{0, 0, 0}, 1}, {{5, 0, 0}, 1e-9})});
  for (const HullFormat format : {HullFormat::kGlb, HullFormat::kGltf}) {
    const Result<std::string> bytes = encode_hulls(format, record);
    ASSERT_FALSE(bytes.ok());
    EXPECT_EQ(bytes.error().code, kCannotWrite);
    EXPECT_EQ(bytes.error().message, std::string(name_of(format)) +
                                         ": hull 2: a radius is smaller than what the digits of the format lose; use "
                                         ".json, .csv or .ma");
  }
  for (const HullFormat format : {HullFormat::kJson, HullFormat::kCsv, HullFormat::kMa, HullFormat::kUsd}) {
    EXPECT_TRUE(encode_hulls(format, record).ok()) << name_of(format);
  }
}

}  // namespace
}  // namespace medial_vk
