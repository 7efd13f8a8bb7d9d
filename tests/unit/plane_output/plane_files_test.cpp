// Axes of shapes in the plane as JSON, GeoJSON, CSV and SVG, and rings of a boundary.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "output/plane_files/plane_files.h"
#include "unit/plane_centre_lines/axes_of_shapes.h"

namespace medial_vk {
namespace {

using nlohmann::json;
using test::rectangle_ring;
using testing::HasSubstr;

PlaneRecord record_of(const std::vector<PlaneRing>& rings, bool y_is_down = false) {
  PlaneRecord record;
  record.input = "a \"b\".csv";
  record.format = "CSV";
  record.shape = prepare_shape(rings, FillRule::kEvenOdd).value();
  record.axis = find_plane_axis(record.shape, record.options).value();
  record.step = 1e-3;
  record.y_is_down = y_is_down;
  for (const AxisBranch& branch : record.axis.branches)
    record.lines.push_back(sample_branch(record.axis, branch, 1e-3));
  return record;
}

/// A frame and, beside it, an L whose reflex corner makes parabolas.
std::vector<PlaneRing> two_parts() {
  return {rectangle_ring(0, 0, 4, 4), rectangle_ring(1, 1, 2, 2), {{6, 0}, {9, 0}, {9, 1}, {7, 1}, {7, 4}, {6, 4}}};
}

TEST(PlaneFiles, RingsGoAroundTheBoundaryOnce) {
  const PlaneRecord record = record_of(two_parts());
  std::size_t points = 0;
  for (const auto& ring : rings_of(record.shape)) {
    points += ring.size();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::array<std::uint32_t, 2> side = {ring[i], ring[(i + 1) % ring.size()]};
      EXPECT_EQ(std::ranges::count(record.shape.segments, side), 1);
    }
  }
  EXPECT_EQ(points, record.shape.segments.size());
  // Two triangles that touch in a point.
  const PreparedShape touching =
      prepare_shape(std::vector<PlaneRing>{{{0, 0}, {2, 1}, {2, -1}}, {{0, 0}, {-2, 1}, {-2, -1}}}).value();
  std::size_t segments = 0;
  for (const auto& ring : rings_of(touching)) segments += ring.size();
  EXPECT_EQ(segments, 6u);
}

TEST(PlaneFiles, TheJsonHoldsTheWholeGraph) {
  const PlaneRecord record = record_of(two_parts());
  const json file = json::parse(encode_plane_json(record));
  EXPECT_EQ(file["input"], "a \"b\".csv");
  EXPECT_EQ(file["epsilon"].get<double>(), record.axis.epsilon);
  ASSERT_EQ(file["nodes"].size(), record.axis.nodes.size());
  ASSERT_EQ(file["arcs"].size(), record.axis.arcs.size());
  ASSERT_EQ(file["branches"].size(), record.axis.branches.size());
  EXPECT_EQ(file["points"].size(), record.shape.points.size());
  EXPECT_EQ(file["segments"].size(), record.shape.segments.size());
  std::size_t parabolas = 0;
  for (std::size_t a = 0; a < record.axis.arcs.size(); ++a) {
    const json& arc = file["arcs"][a];
    const PlaneCurve& curve = record.axis.arcs[a].curve;
    EXPECT_EQ(arc["origin"][0].get<double>(), curve.origin[0]);
    EXPECT_EQ(arc["t"][1].get<double>(), record.axis.arcs[a].t[1]);
    EXPECT_EQ(arc.contains("up"), curve.kind == PlaneCurve::Kind::kOfPointAndSegment);
    EXPECT_EQ(arc.contains("slope"), curve.kind == PlaneCurve::Kind::kOfSegments);
    parabolas += arc.contains("up") ? 1 : 0;
    // The first contact is a point or a segment, by its index.
    const PlaneContact& contact = record.axis.arcs[a].contacts[0];
    EXPECT_EQ(arc["contacts"][0][contact.is_point ? "point" : "segment"], contact.index);
  }
  EXPECT_GT(parabolas, 0u);
  for (std::size_t b = 0; b < record.axis.branches.size(); ++b) {
    const json& branch = file["branches"][b];
    EXPECT_EQ(branch["line"].size(), record.lines[b].size());
    EXPECT_EQ(branch["significance"].is_null(), !is_end_branch(record.axis, record.axis.branches[b]));
    EXPECT_EQ(branch["line"][0][2].get<double>(), record.lines[b][0].radius);
  }
}

TEST(PlaneFiles, TheGeoJsonHasLinesAndPoints) {
  const PlaneRecord record = record_of(two_parts());
  const json file = json::parse(encode_plane_geojson(record));
  EXPECT_EQ(file["type"], "FeatureCollection");
  std::size_t lines = 0, junctions = 0, ends = 0;
  for (const json& feature : file["features"]) {
    const json& properties = feature["properties"];
    if (feature["geometry"]["type"] == "LineString") {
      const auto& line = record.lines[lines++];
      ASSERT_EQ(feature["geometry"]["coordinates"].size(), line.size());
      EXPECT_EQ(properties["radius"].size(), line.size());
      EXPECT_EQ(properties["object_angle"].size(), line.size());
      EXPECT_EQ(feature["geometry"]["coordinates"].back()[1].get<double>(), line.back().point[1]);
    } else {
      EXPECT_EQ(feature["geometry"]["type"], "Point");
      junctions += properties["kind"] == "junction" ? 1 : 0;
      ends += properties["kind"] == "end" ? 1 : 0;
    }
  }
  EXPECT_EQ(lines, record.lines.size());
  EXPECT_EQ(junctions, record.axis.junctions());
  EXPECT_EQ(ends, counts_of(record).ends);
}

TEST(PlaneFiles, TheTableHasALineForEachPoint) {
  const PlaneRecord record = record_of(two_parts());
  std::istringstream lines(encode_plane_csv(record));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "x,y,radius,object_angle,branch");
  for (std::size_t b = 0; b < record.lines.size(); ++b) {
    for (const AxisSample& sample : record.lines[b]) {
      ASSERT_TRUE(std::getline(lines, line));
      double x = 0, y = 0, radius = 0, angle = 0;
      std::size_t branch = 0;
      ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%zu", &x, &y, &radius, &angle, &branch), 5);
      EXPECT_EQ(x, sample.point[0]);
      EXPECT_EQ(radius, sample.radius);
      EXPECT_EQ(branch, b);
    }
  }
  EXPECT_FALSE(std::getline(lines, line));
}

// In a file whose y axis points down, coordinates are those of the file, and the view is its own; else up is up.
TEST(PlaneFiles, TheSvgFitsOnItsInput) {
  PlaneRecord record = record_of({rectangle_ring(2, 3, 6, 3)}, true);
  record.view_box = {0, 0, 10, 9};
  const std::string down = encode_plane_svg(record);
  EXPECT_THAT(down, HasSubstr("viewBox=\"0 0 10 9\""));
  const std::regex first_point("d=\"M([-0-9.]+) ([-0-9.]+)L");
  std::smatch match;
  ASSERT_TRUE(std::regex_search(down, match, first_point));
  EXPECT_GE(std::stod(match[2]), 3);
  const std::string up = encode_plane_svg(record_of({rectangle_ring(2, 3, 6, 3)}));
  EXPECT_THAT(up, HasSubstr("viewBox=\"1.76 -6.24 6.48 3.48\""));
  ASSERT_TRUE(std::regex_search(up, match, first_point));
  EXPECT_LE(std::stod(match[2]), -3);
  // A branch from a corner of radius 0 to one of 1.5 passes through all colours, and the middle keeps one.
  const auto polylines = [](const std::string& svg) {
    std::size_t count = 0;
    for (std::size_t at = svg.find("<polyline"); at != std::string::npos; at = svg.find("<polyline", at + 1)) ++count;
    return count;
  };
  EXPECT_EQ(polylines(up), polylines(down));
  EXPECT_GE(polylines(up), 4u * 30 + 1);
}

TEST(PlaneFiles, NothingFoundIsWritten) {
  PlaneRecord record = record_of({rectangle_ring(0, 0, 1, 1)});
  record.axis = PlaneAxis();
  record.lines.clear();
  EXPECT_TRUE(json::parse(encode_plane_json(record))["branches"].empty());
  EXPECT_TRUE(json::parse(encode_plane_geojson(record))["features"].empty());
  EXPECT_EQ(encode_plane_csv(record), "x,y,radius,object_angle,branch\n");
  EXPECT_THAT(encode_plane_svg(record), HasSubstr("class=\"shape\""));
  EXPECT_EQ(counts_of(record).least_radius, 0);
}

}  // namespace
}  // namespace medial_vk
