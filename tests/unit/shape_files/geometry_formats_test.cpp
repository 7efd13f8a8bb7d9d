// GeoJSON, WKT and tables of points: what is read, what is left out, and mistakes.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "unit/shape_files/read_for_tests.h"

namespace medial_vk {
namespace {

using shape_tests::area_of;
using shape_tests::expect_ring;
using shape_tests::fault_of;
using shape_tests::shape_of;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string geojson(const std::string& type, const std::string& coordinates) {
  return R"({"type":")" + type + R"(","coordinates":)" + coordinates + "}";
}

ShapeFile shape_of_geojson(const std::string& text) { return shape_of(text, "g.geojson"); }
ShapeFile shape_of_wkt(const std::string& text) { return shape_of(text, "g.wkt"); }
std::string fault_of_geojson(const std::string& text) { return fault_of(text, "g.geojson"); }
std::string fault_of_wkt(const std::string& text) { return fault_of(text, "g.wkt"); }

const std::string kOuter = "[[0,0],[4,0],[4,4],[0,4],[0,0]]";
const std::string kHole = "[[1,1],[1,2],[2,2],[2,1],[1,1]]";
const std::string kTurnedHole = "[[1,1],[2,1],[2,2],[1,2],[1,1]]";

TEST(GeoJson, PolygonsWithHolesOfEitherSense) {
  for (const std::string& hole : {kHole, kTurnedHole}) {
    const ShapeFile shape = shape_of_geojson(geojson("Polygon", fmt::format("[{},{}]", kOuter, hole)));
    EXPECT_EQ(shape.format, ShapeFormat::kGeoJson);
    EXPECT_EQ(shape.rings.size(), 2u);
    EXPECT_EQ(area_of(shape), 15);
    EXPECT_FALSE(shape.y_is_down);
    EXPECT_THAT(shape.assumptions, IsEmpty());
  }
}

/// The second polygon covers half of the hole of the first one, and its right part; it goes round the other way.
TEST(GeoJson, PolygonsAreUnited) {
  const std::string second = "[[[1,1],[1,1.5],[9,1.5],[9,1],[1,1]]]";
  const ShapeFile shape =
      shape_of_geojson(geojson("MultiPolygon", "[[" + kOuter + "," + kTurnedHole + "]," + second + "]"));
  EXPECT_EQ(area_of(shape), 15 + 0.5 + 2.5);
  EXPECT_EQ(shape.areas, 2u);
  EXPECT_THAT(shape.assumptions, ElementsAre("2 areas are united."));
}

TEST(GeoJson, FeaturesAndCollections) {
  const std::string square = geojson("Polygon", "[" + kOuter + "]");
  EXPECT_EQ(area_of(shape_of_geojson(R"({"type":"Feature","properties":null,"geometry":)" + square + "}")), 16);
  const std::string features = R"({"type":"FeatureCollection","features":[{"type":"Feature","geometry":null},
      {"type":"Feature","geometry":)" +
                               square + R"(},{"type":"Feature","geometry":{"type":"GeometryCollection",
      "geometries":[{"type":"Point","coordinates":[1,2]},)" +
                               geojson("MultiPoint", "[[1,2]]") + "," +
                               geojson("Polygon", "[[[9,0],[10,0],[10,1],[9,0]]]") + "]}}]}";
  const ShapeFile shape = shape_of_geojson(features);
  EXPECT_EQ(area_of(shape), 16.5);
  EXPECT_THAT(shape.assumptions, ElementsAre("2 geometries of points are left out.", "2 areas are united."));
}

/// Together they are one area, in which the second is a hole.
TEST(GeoJson, LinesAreOutlines) {
  const ShapeFile shape =
      shape_of_geojson(geojson("MultiLineString", "[" + kOuter + ",[[1,1,7],[2,1,7],[2,2,7]],[[1,1],[2,1]]]"));
  EXPECT_EQ(area_of(shape), 15.5);
  EXPECT_EQ(shape.closed_lines, 1u);
  EXPECT_THAT(shape.assumptions, ElementsAre("1 open line is closed by a straight segment.",
                                             "2 lines are outlines together: a line within another one is a hole.",
                                             "1 line of fewer than three different points is left out."));
  EXPECT_EQ(area_of(shape_of_geojson(geojson("LineString", kOuter))), 16);
}

TEST(GeoJson, AnOpenRingIsClosedAndSaid) {
  const ShapeFile shape = shape_of_geojson(geojson("Polygon", "[[[0,0,5],[4,0,6],[4,4,7]]]"));
  EXPECT_EQ(area_of(shape), 8);
  EXPECT_THAT(shape.assumptions, ElementsAre("1 open line is closed by a straight segment."));
}

TEST(GeoJson, MistakesAreNamed) {
  EXPECT_EQ(fault_of_geojson("{\n\"type\": }"), "g.geojson:2: this is no well-formed JSON");
  EXPECT_EQ(fault_of_geojson("{"), "g.geojson:1: this is no well-formed JSON");
  EXPECT_EQ(fault_of_geojson("[]"), "g.geojson: this is no object");
  EXPECT_EQ(fault_of_geojson("{}"), "g.geojson: the object has no type");
  EXPECT_EQ(fault_of_geojson(R"({"type":"Topology"})"), "g.geojson: the type \"Topology\" is unknown");
  EXPECT_EQ(fault_of_geojson(R"({"type":"Polygon"})"), "g.geojson: there is no list of coordinates");
  EXPECT_EQ(fault_of_geojson(R"({"type":"Feature"})"), "g.geojson: the Feature has no geometry");
  EXPECT_EQ(fault_of_geojson(R"({"type":"FeatureCollection","features":[{"type":"Feature","geometry":)" +
                             geojson("Polygon", "[" + kOuter + ",[[1,2],[3]]]") + "}]}"),
            "g.geojson: features[0].geometry.coordinates[1]: position 1 is not two or more numbers of 1e150 at most");
  EXPECT_THAT(fault_of_geojson(geojson("Polygon", "[[[0,0],[1e151,0],[4,4]]]")),
              HasSubstr("coordinates[0]: position 1"));
  EXPECT_EQ(fault_of_geojson(geojson("Polygon", "[[[0,0],[1e999,0],[4,4]]]")),
            "g.geojson: a number is beyond the range of a double");
  EXPECT_EQ(fault_of_geojson(geojson("Point", "[1,2]")),
            "g.geojson: this GeoJSON has no polygon and no line that encloses anything");
  EXPECT_EQ(fault_of_geojson(geojson("Polygon", "[[[0,0],[1,1],[0,0]]]")),
            "g.geojson: no area of it encloses anything");
}

TEST(GeoJson, DepthIsLimited) {
  const auto collections = [](std::size_t depth) {
    return shape_tests::nested(depth, R"({"type":"GeometryCollection","geometries":[)",
                               geojson("Polygon", "[" + kOuter + "]"), "]}");
  };
  EXPECT_EQ(area_of(shape_of_geojson(collections(64))), 16);
  const std::string fault = fault_of_geojson(collections(65));
  EXPECT_THAT(fault, HasSubstr("collections are nested too deeply"));
  EXPECT_LT(fault.size(), 300u);
  EXPECT_THAT(fault_of_geojson(std::string(1'000'000, '[')), HasSubstr("no well-formed JSON"));
  EXPECT_THAT(fault_of_geojson(geojson("Polygon", std::string(100'000, '[') + std::string(100'000, ']'))),
              HasSubstr("coordinates[0]: position 0"));
}

TEST(Wkt, EachGeometry) {
  const std::string square = "((0 0, 4 0, 4 4, 0 4, 0 0)";
  EXPECT_EQ(area_of(shape_of_wkt("POLYGON" + square + ")")), 16);
  EXPECT_EQ(area_of(shape_of_wkt("polygon " + square + ", (1 1, 2 1, 2 2, 1 2, 1 1))")), 15);
  EXPECT_EQ(area_of(shape_of_wkt("Polygon " + square + ", (1 1, 1 2, 2 2, 2 1, 1 1))")), 15);
  EXPECT_EQ(area_of(shape_of_wkt("MULTIPOLYGON(" + square + "),((2 0,6 0,6 4,2 4,2 0)))")), 24);
  EXPECT_EQ(area_of(shape_of_wkt("LINESTRING(0 0,4 0,4 4,0 0)")), 8);
  EXPECT_EQ(area_of(shape_of_wkt("MULTILINESTRING" + square + ",(1 1,2 1,2 2))")), 15.5);
  EXPECT_EQ(area_of(shape_of_wkt("TRIANGLE((0 0,4 0,4 4,0 0))")), 8);
  EXPECT_EQ(area_of(shape_of_wkt("GEOMETRYCOLLECTION(POINT(1 2),GEOMETRYCOLLECTION(POLYGON" + square + ")))")), 16);
}

TEST(Wkt, FurtherCoordinatesAreIgnored) {
  for (const char* text : {"POLYGON Z((0 0 9,4 0 9,4 4 9,0 0 9))", "POLYGONZ((0 0 9,4 0 9,4 4 9,0 0 9))",
                           "POLYGON M ((0 0 9,4 0 9,4 4 9,0 0 9))", "POLYGON ZM((0 0 9 9,4 0 9 9,4 4 9 9,0 0 9 9))",
                           "polygonzm((0 0 9 9,4 0 9 9,4 4 9 9,0 0 9 9))", "POLYGON((0 0 9,4 0 9,4 4 9,0 0 9))",
                           "SRID=4326;POLYGON((0 0,4 0,4 4,0 0))", "\xef\xbb\xbfPOLYGON((0 0,4 0,4 4,0 0));"}) {
    EXPECT_EQ(area_of(shape_of_wkt(text)), 8) << text;
  }
}

TEST(Wkt, SeveralGeometriesAndEmptyOnes) {
  const ShapeFile shape = shape_of_wkt(
      "POLYGON EMPTY\r\nPOLYGON((0 0,4 0,4 4,0 0))\n\nMULTIPOLYGON(EMPTY,((9 0,10 0,10 1,9 0)))\n"
      "SRID=1;POINT Z EMPTY\nMULTIPOINT((1 2),(3 4))\nPOINT(1 2)\nMULTIPOINT(1 2,EMPTY)\nLINESTRING Z EMPTY\n");
  EXPECT_EQ(area_of(shape), 8.5);
  EXPECT_THAT(shape.assumptions, ElementsAre("3 geometries of points are left out.", "2 areas are united."));
}

TEST(Wkt, MistakesAreNamed) {
  EXPECT_EQ(fault_of_wkt("POLYGON((0 0,\n1 x,2 2))"), "g.wkt:2: \"x\" is not a number");
  EXPECT_EQ(fault_of_wkt("POLYGON((0 0,1 1"), "g.wkt:1: ')' is expected before the end of the file");
  EXPECT_EQ(fault_of_wkt("\n\nCIRCULARSTRING(0 0,1 1,2 0)"),
            "g.wkt:3: the geometry \"CIRCULARSTRING\" is not supported");
  EXPECT_EQ(fault_of_wkt("POLYGON(0 0,1 1)"), "g.wkt:1: '(' is expected before \"0 0,1 1)\"");
  EXPECT_EQ(fault_of_wkt("POLYGON Z((0 0,1 1,2 0))"), "g.wkt:1: numbers of a position: 2 instead of 3");
  EXPECT_EQ(fault_of_wkt("POLYGON((0 0,1,2 0))"), "g.wkt:1: numbers of a position: 1 instead of 2 to 4");
  EXPECT_EQ(fault_of_wkt("POLYGON((0 0,1e151 1,2 0))"), "g.wkt:1: \"1e151\" is beyond 1e150");
  EXPECT_EQ(fault_of_wkt("POLYGON((0 0,nan 1,2 0))"), "g.wkt:1: \"nan\" is not finite");
  EXPECT_EQ(fault_of_wkt("SRID=x;POINT(1 1)"), "g.wkt:1: SRID= is not followed by a whole number and ';'");
  EXPECT_EQ(fault_of_wkt("POLYGON((0 0,4 0,4 4))) "), "g.wkt:1: a geometry is expected before \") \"");
  EXPECT_EQ(fault_of_wkt("MULTIPOINT((1 1)"), "g.wkt:1: the file ends within brackets");
  EXPECT_EQ(fault_of_wkt("POLYGON EMPTY"), "g.wkt: this WKT has no polygon and no line that encloses anything");
  std::string nested;
  for (int i = 0; i < 65; ++i) nested += "GEOMETRYCOLLECTION(";
  EXPECT_THAT(fault_of_wkt(nested + "GEOMETRYCOLLECTION EMPTY"), HasSubstr("nested too deeply"));
}

TEST(RingTable, WithAndWithoutNames) {
  const PlaneRing triangle = {{0, 0}, {4, 0}, {4, 4}};
  for (const char* text : {"0,0\n4,0\n4,4\n", "x,y\n0,0\n4,0\n4,4", "X, Y\r\n0, 0\r\n4, 0\r\n4, 4\r\n0, 0\r\n",
                           "name,y,x\na,0,0\nb,0,4\nc,4,4\n", "\n\nx,y\n0,0\n4,0\n4,4\n"}) {
    const ShapeFile shape = shape_of(text, "t.csv");
    ASSERT_EQ(shape.rings.size(), 1u) << text;
    expect_ring(shape.rings[0], triangle, 0);
    EXPECT_THAT(shape.assumptions, IsEmpty());
    EXPECT_EQ(shape.fill_rule, FillRule::kEvenOdd);
  }
}

TEST(RingTable, RingsAreSeparatedByBlankLinesOrAColumn) {
  for (const char* text : {"0,0\n4,0\n4,4\n0,4\n\n1,1\n2,1\n2,2\n", "0,0\n4,0\n4,4\n0,4\n \t\n\n1,1\n2,1\n2,2\n",
                           "0,0,a\n4,0,a\n4,4,a\n0,4,a\n1,1,b\n2,1,b\n2,2,b\n",
                           "ring,x,y\n7,0,0\n7,4,0\n7,4,4\n7,0,4\n8,1,1\n8,2,1\n8,2,2\n",
                           "x,y,ring\n0,0,7\n4,0,7\n4,4,7\n0,4,7\n\n1,1,7\n2,1,7\n2,2,7\n"}) {
    const ShapeFile shape = shape_of(text, "t.csv");
    EXPECT_EQ(shape.rings.size(), 2u) << text;
    EXPECT_EQ(area_of(shape), 15.5) << text;
  }
}

TEST(RingTable, MistakesAreNamed) {
  EXPECT_EQ(fault_of("0,0\n1,x\n", "t.csv"), "t.csv:2: \"x\" is not a number");
  EXPECT_EQ(fault_of("x,y\n\n1,2,3\n", "t.csv"), "t.csv:3: 3 values, where the first line has 2");
  EXPECT_EQ(fault_of("x,z\n1,2\n", "t.csv"),
            "t.csv:1: the first line must name the columns x and y, and others as it likes, or none");
  EXPECT_EQ(fault_of("x,y,X\n", "t.csv"), "t.csv:1: two columns are named x");
  EXPECT_EQ(fault_of("1\n", "t.csv"), "t.csv:1: 1 values instead of x,y or x,y,ring");
  EXPECT_EQ(fault_of("x,y\n", "t.csv"), "t.csv: there is no point");
  EXPECT_EQ(fault_of("0,0\n1e151,0\n", "t.csv"), "t.csv:2: \"1e151\" is beyond 1e150");
  EXPECT_EQ(fault_of("0,0\n1,1\n", "t.csv"), "t.csv: no area of it encloses anything");
}

TEST(ShapeFiles, FormatsByExtensionOrContent) {
  const auto format = [](const std::string& text, const std::string& name) { return shape_of(text, name).format; };
  EXPECT_EQ(format(geojson("LineString", kOuter), "a.txt"), ShapeFormat::kGeoJson);
  EXPECT_EQ(format(geojson("LineString", kOuter), "a.JSON"), ShapeFormat::kGeoJson);
  EXPECT_EQ(format("srid=3;POLYGON((0 0,1 0,1 1))", "a"), ShapeFormat::kWkt);
  EXPECT_EQ(format("x,y\n0,0\n1,0\n1,1\n", "a"), ShapeFormat::kCsv);
  EXPECT_THAT(fault_of("x,y\n", "a.wkt"), HasSubstr("the geometry \"x\" is not supported"));
  EXPECT_TRUE(has_shape_extension("a.b/c.SVG"));
  EXPECT_FALSE(has_shape_extension("a.svg/c"));
  EXPECT_FALSE(has_shape_extension("c.obj"));
  EXPECT_EQ(name_of_format(ShapeFormat::kWkt), "WKT");
}

TEST(ShapeFiles, AreReadFromFiles) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "shape_file_test.wkt";
  std::ofstream(path) << "POLYGON((0 0,4 0,4 4,0 0))";
  const Result<ShapeFile> shape = read_shape_file(path.string());
  ASSERT_TRUE(shape.ok()) << shape.error().message;
  EXPECT_EQ(area_of(shape.value()), 8);
  std::filesystem::remove(path);
  const Result<ShapeFile> missing = read_shape_file(path.string());
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().code, ErrorCode::kInvalidMesh);
  EXPECT_THAT(missing.error().message, HasSubstr("cannot open"));
}

TEST(ShapeFiles, AreInterrupted) {
  std::stop_source source;
  source.request_stop();
  ShapeFileOptions options;
  options.stop = source.get_token();
  const Result<ShapeFile> shape = parse_shape_file("POLYGON((0 0,1 0,1 1)) POLYGON((0 0,1 0,1 1))", "a.wkt", options);
  ASSERT_FALSE(shape.ok());
  EXPECT_EQ(shape.error().code, ErrorCode::kInterrupted);
}

}  // namespace
}  // namespace medial_vk
