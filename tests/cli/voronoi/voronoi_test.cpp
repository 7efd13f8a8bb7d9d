// `medial-vk voronoi` from outside: exit codes, streams, files. Everything here runs without a Vulkan device.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "cli/tool_test.h"
#include "support/solids/mesh_files.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using test::read_file;
using test::ScratchFolder;
using test::ToolResult;
using test::write_file;
using testing::HasSubstr;
using testing::StartsWith;
using testing::UnorderedElementsAre;

class VoronoiCommand : public testing::Test {
 protected:
  void SetUp() override {
    write_file(scratch_.path("a.obj"), test::to_obj(test::make_box({1, 1, 1})));
    write_file(scratch_.path("b.obj"), test::to_obj(test::moved(test::make_box({1, 1, 1}), {3, 0, 0})));
  }

  ToolResult run(std::vector<std::string> arguments, const std::string& standard_input = {}) {
    arguments.insert(arguments.begin(), "voronoi");
    return test::Tool({.arguments = arguments, .folder = scratch_.path(""), .standard_input = standard_input}).wait();
  }

  nlohmann::json json_of(const std::string& file) { return nlohmann::json::parse(read_file(scratch_.path(file))); }

  ScratchFolder scratch_;
};

TEST_F(VoronoiCommand, WritesTheSurfaceAndTellsOfIt) {
  const ToolResult result = run({"a.obj", "b.obj", "--resolution", "30", "--report", "r.json", "--check"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("no other site is nearer"));
  EXPECT_THAT(result.err, HasSubstr("2 sites: 2 solids"));
  EXPECT_THAT(scratch_.names(), UnorderedElementsAre("a.obj", "a.voronoi.ply", "b.obj", "r.json"));
  EXPECT_THAT(read_file(scratch_.path("a.voronoi.ply")), StartsWith("ply\nformat binary_little_endian 1.0\n"));
  const auto report = json_of("r.json");
  EXPECT_EQ(report["surface"]["pieces"], 1);
  EXPECT_EQ(report["surface"]["undecided_voxels"], 0);
  EXPECT_GE(report["surface"]["least_clearance"].get<double>(), 1 - 1e-12);
  EXPECT_LT(report["surface"]["least_clearance"].get<double>(), 1.01);
  EXPECT_EQ(report["pairs"][0]["sites"], nlohmann::json({0, 1}));
}

TEST_F(VoronoiCommand, EveryFormatHoldsThePlaneBetweenTheBoxes) {
  for (const char* file : {"v.json", "v.csv", "v.obj", "v.npz", "v.glb"}) {
    ASSERT_EQ(run({"a.obj", "b.obj", "--resolution", "16", "-q", "-o", file}).exit_code, 0) << file;
  }
  const auto json = json_of("v.json");
  ASSERT_FALSE(json["points"].empty());
  for (const auto& point : json["points"]) EXPECT_NEAR(point["point"][0].get<double>(), 2, 1e-12);
  EXPECT_EQ(json["faces"].size(), json["pieces"][0]["faces"]);
  std::istringstream table(read_file(scratch_.path("v.csv")));
  std::string line;
  std::getline(table, line);
  std::size_t rows = 0;
  for (; std::getline(table, line); ++rows) EXPECT_NEAR(std::stod(line), 2, 1e-12);
  EXPECT_EQ(rows, json["points"].size());
  const std::string obj = read_file(scratch_.path("v.obj"));
  std::size_t vertices = 0;
  for (std::size_t at = obj.find("\nv "); at != std::string::npos; at = obj.find("\nv ", at + 1)) ++vertices;
  EXPECT_EQ(vertices, rows);
  EXPECT_THAT(obj, HasSubstr("g sites_0_1_piece_0\n"));
  EXPECT_THAT(read_file(scratch_.path("v.npz")), HasSubstr("face_sites.npy"));
  EXPECT_THAT(read_file(scratch_.path("v.glb")), HasSubstr("sites 0 and 1"));
}

TEST_F(VoronoiCommand, PointsSegmentsAndTrianglesAreSites) {
  const ToolResult result = run({"--point=-1,0,0", "--point", "1,0,0", "--segment", "0,3,-1,0,3,1", "--triangle",
                                 "-1,-2,0,1,-2,0,0,-2,1", "--resolution", "20", "-o", "-", "--ascii"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("comment site 3 triangle triangle 1\n"));
  EXPECT_THAT(result.err, HasSubstr("4 sites: 2 points, 1 segment, 1 triangle"));
}

TEST_F(VoronoiCommand, AnOpenMeshIsASurface) {
  write_file(scratch_.path("plate.obj"), "v 0 0 2\nv 1 0 2\nv 1 1 2\nv 0 1 2\nf 1 2 3\nf 1 3 4\n");
  const ToolResult result = run({"plate.obj", "a.obj", "--resolution", "16"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("plate: not closed: a surface, without an inside."));
}

TEST_F(VoronoiCommand, ConnectedPartsAreSitesWithSplit) {
  Mesh both = test::make_box({1, 1, 1});
  test::append(both, test::moved(test::make_box({1, 1, 1}), {3, 0, 0}));
  write_file(scratch_.path("both.obj"), test::to_obj(both));
  const ToolResult result = run({"both.obj", "--split", "--resolution", "16"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("2 sites: 2 solids"));
  const ToolResult whole = run({"both.obj", "--point", "5,5,5", "--resolution", "16"});
  EXPECT_THAT(whole.err, HasSubstr("2 sites: 1 solid, 1 point"));
}

TEST_F(VoronoiCommand, ARoadmapHasAPathThroughTheGap) {
  const ToolResult result = run({"a.obj", "b.obj", "--resolution", "30", "--roadmap", "m.json", "--from", "2,-0.5,0.5",
                                 "--to", "2,1.5,0.5", "--picture", "v.png"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto map = json_of("m.json");
  // The widest way is straight between the boxes, or around them: none is wider than the ends, 1.118 from the boxes.
  EXPECT_GT(map["path"]["width"].get<double>(), 0.99);
  EXPECT_LE(map["path"]["width"].get<double>(), std::sqrt(1.25));
  EXPECT_EQ(map["path"]["line"].front(), nlohmann::json({2.0, -0.5, 0.5}));
  for (const auto& link : map["links"]) EXPECT_GT(link["width"].get<double>(), 0);
  EXPECT_THAT(result.err, HasSubstr("path"));
  EXPECT_THAT(read_file(scratch_.path("v.png")).substr(0, 4), "\x89PNG");
}

TEST_F(VoronoiCommand, ShapesOfThePlaneHaveCurvesBetweenThem) {
  write_file(scratch_.path("one.csv"), "x,y\n0,0\n1,0\n1,1\n0,1\n");
  write_file(scratch_.path("two.csv"), "x,y\n3,0\n4,0\n4,1\n3,1\n");
  const ToolResult result = run({"one.csv", "two.csv", "--report", "r.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto curves = json_of("one.voronoi.json");
  EXPECT_EQ(curves["sites"], nlohmann::json({"one", "two"}));
  for (const auto& node : curves["nodes"]) EXPECT_NEAR(node["point"][0].get<double>(), 2, 1e-12);
  EXPECT_EQ(json_of("r.json")["curves"]["branches"], 1);
  ASSERT_EQ(run({"one.csv", "two.csv", "-q", "-o", "c.geojson"}).exit_code, 0);
  EXPECT_EQ(json_of("c.geojson")["features"][0]["properties"]["sites"], nlohmann::json({0, 1}));
  write_file(scratch_.path("across.csv"), "x,y\n0.5,0\n2,0\n2,1\n0.5,1\n");
  const ToolResult crossing = run({"one.csv", "across.csv"});
  EXPECT_EQ(crossing.exit_code, 3);
  EXPECT_THAT(crossing.err, HasSubstr("must be apart"));
}

TEST_F(VoronoiCommand, PagesAreWrittenBesideTheResult) {
  write_file(scratch_.path("one.csv"), "x,y\n0,0\n1,0\n1,1\n0,1\n");
  write_file(scratch_.path("two.csv"), "x,y\n3,0\n4,0\n4,1\n3,1\n");
  const ToolResult space = run({"a.obj", "b.obj", "--resolution", "16", "-q", "--html", "v.html"});
  if (space.exit_code == 2 && space.err.find("was built without its page") != std::string::npos) GTEST_SKIP();
  ASSERT_EQ(space.exit_code, 0) << space.err;
  // tests/page shows what is in it.
  EXPECT_THAT(read_file(scratch_.path("v.html")), HasSubstr(R"("sites":[{"name":"a","kind":"solid"})"));
  ASSERT_EQ(run({"one.csv", "two.csv", "-q", "--html", "p.html"}).exit_code, 0);
  EXPECT_THAT(read_file(scratch_.path("p.html")), HasSubstr(R"("branches",1])"));
  EXPECT_EQ(run({"a.obj", "b.obj", "--html", "v.htm"}).exit_code, 2);
}

TEST_F(VoronoiCommand, ShapesOfThePlaneThatTouchAreRefused) {
  const std::string square = "x,y\n0,0\n1,0\n1,1\n0,1\n";
  const std::string triangle = "x,y\n0,0\n1,0\n0.5,1\n";
  const std::vector<std::array<std::string, 3>> cases = {
      {"the same shape", square, square},
      {"a common corner", square, "x,y\n1,1\n2,1\n2,2\n1,2\n"},
      {"a common corner within the tolerance", square, "x,y\n1.00000000000001,1\n2,1\n2,2\n1,2\n"},
      {"a common vertex of triangles", triangle, "x,y\n0.5,1\n1,2\n0,2\n"},
      {"a vertex on an edge", square, "x,y\n1,0.5\n2,0\n2,1\n"},
      {"a common edge", square, "x,y\n1,0\n2,0\n2,1\n1,1\n"},
      {"one in the other", square, "x,y\n0.2,0.2\n0.8,0.2\n0.8,0.8\n"}};
  for (const auto& [name, first, second] : cases) {
    write_file(scratch_.path("first.csv"), first);
    write_file(scratch_.path("second.csv"), second);
    const ToolResult result = run({"first.csv", "second.csv"});
    EXPECT_EQ(result.exit_code, 3) << name;
    EXPECT_THAT(result.err, HasSubstr("must be apart")) << name;
  }
  // Shapes in a hole, and shapes whose rings touch themselves, are apart from others.
  write_file(scratch_.path("first.wkt"), "POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (3 3, 3 6, 6 6, 6 3, 3 3))");
  write_file(scratch_.path("second.wkt"), "MULTIPOLYGON (((4 4, 5 4, 4.5 4.5, 4 4)), ((4.5 4.5, 5 5, 4 5, 4.5 4.5)))");
  const ToolResult apart = run({"first.wkt", "second.wkt"});
  EXPECT_EQ(apart.exit_code, 0) << apart.err;
}

TEST_F(VoronoiCommand, OptionsOfSpaceAreRefusedInThePlane) {
  write_file(scratch_.path("one.csv"), "x,y\n0,0\n1,0\n1,1\n0,1\n");
  write_file(scratch_.path("two.csv"), "x,y\n3,0\n4,0\n4,1\n3,1\n");
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{"--resolution", "160"}, {"--split"}, {"--ascii"}}) {
    std::vector<std::string> arguments = {"one.csv", "two.csv"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ToolResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << options[0];
    EXPECT_THAT(result.err, HasSubstr("about sites in space"));
  }
  // Places of the plane have two numbers.
  for (const char* place : {"", "1", "1,2,3"}) {
    const ToolResult result = run({"one.csv", "two.csv", "--roadmap", "m.json", "--from", place, "--to", "2,2"});
    EXPECT_EQ(result.exit_code, 2) << place;
    EXPECT_THAT(result.err, HasSubstr("is not")) << place;
  }
}

TEST_F(VoronoiCommand, ARoadmapOfThePlaneHasTheExactWidthOfTheGap) {
  write_file(scratch_.path("one.csv"), "x,y\n0,0\n1,0\n1,1\n0,1\n");
  write_file(scratch_.path("two.csv"), "x,y\n3,0\n4,0\n4,1\n3,1\n");
  const ToolResult result = run(
      {"one.csv", "two.csv", "--roadmap", "m.json", "--from", "2,0", "--to", "2,1", "--check", "--report", "r.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  EXPECT_THAT(result.out, HasSubstr("samples of the exact curves are on the arcs"));
  EXPECT_THAT(result.out, HasSubstr("no site is nearer to a link or the path than its width"));
  EXPECT_THAT(result.err, HasSubstr("path      width 1, length 1"));
  const auto map = json_of("m.json"), report = json_of("r.json"), curves = json_of("one.voronoi.json");
  // 2 epsilons by proof, and what a node is beside its arc.
  const double least = 1 - 3 * map["epsilon"].get<double>();
  EXPECT_LE(map["path"]["width"].get<double>(), 1);
  EXPECT_GE(map["path"]["width"].get<double>(), least);
  EXPECT_EQ(map["path"]["line"].front(), nlohmann::json({2.0, 0.0}));
  EXPECT_EQ(map["components"], 1);
  EXPECT_EQ(map["nodes"].size(), curves["nodes"].size());
  ASSERT_EQ(map["links"].size(), curves["arcs"].size());
  for (const auto& link : map["links"]) {
    EXPECT_EQ(link["nodes"], curves["arcs"][link["arc"].get<std::size_t>()]["nodes"]);
    EXPECT_GE(link["width"].get<double>(), least);
  }
  EXPECT_EQ(report["path"]["width"], map["path"]["width"]);
  EXPECT_EQ(report["roadmap"]["links"], map["links"].size());
  const ToolResult inside = run({"one.csv", "two.csv", "--roadmap", "m.json", "--from", "0.5,0.5", "--to", "2,2"});
  EXPECT_EQ(inside.exit_code, 2);
  EXPECT_THAT(inside.err, HasSubstr("--from must be outside of all sites"));
  // The second shape is in a hole of the first one: from there no curve leads out.
  write_file(scratch_.path("ring.wkt"), "POLYGON ((-9 -9, 9 -9, 9 9, -9 9, -9 -9), (-3 -3, -3 3, 3 3, 3 -3, -3 -3))");
  write_file(scratch_.path("core.wkt"), "POLYGON ((-1 -1, 1 -1, 1 1, -1 1, -1 -1))");
  const ToolResult closed =
      run({"ring.wkt", "core.wkt", "--roadmap", "m.json", "--from", "2,0", "--to", "10,10", "--check"});
  ASSERT_EQ(closed.exit_code, 0) << closed.err << closed.out;
  EXPECT_THAT(closed.err, HasSubstr("none found from 2,0 to 10,10"));
  const ToolResult around = run({"ring.wkt", "core.wkt", "--roadmap", "m.json", "--from", "1.8,1.8", "--to",
                                 "-1.8,-1.8", "--check", "-o", "c.svg", "--picture", "c.png"});
  ASSERT_EQ(around.exit_code, 0) << around.err;
  EXPECT_THAT(read_file(scratch_.path("c.svg")), HasSubstr("stroke=\"#d91a1a\" points=\"1.8,-1.8 "));
  EXPECT_THAT(read_file(scratch_.path("c.png")).substr(0, 4), "\x89PNG");
  EXPECT_NEAR(json_of("m.json")["path"]["width"].get<double>(), 1, 1e-3);
}

TEST_F(VoronoiCommand, APathThatIsNotFoundIsNamed) {
  // The triangles of a box, each one a site: no way leads out of it.
  const Mesh box = test::make_box({1, 1, 1});
  std::vector<std::string> arguments = {"--resolution", "12",     "--roadmap",   "m.json", "-o",
                                        "v.ply",        "--from", "0.5,0.6,0.4", "--to",   "1.8,0.5,0.5"};
  for (const Triangle& t : box.triangles) {
    std::ostringstream numbers;
    for (std::size_t i = 0; i < 9; ++i) numbers << (i > 0 ? "," : "") << box.vertices[t[i / 3]][i % 3];
    arguments.insert(arguments.end(), {"--triangle", numbers.str()});
  }
  const ToolResult result = run(arguments);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("none found from 0.5,0.6,0.4 to 1.8,0.5,0.5"));
}

TEST_F(VoronoiCommand, WrongUseAndInvalidSitesHaveTheirExitCodes) {
  EXPECT_EQ(run({"a.obj"}).exit_code, 2);
  EXPECT_EQ(run({"a.obj", "--point", "1,2"}).exit_code, 2);
  EXPECT_EQ(run({"a.obj", "b.obj", "--from", "0,0,0"}).exit_code, 2);
  EXPECT_EQ(run({"a.obj", "b.obj", "-o", "v.stl"}).exit_code, 2);
  EXPECT_EQ(run({"a.obj", "b.obj", "-o", "a.obj"}).exit_code, 2);
  const ToolResult inside = run({"a.obj", "b.obj", "--roadmap", "m.json", "--from", "0.5,0.5,0.5", "--to", "2,0,0"});
  EXPECT_EQ(inside.exit_code, 2);
  EXPECT_THAT(inside.err, HasSubstr("--from must be outside of all sites"));
  // Before the search, which takes minutes at this resolution.
  const ToolResult at_once = run({"a.obj", "b.obj", "--resolution", "2048", "--roadmap", "m.json", "--from", "2,0,0",
                                  "--to", "3.5,0.5,0.5", "-v"});
  EXPECT_EQ(at_once.exit_code, 2);
  EXPECT_THAT(at_once.err, HasSubstr("--to must be outside of all sites"));
  EXPECT_EQ(run({"a.obj", "b.obj", "--roadmap", "m.json", "--from", "", "--to", ""}).exit_code, 2);
  const ToolResult twice = run({"a.obj", "a.obj"});
  EXPECT_EQ(twice.exit_code, 3);
  EXPECT_THAT(twice.err, HasSubstr("sites 0 and 1 have the same elements"));
  EXPECT_EQ(run({"a.obj", "missing.obj"}).exit_code, 3);
  EXPECT_EQ(run({"a.obj", "b.obj", "-o", "no/v.ply"}).exit_code, 6);
}

TEST_F(VoronoiCommand, OverlapsAreReported) {
  write_file(scratch_.path("c.obj"), test::to_obj(test::moved(test::make_box({1, 1, 1}), {0.6, 0.3, 0.2})));
  const ToolResult result =
      run({"a.obj", "c.obj", "--resolution", "16", "--margin", "0.5", "--report", "r.json", "-o", "v.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("a and c overlap"));
  const auto report = json_of("r.json"), surface = json_of("v.json");
  EXPECT_EQ(report["surface"]["overlaps"], nlohmann::json({{0, 1}}));
  const auto& listed = report["voxels"]["overlapping"];
  ASSERT_FALSE(surface["overlapping"].empty());
  EXPECT_EQ(listed["count"], surface["overlapping"].size());
  EXPECT_EQ(report["surface"]["overlapping_voxels"], surface["overlapping"].size());
  ASSERT_EQ(listed["first"].size(), std::min<std::size_t>(surface["overlapping"].size(), 1000));
  // A voxel that overlaps is near both boxes: within half of its diagonal and that of its neighbours.
  const double reach = 1.5 * std::sqrt(3.0) * surface["grid"]["voxel_side"].get<double>();
  const std::array<double, 3> lower = {0.6, 0.3, 0.2};
  for (std::size_t i = 0; i < listed["first"].size(); ++i) {
    EXPECT_EQ(listed["first"][i]["voxel"], surface["overlapping"][i]);
    for (std::size_t k = 0; k < 3; ++k) {
      const double middle = listed["first"][i]["middle"][k];
      EXPECT_GE(middle, lower[k] - reach);
      EXPECT_LE(middle, 1 + reach);
    }
  }
}

TEST_F(VoronoiCommand, TiedVoxelsAreListedUpToALimit) {
  // Two triangles with a common edge along x: on the far side of it, both are as near by the same points of it.
  const std::vector<std::string> sites = {"--triangle", "0,0,0,1,0,0,0.5,1,0", "--triangle", "0,0,0,1,0,0,0.5,0,1"};
  std::vector<std::string> arguments = sites;
  arguments.insert(arguments.end(), {"--resolution", "40", "--report", "r.json", "-o", "v.npz"});
  const ToolResult result = run(arguments);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto report = json_of("r.json");
  const auto& tied = report["voxels"]["tied"];
  ASSERT_GT(tied["count"].get<std::size_t>(), 1000u);
  EXPECT_EQ(tied["first"].size(), 1000u);
  EXPECT_EQ(report["voxels"]["listed_at_most"], 1000);
  const double half = 0.5 * report["grid"]["voxel_side"].get<double>();
  for (const auto& voxel : tied["first"]) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double middle =
          report["grid"]["origin"][k].get<double>() + (2 * voxel["voxel"][k].get<double>() + 1) * half;
      EXPECT_NEAR(voxel["middle"][k].get<double>(), middle, 1e-12);
    }
  }
  EXPECT_THAT(read_file(scratch_.path("v.npz")), HasSubstr("tied.npy"));
}

}  // namespace
}  // namespace medial_vk
