// `medial-vk fit` from outside: exit codes, streams, files. Everything here runs without a Vulkan device.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "cli/tool_test.h"
#include "support/hulls/usd_text.h"
#include "support/solids/mesh_files.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using nlohmann::json;
using test::read_file;
using test::ToolResult;
using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

class FitCommand : public test::ToolTest {
 protected:
  FitCommand() {
    Mesh mesh = test::make_l_shape(2.0, 0.6, 0.3);
    test::rotate(mesh, {1, 2, 3}, 0.4);
    test::write_file(path("part.obj"), test::to_obj(mesh));
  }

  /// Four hulls from few medial points, on the CPU.
  ToolResult fit(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"fit", "--backend", "cpu", "--resolution", "12"});
    return run(std::move(arguments));
  }
  json json_of(const std::string& file) const { return json::parse(read_file(path(file))); }
};

TEST_F(FitCommand, HelpGoesToStandardOutput) {
  const ToolResult help = run({"fit", "--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, StartsWith("medial-vk fit puts capsules"));
  EXPECT_THAT(help.err, IsEmpty());
  EXPECT_EQ(run({"spheres", "--primitives", "slabs", "--help"}).out, help.out);
  EXPECT_THAT(run({"--help"}).out, HasSubstr("medial-vk fit "));
}

TEST_F(FitCommand, WritesSlabsAndTellsOfThem) {
  const ToolResult result = fit({"part.obj", "--count", "4", "--check", "--report", "r.json", "-v"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("random balls of each hull: radius <= exact distance"));
  EXPECT_THAT(result.err, ContainsRegex("hulls +[1-4] slabs? with [0-9]+ numbers"));
  EXPECT_THAT(result.err, ContainsRegex("proved +[1-4] hulls? inside, by [0-9,]+ planes"));
  EXPECT_THAT(result.err, ContainsRegex("error +[0-9.]+ to [0-9.]+ % of the volume is left uncovered"));
  EXPECT_THAT(result.err, ContainsRegex("gap +[0-9.]+ to [0-9.]+ is the greatest distance"));
  EXPECT_THAT(result.err, HasSubstr("part.hulls.json"));
  EXPECT_THAT(result.err, Not(HasSubstr("\r")));
  EXPECT_THAT(folder_.names(), ElementsAre("part.hulls.json", "part.obj", "r.json"));
  const json file = json_of("part.hulls.json"), report = json_of("r.json");
  ASSERT_GE(file["hulls"].size(), 1u);
  ASSERT_LE(file["hulls"].size(), 4u);
  for (const json& hull : file["hulls"]) EXPECT_EQ(hull["balls"].size(), 3u);
  EXPECT_EQ(file["mesh"], "part");
  EXPECT_EQ(report["program"], "medial-vk fit");
  EXPECT_EQ(report["num_hulls"], file["num_hulls"]);
  EXPECT_EQ(report["hulls"]["slabs"], file["num_hulls"]);
  EXPECT_EQ(report["num_parameters"], 12 * file["num_hulls"].get<int>());
  EXPECT_EQ(report["goals"]["count"], 4);
  EXPECT_TRUE(report["goals"]["error"].is_null());
  EXPECT_EQ(report["hulls_volume"], file["hulls_volume"]);
  EXPECT_EQ(report["check"], "passed");
  EXPECT_EQ(report["backend"], "cpu");
  EXPECT_EQ(report["proof"]["failed"], 0);
  const double lower = report["uncovered_share"][0], upper = report["uncovered_share"][1];
  EXPECT_LE(lower, upper);
  EXPECT_LE(upper - lower, 1e-3 * (1 + 1e-9));  // the usual width
  EXPECT_LT(upper, 0.5);
}

TEST_F(FitCommand, SpheresWithPrimitivesIsTheSame) {
  ASSERT_EQ(fit({"part.obj", "--primitives", "capsules", "--count", "3", "-q", "-o", "a.json"}).exit_code, 0);
  const ToolResult same = run({"spheres", "part.obj", "--primitives", "capsules", "--count", "3", "-q", "-o", "b.json",
                               "--backend", "cpu", "--resolution", "12", "--threads", "1"});
  EXPECT_EQ(same.exit_code, 0) << same.err;
  EXPECT_THAT(same.err, IsEmpty());
  EXPECT_EQ(read_file(path("a.json")), read_file(path("b.json")));
  const ToolResult wrong = run({"spheres", "part.obj", "--primitives", "capsules"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("Try medial-vk fit --help."));
}

TEST_F(FitCommand, EveryFormatHoldsTheHulls) {
  for (const char* file : {"h.json", "h.csv", "h.ma", "h.usda", "h.glb", "h.gltf", "h.obj"}) {
    const ToolResult result = fit({"part.obj", "--primitives", "cones", "--count", "3", "-q", "-o", file});
    ASSERT_EQ(result.exit_code, 0) << file << result.err;
  }
  const std::size_t hulls = json_of("h.json")["hulls"].size();
  const std::string table = read_file(path("h.csv"));
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(table, '\n')), hulls + 1);
  EXPECT_THAT(read_file(path("h.ma")), StartsWith(std::to_string(2 * hulls) + " " + std::to_string(hulls) + " 0\nv "));
  const test::UsdLayer layer = test::parse_usd(read_file(path("h.usda")));
  EXPECT_EQ(layer.prims.at(0).children.size(), hulls);
  EXPECT_THAT(read_file(path("h.glb")), StartsWith("glTF"));
  EXPECT_EQ(json_of("h.gltf")["extensions"]["KHR_implicit_shapes"]["shapes"].size(), hulls);
  EXPECT_THAT(read_file(path("h.obj")), HasSubstr("\no cone_00\n"));
}

TEST_F(FitCommand, APictureShowsThem) {
  const ToolResult result = fit({"part.obj", "--count", "2", "-q", "-o", "h.csv", "--picture", "p.png", "--size",
                                 "120x90", "--view", "1,1,2", "--up", "z"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(read_file(path("p.png")), StartsWith("\x89PNG"));
}

TEST_F(FitCommand, StreamsGoThrough) {
  test::ToolCall call{{"fit", "-", "--count", "2", "-o", "-", "--check", "--backend", "cpu", "--resolution", "12"},
                      path("")};
  call.standard_input = read_file(path("part.obj"));
  const ToolResult result = test::run_tool(call);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(json::parse(result.out)["mesh"], "stdin");
  EXPECT_THAT(result.err, HasSubstr("random balls of each hull"));  // the table goes where no file is
}

TEST_F(FitCommand, GoalsAreMet) {
  const ToolResult parameters = fit({"part.obj", "--primitives", "mix", "--parameters", "36", "-q", "-o", "p.json"});
  ASSERT_EQ(parameters.exit_code, 0) << parameters.err;
  EXPECT_LE(json_of("p.json")["num_parameters"], 36);
  const ToolResult error = fit({"part.obj", "--error", "0.3", "-q", "-o", "e.json"});
  ASSERT_EQ(error.exit_code, 0) << error.err;
  EXPECT_LE(json_of("e.json")["uncovered_share"][1], 0.3);
  const ToolResult unmet = fit({"part.obj", "--count", "1", "--error", "0.001"});
  EXPECT_EQ(unmet.exit_code, 2) << unmet.err;
  EXPECT_THAT(unmet.err, Not(HasSubstr("`")));
}

TEST_F(FitCommand, WrongUsageIs2) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{},
                                                    {"part.obj"},
                                                    {"part.obj", "--count", "0"},
                                                    {"part.obj", "--count", "4", "-o", "part.obj"},
                                                    {"part.obj", "--count", "4", "-o", "h.ply"},
                                                    {"part.obj", "--count", "4", "--contract", "cover"},
                                                    {"two.urdf", "--count", "4"}}) {
    const ToolResult result = fit(arguments);
    EXPECT_EQ(result.exit_code, 2) << testing::PrintToString(arguments) << result.err;
    EXPECT_THAT(result.err, HasSubstr("Try medial-vk fit --help."));
  }
  EXPECT_THAT(folder_.names(), ElementsAre("part.obj"));
}

TEST_F(FitCommand, WhatCannotBeReadOrWrittenHasACodeOfItsOwn) {
  EXPECT_EQ(fit({"missing.obj", "--count", "4"}).exit_code, 3);
  test::write_file(path("bad.obj"), "no mesh\n");
  EXPECT_EQ(fit({"bad.obj", "--count", "4"}).exit_code, 3);
  EXPECT_EQ(fit({"part.obj", "--count", "4", "-o", "no/such/folder/a.csv"}).exit_code, 6);
  EXPECT_THAT(folder_.names(), ElementsAre("bad.obj", "part.obj"));
}

TEST_F(FitCommand, AnInterruptedRunWritesNothing) {
  test::Tool tool(call({"fit", "part.obj", "--count", "64", "--backend", "cpu", "--resolution", "2000"}));
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  ASSERT_TRUE(tool.running());
  tool.send(SIGINT);
  const ToolResult result = tool.wait();
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_THAT(result.err, HasSubstr("medial-vk: interrupted; nothing was written\n"));
  EXPECT_THAT(folder_.names(), ElementsAre("part.obj"));
}

}  // namespace
}  // namespace medial_vk
