// The command line from outside: exit codes, streams, files. Everything here runs without a Vulkan device.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "output/medial_ply/medial_file.h"
#include "support/solids/mesh_files.h"
#include "support/solids/solids.h"
#include "tool_test.h"

namespace medial_vk {
namespace {

using test::read_file;
using test::run_tool;
using test::ToolCall;
using test::ToolResult;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

std::string small_part() {
  Mesh mesh = test::make_l_shape(2.0, 0.6, 0.8);
  test::rotate(mesh, {1, 2, 3}, 0.4);
  return test::to_obj(mesh);
}

class CommandLine : public test::ToolTest {
 protected:
  CommandLine() { test::write_file(path("part.obj"), small_part()); }

  MedialFile points(const std::string& name) const {
    Result<MedialFile> file = decode_ply(read_file(path(name)), name);
    EXPECT_TRUE(file.ok()) << (file.ok() ? "" : file.error().message);
    return file.ok() ? std::move(file).value() : MedialFile{};
  }
};

TEST_F(CommandLine, HelpAndVersionGoToStandardOutput) {
  const ToolResult help = run({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, HasSubstr("Usage:"));
  EXPECT_THAT(help.err, IsEmpty());
  const ToolResult version = run({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_THAT(version.out, StartsWith("medial-vk "));
}

TEST_F(CommandLine, WrongUsageIs2) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{},
                                                    {"part.obj", "--bogus"},
                                                    {"part.obj", "--resolution", "0"},
                                                    {"part.obj", "-o", "part.xyz"},
                                                    {"part.obj", "other.obj"}}) {
    const ToolResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << testing::PrintToString(arguments);
    EXPECT_THAT(result.err, StartsWith("medial-vk: "));
    EXPECT_THAT(result.out, IsEmpty());
  }
  EXPECT_THAT(folder_.names(), ElementsAre("part.obj"));
}

TEST_F(CommandLine, UnreadableOrInvalidMeshIs3) {
  test::write_file(path("garbage.obj"), "v 1 2\nf 1 2 3\n");
  test::write_file(path("empty.stl"), "");
  test::write_file(path("sheet.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  for (const char* mesh : {"missing.obj", "garbage.obj", "empty.stl", "sheet.obj"}) {
    const ToolResult result = run_cpu({mesh});
    EXPECT_EQ(result.exit_code, 3) << mesh << ": " << result.err;
    EXPECT_THAT(result.err, HasSubstr(mesh));
  }
  EXPECT_EQ(run_cpu({"sheet.obj"}).err.find("medial-vk: sheet.obj: the mesh encloses nothing: with 3 open edges"), 0u);
  EXPECT_THAT(folder_.names(), ElementsAre("empty.stl", "garbage.obj", "part.obj", "sheet.obj"));
}

TEST_F(CommandLine, NoDeviceIs4AndSaysWhatToDo) {
  ToolCall call = {{"part.obj"}, path("")};
  for (const char* name : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"}) call.environment[name] = "/nowhere/none.json";
  const ToolResult result = run_tool(call);
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_THAT(result.err, HasSubstr("mesa-vulkan-drivers"));
  EXPECT_THAT(result.err, HasSubstr("--backend cpu"));
  call.arguments = {"--list-devices"};
  EXPECT_EQ(run_tool(call).exit_code, 4);
  EXPECT_EQ(run({"part.obj", "--device", "no device has this name"}).exit_code, 4);
  EXPECT_THAT(folder_.names(), ElementsAre("part.obj"));
}

TEST_F(CommandLine, OutOfMemoryIs5) {
#if defined(MEDIAL_VK_SANITIZED)
  GTEST_SKIP() << "AddressSanitizer needs all of the address space";
#endif
  ToolCall call = {{"-", "--backend", "cpu"}, path("")};
  for (int i = 0; i < 2'000'000; ++i) call.standard_input += "v 1 2 3\n";
  call.address_space = 40ull << 20;
  const ToolResult result = run_tool(call);
  EXPECT_EQ(result.exit_code, 5) << result.err;
  EXPECT_THAT(result.err, HasSubstr("memory"));
}

TEST_F(CommandLine, CannotWriteIs6AndLeavesNothing) {
  EXPECT_EQ(run_cpu({"part.obj", "-o", "no/such/folder/a.ply"}).exit_code, 6);
  EXPECT_EQ(run_cpu({"part.obj", "--report", "no/such/folder/a.json"}).exit_code, 6);
  EXPECT_THAT(folder_.names(), ElementsAre("part.obj"));
}

TEST_F(CommandLine, AFullDiskIs6AndKeepsTheOldFile) {
  test::write_file(path("part.medial.ply"), "old");
  const ToolResult result = run_cpu({"part.obj", "--report", "/dev/full"});
  EXPECT_EQ(result.exit_code, 6) << result.err;
  EXPECT_EQ(read_file(path("part.medial.ply")), "old");
  EXPECT_THAT(folder_.names(), ElementsAre("part.medial.ply", "part.obj"));
}

TEST_F(CommandLine, WritesThePointsUnderTheirDefaultName) {
  const ToolResult result = run_cpu({"part.obj"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, HasSubstr("part.medial.ply"));
  EXPECT_THAT(result.err, Not(HasSubstr("\r")));  // No progress bar where there is no terminal.
  EXPECT_THAT(folder_.names(), ElementsAre("part.medial.ply", "part.obj"));
  EXPECT_GT(points("part.medial.ply").spheres.size(), 20u);
}

TEST_F(CommandLine, QuietSaysNothing) {
  const ToolResult result = run_cpu({"part.obj", "-q"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, IsEmpty());
}

TEST_F(CommandLine, SameInputSameBytesInEveryForm) {
  ASSERT_EQ(run_cpu({"part.obj", "-o", "a.ply"}).exit_code, 0);
  ASSERT_EQ(run_cpu({"part.obj", "-o", "b.ply"}).exit_code, 0);
  EXPECT_TRUE(read_file(path("a.ply")) == read_file(path("b.ply")));

  const ToolResult streamed =
      run_tool({{"-", "-o", "-", "--backend", "cpu", "--resolution", "6"}, path(""), small_part()});
  EXPECT_EQ(streamed.exit_code, 0) << streamed.err;
  EXPECT_TRUE(streamed.out == read_file(path("a.ply")));

  ASSERT_EQ(run_cpu({"part.obj", "-o", "text.ply", "--ascii"}).exit_code, 0);
  const MedialFile binary = points("a.ply");
  const MedialFile text = points("text.ply");
  EXPECT_TRUE(encode_ply(text.header, text.spheres, false) == encode_ply(binary.header, binary.spheres, false));

  ASSERT_EQ(run_cpu({"part.obj", "-o", "table.csv"}).exit_code, 0);
  EXPECT_TRUE(read_file(path("table.csv")) == encode_csv(binary.header, binary.spheres));
}

TEST_F(CommandLine, StandardInputHasItsOwnDefaultName) {
  const ToolResult result = run_tool({{"-", "--backend", "cpu", "--resolution", "6"}, path(""), small_part()});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(folder_.names(), ElementsAre("part.obj", "stdin.medial.ply"));
}

TEST_F(CommandLine, CheckPassesAndPrintsItsTable) {
  const ToolResult result = run_cpu({"part.obj", "--check", "--report", "r.json"});
  EXPECT_EQ(result.exit_code, 0) << result.err << result.out;
  EXPECT_THAT(result.out, StartsWith("condition"));
  const nlohmann::json report = nlohmann::json::parse(read_file(path("r.json")));
  EXPECT_EQ(report["certificate"]["passed"], true);
  EXPECT_EQ(report["points"]["written"], points("part.medial.ply").spheres.size());
}

TEST_F(CommandLine, ReportAndPicture) {
  const ToolResult result = run_cpu({"part.obj", "--report", "-", "--picture", "p.png"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(nlohmann::json::parse(result.out)["parameters"]["resolution"], 6);
  EXPECT_THAT(read_file(path("p.png")), StartsWith("\x89PNG"));
}

TEST_F(CommandLine, PictureAsRequested) {
  const ToolResult result = run_cpu({"part.obj", "--picture", "p.png", "--view", "-1,1,0.5", "--size", "96x64",
                                     "--show", "both", "--colour", "sheet", "-v"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("drawn by the CPU"));
  EXPECT_EQ(read_file(path("p.png")).substr(16, 8), std::string("\0\0\0\x60\0\0\0\x40", 8));
}

TEST_F(CommandLine, SheetsAreInPointsAndReport) {
  ASSERT_EQ(run_cpu({"part.obj", "--report", "r.json", "--medial-mesh", "m.ma"}).exit_code, 0);
  const nlohmann::json report = nlohmann::json::parse(read_file(path("r.json")));
  std::vector<std::uint64_t> counts(report["sheets"].size(), 0);
  for (const MedialSphere& sphere : points("part.medial.ply").spheres) {
    ++counts.at(static_cast<std::size_t>(sphere.sheet));
  }
  ASSERT_GT(counts.size(), 1u);
  for (std::size_t i = 0; i < counts.size(); ++i) EXPECT_EQ(report["sheets"][i]["points"], counts[i]);
  EXPECT_EQ(report["medial_mesh"]["components"], 1);
  EXPECT_THAT(read_file(path("m.ma")), StartsWith(std::to_string(report["points"]["written"].get<int>()) + " "));

  // All options together.
  ASSERT_EQ(run_cpu({"part.obj", "-o", "one.ply", "--sheet-crease", "180"}).exit_code, 0);
  for (const MedialSphere& sphere : points("one.ply").spheres) EXPECT_EQ(sphere.sheet, 0);
}

TEST_F(CommandLine, VolumesOfBallsAndSheets) {
  ASSERT_EQ(run({"part.obj", "--backend", "cpu", "--resolution", "12", "--report", "r.json", "--ball-volumes", "b.csv",
                 "--sheet-curve", "c.svg"})
                .exit_code,
            0);
  const nlohmann::json report = nlohmann::json::parse(read_file(path("r.json")));
  double sum = 0;
  for (const auto& sheet : report["sheets"]) sum += sheet["significance"].get<double>();
  EXPECT_NEAR(sum, 1, 1e-12);
  // Balls inside: less than the solid.
  EXPECT_LT(report["union"]["volume"], report["mesh"]["signed_volume"]);
  EXPECT_GT(report["union"]["volume"], 0.5 * report["mesh"]["signed_volume"].get<double>());
  const std::string table = read_file(path("b.csv"));
  EXPECT_THAT(table, StartsWith("point,sheet,volume,area,significance\n0,"));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), report["points"]["written"].get<int>() + 1);
  EXPECT_THAT(read_file(path("c.svg")), StartsWith("<svg "));
}

TEST_F(CommandLine, ReportSaysForWhichVoxelsTheSolidIsFat) {
  const ToolResult result = run_cpu({"part.obj", "--report", "r.json", "--object-angle", "0.7"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json report = nlohmann::json::parse(read_file(path("r.json")));
  const nlohmann::json& angles = report["fatness"]["angles"];
  std::vector<double> values;
  for (const auto& of_angle : angles) values.push_back(of_angle["object_angle"].get<double>());
  EXPECT_THAT(values, ElementsAre(0.7, 0.8, 1, 1.2, 1.4));
  EXPECT_EQ(angles[0]["points"], report["points"]["written"]);
  EXPECT_EQ(angles[0]["least_radius"], report["points"]["radius"]["least"]);
  for (std::size_t i = 1; i < values.size(); ++i) EXPECT_LE(angles[i]["points"], angles[i - 1]["points"]);
  EXPECT_THAT(result.err, testing::ContainsRegex("fat +voxels up to [^ ]+ at object angles from 0.7 rad"));
}

TEST_F(CommandLine, KeepsTheSheetsThatCount) {
  const ToolResult result = run_cpu({"part.obj", "--report", "r.json", "--keep-volume", "0.7", "--keep-topology",
                                     "--sheet-curve", "c.csv", "--check"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json report = nlohmann::json::parse(read_file(path("r.json")));
  const nlohmann::json& removal = report["removal"];
  ASSERT_FALSE(removal["removed"].empty());
  EXPECT_GE(removal["volume_left"].back(), 0.7);
  std::set<std::int32_t> kept, written;
  for (const auto& sheet : removal["kept"]) kept.insert(sheet.get<std::int32_t>());
  const auto& spheres = points("part.medial.ply").spheres;
  for (const MedialSphere& sphere : spheres) written.insert(sphere.sheet);
  EXPECT_EQ(written, kept);
  EXPECT_EQ(report["points"]["written"], spheres.size());
  EXPECT_THAT(read_file(path("c.csv")), HasSubstr("\ntopology,"));
  const auto& removed = removal["removed"];
  const auto& order = report["orders"]["topology"]["removed"];
  ASSERT_LE(removed.size(), order.size());
  EXPECT_TRUE(std::equal(removed.begin(), removed.end(), order.begin()));
  EXPECT_EQ(report["orders"]["significance"]["removed"].size() + 1, report["sheets"].size());
  EXPECT_THAT(result.err, HasSubstr("kept"));
}

TEST_F(CommandLine, KeepsTheSameSheetsWhateverElseIsWritten) {
  ASSERT_EQ(run_cpu({"part.obj", "--keep-volume", "0.7", "-o", "alone.ply"}).exit_code, 0);
  ASSERT_EQ(run_cpu({"part.obj", "--keep-volume", "0.7", "-o", "reported.ply", "--report", "r.json"}).exit_code, 0);
  EXPECT_TRUE(read_file(path("alone.ply")) == read_file(path("reported.ply")));
}

TEST_F(CommandLine, PerturbIsSeededAndSimplifyOnlyRemoves) {
  ASSERT_EQ(run_cpu({"part.obj", "-o", "plain.ply"}).exit_code, 0);
  for (const char* name : {"a.ply", "b.ply"}) {
    ASSERT_EQ(run_cpu({"part.obj", "-o", name, "--perturb", "1e-4", "--seed", "7"}).exit_code, 0);
  }
  ASSERT_EQ(run_cpu({"part.obj", "-o", "c.ply", "--perturb", "1e-4", "--seed", "8"}).exit_code, 0);
  EXPECT_TRUE(read_file(path("a.ply")) == read_file(path("b.ply")));
  EXPECT_FALSE(read_file(path("a.ply")) == read_file(path("c.ply")));
  EXPECT_FALSE(read_file(path("a.ply")) == read_file(path("plain.ply")));

  ASSERT_EQ(run_cpu({"part.obj", "-o", "thin.ply", "--simplify", "--epsilon", "0.5"}).exit_code, 0);
  ASSERT_EQ(run_cpu({"part.obj", "-o", "thick.ply", "--epsilon", "0.5"}).exit_code, 0);
  EXPECT_LT(points("thin.ply").spheres.size(), points("thick.ply").spheres.size());
}

TEST_F(CommandLine, ThesisModeRuns) {
  const ToolResult result = run_cpu({"part.obj", "--mode", "thesis", "--check"});
  EXPECT_EQ(result.exit_code, 0) << result.err << result.out;
}

class Interrupted : public CommandLine, public testing::WithParamInterface<int> {};

TEST_P(Interrupted, StopsWith130AndLeavesNothing) {
  // Far more work than can be done before the signal comes.
  Mesh torus = test::make_torus(1.0, 0.4, 48, 96);
  test::write_file(path("torus.obj"), test::to_obj(torus));
  test::Tool tool({{"torus.obj", "--backend", "cpu", "--resolution", "512", "--report", "r.json"}, path("")});
  std::this_thread::sleep_for(std::chrono::seconds(2));
  ASSERT_TRUE(tool.running());
  tool.send(GetParam());
  const ToolResult result = tool.wait();
  EXPECT_EQ(result.exit_code, 130) << result.err;
  EXPECT_THAT(result.err, HasSubstr("interrupted"));
  EXPECT_THAT(folder_.names(), ElementsAre("part.obj", "torus.obj"));
}

/// Sends the signal after a second; the tool ends with 130 without continuing its work.
void expect_end_at_once(test::Tool& tool, int signal) {
  std::this_thread::sleep_for(std::chrono::seconds(1));
  ASSERT_TRUE(tool.running());
  const auto sent = std::chrono::steady_clock::now();
  tool.send(signal);
  // 200 ms on an otherwise idle machine.
  while (tool.running() && std::chrono::steady_clock::now() - sent < std::chrono::seconds(2))
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  ASSERT_FALSE(tool.running());
  const ToolResult result = tool.wait();
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_THAT(result.err, testing::EndsWith("medial-vk: interrupted; nothing was written\n"));
}

// A read, or the opening of a pipe, that would never end.
TEST_P(Interrupted, EndsAtOnceWhileItWaitsForInput) {
  ASSERT_EQ(::mkfifo(path("pipe.obj").c_str(), 0600), 0);
  for (const char* input : {"-", "pipe.obj"}) {
    SCOPED_TRACE(input);
    test::Tool tool({.arguments = {input, "-o", "p.ply", "--report", "r.json"},
                     .folder = path(""),
                     .standard_input = small_part(),
                     .endless_input = true});
    expect_end_at_once(tool, GetParam());
    EXPECT_THAT(folder_.names(), ElementsAre("part.obj", "pipe.obj"));
  }
}

// The points are found soon, the picture takes seconds.
TEST_P(Interrupted, EndsAtOnceWhileItDraws) {
  test::Tool tool(cpu_call({"part.obj", "--picture", "p.png", "--size", "2500"}));
  expect_end_at_once(tool, GetParam());
  EXPECT_THAT(folder_.names(), ElementsAre("part.obj"));
}

/// The thickness of half a million vertices takes minutes.
TEST_P(Interrupted, EndsAtOnceWhileItMeasuresTheBoundary) {
  test::Tool tool(cpu_call({"part.obj", "--thickness", "--boundary", "b.ply", "--boundary-edge", "0.003"}));
  expect_end_at_once(tool, GetParam());
  EXPECT_THAT(folder_.names(), ElementsAre("part.obj"));
}

INSTANTIATE_TEST_SUITE_P(, Interrupted, testing::Values(SIGINT, SIGTERM));

}  // namespace
}  // namespace medial_vk
