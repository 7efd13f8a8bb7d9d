// `medial-vk spheres` from outside: exit codes, files, whole robots. Everything here runs without a Vulkan device.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "spheres_command.h"
#include "support/solids/mesh_files.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using nlohmann::json;
using test::read_file;
using test::SpheresCommand;
using test::ToolResult;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

TEST_F(SpheresCommand, HelpGoesToStandardOutput) {
  const ToolResult help = run({"spheres", "--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, HasSubstr("ROBOT.urdf"));
  EXPECT_THAT(help.err, IsEmpty());
  EXPECT_THAT(run({"--help"}).out, HasSubstr("medial-vk spheres"));
}

TEST_F(SpheresCommand, WritesATableOfAMesh) {
  const ToolResult result = spheres({"part.obj", "--count", "50"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, HasSubstr("no sphere reaches out"));
  EXPECT_THAT(result.err, HasSubstr("part.spheres.csv"));
  EXPECT_THAT(result.err, Not(HasSubstr("\r")));
  const std::string table = read_file(path("part.spheres.csv"));
  EXPECT_THAT(table, StartsWith("x,y,z,radius\n"));
  const auto lines = std::ranges::count(table, '\n');
  EXPECT_GT(lines, 10);
  EXPECT_LE(lines, 51);
  EXPECT_THAT(folder_.names(), ElementsAre("part.obj", "part.spheres.csv", "two.urdf"));
}

TEST_F(SpheresCommand, TheSameRunGivesTheSameBytes) {
  ASSERT_EQ(spheres({"part.obj", "--count", "50", "-q", "-o", "a.json"}).exit_code, 0);
  const ToolResult again = spheres({"part.obj", "--count", "50", "-q", "-o", "b.json", "--threads", "1"});
  EXPECT_THAT(again.err, IsEmpty());
  EXPECT_EQ(read_file(path("a.json")), read_file(path("b.json")));
}

TEST_F(SpheresCommand, LevelsAreBeginningsOfEachOther) {
  ASSERT_EQ(spheres({"part.obj", "--count", "50", "--levels"}).exit_code, 0);
  const json file = json::parse(read_file(path("part.spheres.json")));
  ASSERT_GT(file["levels"].size(), 3u);
  EXPECT_EQ(file["levels"].back()["spheres"], file["spheres"]);
  for (const json& level : file["levels"]) {
    EXPECT_EQ(level["num_spheres"], level["spheres"].size());
    for (std::size_t i = 0; i < level["spheres"].size(); ++i) EXPECT_EQ(level["spheres"][i], file["spheres"][i]);
  }
}

/// When the file is read again, its spheres represent themselves.
TEST_F(SpheresCommand, AMeshBecomesARobotOfOneLink) {
  ASSERT_EQ(best({"part.obj", "--count", "9", "-q", "-o", "part.urdf"}).exit_code, 0);
  ASSERT_EQ(best({"part.obj", "--count", "9", "-q", "-o", "part.json"}).exit_code, 0);
  const ToolResult again = best({"part.urdf", "--count-per-link", "9", "-q", "-o", "again.json"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  const json spheres = json::parse(read_file(path("part.json")))["spheres"];
  const json links = json::parse(read_file(path("again.json")))["links"];
  ASSERT_EQ(links.size(), 1u);
  EXPECT_EQ(links.begin().value().size(), spheres.size());
}

TEST_F(SpheresCommand, StreamsGoThrough) {
  test::ToolCall call{
      {"spheres", "-", "--method", "source", "--backend", "cpu", "--count", "20", "-o", "-", "--format", "json"},
      path("")};
  call.standard_input = read_file(path("part.obj"));
  const ToolResult result = test::run_tool(call);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(json::parse(result.out)["mesh"], "stdin");
}

TEST_F(SpheresCommand, ARobotOfSpheresOnlyIsItself) {
  test::write_file(path("ball.urdf"), R"(<robot name="ball"><link name="a"><collision><geometry><sphere radius="0.5"/>
    </geometry></collision></link></robot>)");
  const ToolResult result =
      run({"spheres", "ball.urdf", "--backend", "cpu", "--total", "9", "--contract", "cover", "--report", "r.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("1 sphere, each of which is the geometry itself"));
  EXPECT_EQ(report()["parts"][0]["volume_of"], "shape");
}

TEST_F(SpheresCommand, ARobotGetsSpheresForCollision) {
  const ToolResult result = spheres(robot_arguments("--count-per-link", "20"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("2 links with 3 geometries"));
  const std::string urdf = read_file(path("two.spheres.urdf"));
  EXPECT_THAT(urdf, HasSubstr("<sphere radius=\"0.5\"/>"));
  EXPECT_THAT(urdf, HasSubstr("<origin xyz=\"0 0 3\" rpy=\"0 0 0\"/>"));
  EXPECT_THAT(urdf, HasSubstr("<joint name=\"j\" type=\"fixed\">"));
  EXPECT_THAT(urdf, Not(HasSubstr("package://")));  // it was collision geometry
  // The written file is again a robot, of balls only.
  std::vector<std::string> again = {"two.spheres.urdf", "--total", "1000", "-o", "again.json"};
  ASSERT_EQ(spheres(again).exit_code, 0);
  const json links = json::parse(read_file(path("again.json")))["links"];
  EXPECT_LE(links["a"].size(), 20u);
  EXPECT_LE(links["b"].size(), 20u);
  EXPECT_GT(links["b"].size(), 5u);
  EXPECT_EQ(links["a"].back()["radius"], 0.5);
}

TEST_F(SpheresCommand, ATotalIsSharedOutByNeed) {
  const ToolResult result =
      run({"spheres", "two.urdf", "--package", "here=" + path(""), "--total", "60", "--method", "source", "--backend",
           "cpu", "-q", "-o", "-", "--format", "json", "--report", "report.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json report = json::parse(read_file(path("report.json")));
  std::vector<int> wanted;
  for (const json& part : report["parts"]) wanted.push_back(part["wanted"]);
  ASSERT_EQ(wanted.size(), 3u);
  EXPECT_EQ(wanted[0] + wanted[1] + wanted[2], 60);
  EXPECT_EQ(wanted[1], 1);          // a ball
  EXPECT_GT(wanted[0], wanted[2]);  // the same shape at half the size
  EXPECT_LE(report["num_spheres"], 60);
  EXPECT_EQ(report["contract"], "inside");
  EXPECT_GT(report["volume_error"], 0);
}

TEST_F(SpheresCommand, ReportAndPicture) {
  std::vector<std::string> arguments = robot_arguments("--count-per-link", "10");
  for (const char* word : {"--report", "r.json", "--picture", "p.png", "--up", "z", "-v", "--format", "foam"}) {
    arguments.emplace_back(word);
  }
  const ToolResult result = spheres(arguments);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("here/part.obj"));
  EXPECT_THAT(read_file(path("p.png")), StartsWith("\x89PNG"));
  const json foam = json::parse(read_file(path("two.spheres.foam.json")));
  EXPECT_TRUE(foam.contains("a::part.obj"));
  EXPECT_TRUE(foam.contains("a::primitive1"));
  EXPECT_TRUE(foam["b::here/part.obj"]["10"].contains("1"));
  EXPECT_EQ(json::parse(read_file(path("r.json")))["goals"]["count_per_link"], 10);
}

TEST_F(SpheresCommand, WrongUsageIs2) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{},
                                                    {"part.obj"},
                                                    {"part.obj", "--count", "-1"},
                                                    {"two.urdf", "--count", "5"},
                                                    {"two.urdf", "--total", "5", "--package", "here"},
                                                    {"part.obj", "--count", "5", "--max-gap", "0.1"},
                                                    {"part.obj", "--count", "5", "--contract", "some"}}) {
    const ToolResult result = spheres(arguments);
    EXPECT_EQ(result.exit_code, 2) << testing::PrintToString(arguments) << result.err;
    EXPECT_THAT(result.err, HasSubstr("medial-vk: "));
    EXPECT_THAT(result.err, HasSubstr("Try medial-vk spheres --help."));
  }
  EXPECT_THAT(spheres(robot_arguments("--total", "2")).err,
              HasSubstr("3 parts need a ball each; raise --total from 2"));
  EXPECT_THAT(spheres(robot_arguments("--count-per-link", "1")).err,
              HasSubstr("link \"a\" has 2 parts, which need a ball each; raise --count-per-link from 1"));
  EXPECT_THAT(folder_.names(), ElementsAre("part.obj", "two.urdf"));
}

TEST_F(SpheresCommand, ARobotsOwnMeshesAreNotOverwritten) {
  const std::string before = read_file(path("part.obj"));
  const ToolResult result =
      spheres({"two.urdf", "--package", "here=" + path(""), "--total", "6", "--format", "csv", "-o", "part.obj"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("--output would overwrite the input"));
  EXPECT_EQ(read_file(path("part.obj")), before);
}

/// A box without one of its faces.
std::string open_box() {
  Mesh open = test::make_box({1, 1, 1});
  open.triangles.resize(open.triangles.size() - 2);
  return test::to_obj(open);
}

TEST_F(SpheresCommand, TheErrorOfAnOpenMeshIsAnInterval) {
  test::write_file(path("open.obj"), open_box());
  const ToolResult result = run({"spheres", "open.obj", "--count", "3", "--report", "r.json", "--backend", "cpu"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, testing::ContainsRegex(
                              "error +[0-9.]+ to [0-9.]+ % of the volume is left uncovered; measured at random"));
  const json report = json::parse(read_file(path("r.json")));
  EXPECT_TRUE(report["volume_error"].is_null());
  const json& part = report["parts"][0];
  for (const json& interval : {report["volume_error_interval"], part["volume_error_interval"]}) {
    EXPECT_LT(interval[0], interval[1]);
    EXPECT_GT(interval[0], 0);
    EXPECT_LT(interval[1], 1);
  }
  const double error =
      part["measures"]["volume"]["uncovered"].get<double>() / part["measures"]["volume"]["solid"].get<double>();
  EXPECT_LE(part["volume_error_interval"][0], error);
  EXPECT_GE(part["volume_error_interval"][1], error);
}

TEST_F(SpheresCommand, AnErrorNeedsAVolume) {
  test::write_file(path("open.obj"), open_box());
  for (const char* method : {"best", "source"}) {
    const ToolResult result = run({"spheres", "open.obj", "--error", "0.1", "--method", method, "--backend", "cpu"});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr("--error is a share of the volume, which this mesh does not enclose cleanly"));
  }
}

TEST_F(SpheresCommand, AGapThatIsNotReachedIsNamed) {
  const ToolResult result = best({"part.obj", "--count", "3", "--max-gap", "0.01"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, testing::ContainsRegex("3 balls leave a gap of 0\\.[0-9]+; raise --count or --max-gap"));
  EXPECT_THAT(best({"part.obj", "--max-gap", "1e-16"}).err, HasSubstr("below the rounding of distances"));
}

TEST_F(SpheresCommand, UnreadableRobotsAre3AndSayWhy) {
  const auto fails_with = [&](const std::string& robot, const std::string& message) {
    test::write_file(path("bad.urdf"), robot);
    const ToolResult result = spheres({"bad.urdf", "--total", "9"});
    EXPECT_EQ(result.exit_code, 3) << result.err;
    EXPECT_THAT(result.err, HasSubstr(message));
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
  };
  const auto with = [](const std::string& geometry) {
    return "<robot name='r'><link name='a'><collision><geometry>" + geometry + "</geometry></collision></link></robot>";
  };
  fails_with("", "medial-vk: bad.urdf: the file is empty");
  fails_with("no xml", "no well-formed XML");
  fails_with("<robot><link/></robot>", "bad.urdf:1: a <link> has no name");
  fails_with(with("<cone/>"), "the geometry \"cone\" is unknown");
  fails_with(with("<mesh filename='none.stl'/>"), "none.stl\" is not there");
  fails_with(with("<mesh filename='bad.urdf'/>"), "link \"a\": ");
  fails_with(with("<mesh filename='part.obj' scale='nan nan nan'/>"), "scale of <mesh>");
  fails_with(with("<mesh filename='package://gone/a.stl'/>"), "--package gone=FOLDER");
  fails_with("<robot><link name='a'/></robot>", "no link has a <collision>; try --visual");
  EXPECT_EQ(spheres({"missing.urdf", "--total", "9"}).exit_code, 3);
  EXPECT_EQ(spheres({"missing.obj", "--count", "9"}).exit_code, 3);
}

TEST_F(SpheresCommand, CannotWriteIs6) {
  EXPECT_EQ(spheres({"part.obj", "--count", "9", "-o", "no/such/folder/a.csv"}).exit_code, 6);
  EXPECT_THAT(folder_.names(), ElementsAre("part.obj", "two.urdf"));
}

TEST_F(SpheresCommand, AnInterruptedRunWritesNothing) {
  test::Tool tool(call({"spheres", "part.obj", "--method", "source", "--backend", "cpu", "--resolution", "2000"}));
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  ASSERT_TRUE(tool.running());
  tool.send(SIGINT);
  const ToolResult result = tool.wait();
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_THAT(result.err, HasSubstr("medial-vk: interrupted; nothing was written\n"));
  EXPECT_THAT(folder_.names(), ElementsAre("part.obj", "two.urdf"));
}

TEST_F(SpheresCommand, VisualGeometryIsUsedOnRequest) {
  ASSERT_EQ(spheres({"two.urdf", "--count-per-link", "20", "--visual", "-o", "v.json"}).exit_code, 0);
  const json links = json::parse(read_file(path("v.json")))["links"];
  EXPECT_EQ(links.size(), 1u);
  EXPECT_TRUE(links.contains("b"));
}

}  // namespace
}  // namespace medial_vk
