// `medial-vk plane` from outside: exit codes, streams, files. Everything here runs without a Vulkan device.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <thread>
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
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kRectangle = "x,y\n0,0\n3,0\n3,1.5\n0,1.5\n";

class PlaneCommand : public testing::Test {
 protected:
  ToolResult run(std::vector<std::string> arguments, const std::string& standard_input = {}) {
    arguments.insert(arguments.begin(), "plane");
    return test::Tool({.arguments = arguments, .folder = scratch_.path(""), .standard_input = standard_input}).wait();
  }

  nlohmann::json json_of(const std::string& file) { return nlohmann::json::parse(read_file(scratch_.path(file))); }

  ScratchFolder scratch_;
};

TEST_F(PlaneCommand, WritesTheGraphAndTellsOfIt) {
  write_file(scratch_.path("plate.csv"), kRectangle);
  const ToolResult result = run({"plate.csv", "--report", "report.json", "--check"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("samples of the exact axis are on the arcs"));
  EXPECT_THAT(result.err, HasSubstr("plate.csv: CSV, 4 segments, area 4.5, perimeter 9"));
  EXPECT_THAT(result.err, HasSubstr("5 branches, 2 junctions, 4 ends"));
  EXPECT_THAT(scratch_.names(), ElementsAre("plate.axis.json", "plate.csv", "report.json"));
  EXPECT_EQ(json_of("plate.axis.json")["branches"].size(), 5u);
  const auto report = json_of("report.json");
  EXPECT_EQ(report["axis"]["junctions"], 2);
  EXPECT_NEAR(report["axis"]["length"].get<double>(), 1.5 + 3 * std::numbers::sqrt2, 1e-9);
  EXPECT_NEAR(report["axis"]["greatest_radius"].get<double>(), 0.75, 1e-9);
}

TEST_F(PlaneCommand, FindsPointsAsPublished) {
  write_file(scratch_.path("plate.csv"), kRectangle);
  const ToolResult result =
      run({"plate.csv", "--mode", "thesis", "-o", "a.csv", "--report", "r.json", "--picture", "a.png"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("can miss object angles up to"));
  const auto report = json_of("r.json");
  EXPECT_EQ(report["options"]["mode"], "thesis");
  EXPECT_GT(report["published"]["discs"], 1000);
  std::istringstream lines(read_file(scratch_.path("a.csv")));
  std::string line;
  std::getline(lines, line);
  std::size_t points = 0;
  for (; std::getline(lines, line); ++points) {
    double x = 0, y = 0, radius = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf", &x, &y, &radius), 3) << line;
    // Of the five branches of a rectangle, each point is equally far from two sides.
    const double across = std::min(x, 3 - x), along = std::min(y, 1.5 - y);
    EXPECT_NEAR(radius, std::min(across, along), 1e-8) << line;
    EXPECT_TRUE(std::fabs(across - along) < 1e-8 || (std::fabs(y - 0.75) < 1e-8 && across > 0.75)) << line;
    EXPECT_TRUE(line.ends_with(",-1")) << line;
  }
  EXPECT_EQ(points, report["axis"]["points"]);
  EXPECT_GT(points, 100u);
}

TEST_F(PlaneCommand, EveryFormatAndEveryStream) {
  write_file(scratch_.path("plate.csv"), kRectangle);
  ASSERT_EQ(run({"plate.csv", "-q", "-o", "a.geojson", "--picture", "a.png"}).exit_code, 0);
  EXPECT_EQ(json_of("a.geojson")["features"].size(), 5u + 6);
  EXPECT_EQ(read_file(scratch_.path("a.png")).substr(1, 3), "PNG");
  ASSERT_EQ(run({"plate.csv", "-q", "-o", "a.svg"}).exit_code, 0);
  EXPECT_THAT(read_file(scratch_.path("a.svg")), testing::StartsWith("<svg "));
  ASSERT_EQ(run({"plate.csv", "-q", "-o", "a.csv"}).exit_code, 0);
  EXPECT_THAT(read_file(scratch_.path("a.csv")), testing::StartsWith("x,y,radius,object_angle,branch\n"));
  const ToolResult stream = run({"-", "-o", "-"}, "POLYGON ((0 0, 3 0, 3 1.5, 0 1.5, 0 0))");
  ASSERT_EQ(stream.exit_code, 0) << stream.err;
  EXPECT_EQ(nlohmann::json::parse(stream.out)["branches"].size(), 5u);
}

TEST_F(PlaneCommand, PrunesToACentreLine) {
  write_file(scratch_.path("plate.csv"), kRectangle);
  const ToolResult pruned = run({"plate.csv", "-o", "p.json", "--prune-significance", "15%", "--smooth", "1%"});
  ASSERT_EQ(pruned.exit_code, 0) << pruned.err;
  EXPECT_THAT(pruned.err, HasSubstr("1 branch, 0 junctions, 2 ends of 5 found"));
  EXPECT_NEAR(json_of("p.json")["branches"][0]["length"].get<double>(), 1.5, 1e-9);
  const ToolResult path = run({"plate.csv", "-o", "l.json", "--longest-path"});
  ASSERT_EQ(path.exit_code, 0) << path.err;
  EXPECT_NEAR(json_of("l.json")["branches"][0]["length"].get<double>(), 1.5 + 1.5 * std::numbers::sqrt2, 1e-9);
}

TEST_F(PlaneCommand, SlicesAMesh) {
  write_file(scratch_.path("box.obj"), test::to_obj(test::make_box({2, 4, 3})));
  const ToolResult slice = run({"box.obj", "--slice", "z=50%", "-o", "s.json", "--report", "r.json"});
  ASSERT_EQ(slice.exit_code, 0) << slice.err;
  EXPECT_THAT(slice.err, HasSubstr("box.obj: slice at z = 1.5"));
  EXPECT_EQ(json_of("r.json")["shape"]["area"], 8);
  EXPECT_NEAR(json_of("r.json")["axis"]["greatest_radius"].get<double>(), 1, 1e-9);
  EXPECT_EQ(run({"box.obj", "--slice", "z=9"}).exit_code, 3);
  const ToolResult wrong = run({"box.obj", "--slice", "w=1"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("--slice: "));
}

TEST_F(PlaneCommand, TheOutsideAndAnyNumberOfThreads) {
  write_file(scratch_.path("two.wkt"), "MULTIPOLYGON (((0 0, 1 0, 1 1, 0 1, 0 0)), ((3 0, 4 0, 4 1, 3 1, 3 0)))");
  ASSERT_EQ(run({"two.wkt", "-q", "--side", "both", "--margin", "1", "--object-angle", "0.3", "-o", "one.json",
                 "--threads", "1", "--check"})
                .exit_code,
            0);
  ASSERT_EQ(run({"two.wkt", "-q", "--side", "both", "--margin", "1", "--object-angle", "0.3", "-o", "four.json",
                 "--threads", "4"})
                .exit_code,
            0);
  EXPECT_EQ(read_file(scratch_.path("one.json")), read_file(scratch_.path("four.json")));
  bool has_border = false;
  const nlohmann::json graph = json_of("one.json");
  for (const auto& node : graph["nodes"]) has_border = has_border || node["kind"] == "border";
  EXPECT_TRUE(has_border);
}

TEST_F(PlaneCommand, SaysWhatIsWrong) {
  write_file(scratch_.path("flat.csv"), "x,y\n0,0\n1,1\n");
  const ToolResult flat = run({"flat.csv"});
  EXPECT_EQ(flat.exit_code, 3);
  EXPECT_THAT(flat.err, HasSubstr("flat.csv"));
  EXPECT_EQ(run({"none.svg"}).exit_code, 3);
  write_file(scratch_.path("plate.csv"), kRectangle);
  EXPECT_EQ(run({"plate.csv", "-o", "no/such/folder.json"}).exit_code, 6);
  const ToolResult usage = run({"plate.csv", "-o", "a.ply"});
  EXPECT_EQ(usage.exit_code, 2);
  EXPECT_THAT(usage.err, HasSubstr("Try medial-vk plane --help."));
  EXPECT_THAT(scratch_.names(), ElementsAre("flat.csv", "plate.csv"));
  const ToolResult help = run({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.err, IsEmpty());
  EXPECT_THAT(help.out, HasSubstr("medial-vk plane [options] SHAPE"));
}

class InterruptedPlane : public PlaneCommand, public testing::WithParamInterface<int> {};

TEST_P(InterruptedPlane, NothingIsWritten) {
  std::string star = "x,y\n";
  constexpr int kPoints = 200000;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2 * std::numbers::pi * i / kPoints, radius = i % 2 == 0 ? 1 : 0.999;
    star += std::to_string(radius * std::cos(angle)) + "," + std::to_string(radius * std::sin(angle)) + "\n";
  }
  write_file(scratch_.path("star.csv"), star);
  test::Tool tool({.arguments = {"plane", "star.csv", "--check"}, .folder = scratch_.path("")});
  // The check by brute force takes minutes.
  while (tool.running() && tool.seconds_of_processor() < 1) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ASSERT_TRUE(tool.running());
  tool.send(GetParam());
  const ToolResult result = tool.wait();
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_THAT(result.err, HasSubstr("interrupted"));
  EXPECT_THAT(scratch_.names(), ElementsAre("star.csv"));
}

INSTANTIATE_TEST_SUITE_P(Signals, InterruptedPlane, testing::Values(SIGINT, SIGTERM));

}  // namespace
}  // namespace medial_vk
