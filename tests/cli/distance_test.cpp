// `medial-vk distance` from outside: exit codes, streams, files. Everything here runs without a Vulkan device.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "support/solids/mesh_files.h"
#include "support/solids/solids.h"
#include "tool_test.h"

namespace medial_vk {
namespace {

using test::read_file;
using test::ToolCall;
using test::ToolResult;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

constexpr const char* kDistanceColumns = "lower,upper,state,ax,ay,az,bx,by,bz\n";
constexpr const char* kCheckColumns = "condition ";

struct DistanceLine {
  double lower = 0, upper = 0;
  std::string state;
  Point on_a = {}, on_b = {};
};

/// The lines of a table after that of the names.
std::vector<DistanceLine> lines_of(const std::string& table) {
  EXPECT_THAT(table, StartsWith(kDistanceColumns));
  std::vector<DistanceLine> lines;
  std::istringstream text(table);
  std::string line;
  std::getline(text, line);
  while (std::getline(text, line)) {
    std::istringstream in(line);
    std::vector<std::string> words;
    for (std::string word; std::getline(in, word, ',');) words.push_back(word);
    EXPECT_EQ(words.size(), 9u) << line;
    if (words.size() != 9) continue;
    const auto number = [&](std::size_t i) { return std::stod(words[i]); };
    lines.push_back(
        {number(0), number(1), words[2], {number(3), number(4), number(5)}, {number(6), number(7), number(8)}});
  }
  return lines;
}

std::vector<std::string> states_of(const std::string& table) {
  std::vector<std::string> states;
  for (const DistanceLine& line : lines_of(table)) states.push_back(line.state);
  return states;
}

/// A unit box, one that is half a unit to the right of it, and a small one inside it.
class DistanceCommand : public test::ToolTest {
 protected:
  DistanceCommand() {
    Mesh box = test::make_box({1, 1, 1}), apart = box, inner = test::make_box({0.2, 0.2, 0.2});
    test::translate(apart, {1.5, 0.25, 0});
    test::translate(inner, {0.3, 0.4, 0.4});
    test::write_file(path("box.obj"), test::to_obj(box));
    test::write_file(path("apart.obj"), test::to_obj(apart));
    test::write_file(path("inner.obj"), test::to_obj(inner));
    test::write_file(path("poses.csv"), "name,x,y,z\nfar,3,0,0\nhit,0.5,0.25,0.125\ntouch,1,0,0\n");
  }

  ToolResult distance(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "distance");
    return run(std::move(arguments));
  }
  /// The lines of a run without any message.
  std::vector<DistanceLine> quiet_lines(std::vector<std::string> arguments) const {
    arguments.emplace_back("-q");
    const ToolResult result = distance(std::move(arguments));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, IsEmpty());
    return lines_of(result.out);
  }
  std::vector<std::string> inputs() const { return {"apart.obj", "box.obj", "inner.obj", "poses.csv"}; }
};

TEST_F(DistanceCommand, HelpGoesToStandardOutput) {
  const ToolResult help = distance({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, StartsWith("medial-vk distance "));
  EXPECT_THAT(help.out, HasSubstr("--poses FILE"));
  EXPECT_THAT(help.err, IsEmpty());
  EXPECT_THAT(run({"--help"}).out, HasSubstr("medial-vk distance"));
}

TEST_F(DistanceCommand, TheTableGoesToStandardOutput) {
  const ToolResult result = distance({"box.obj", "apart.obj"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::vector<DistanceLine> lines = lines_of(result.out);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].state, "free");
  EXPECT_LE(lines[0].lower, 0.5);
  EXPECT_GE(lines[0].upper, 0.5);
  EXPECT_LT(lines[0].upper - lines[0].lower, 1e-12);
  EXPECT_EQ(lines[0].on_a[0], 1);
  EXPECT_EQ(lines[0].on_b[0], 1.5);
  for (const std::size_t k : {1u, 2u}) EXPECT_NEAR(lines[0].on_a[k], lines[0].on_b[k], 1e-12);
  EXPECT_THAT(result.err, HasSubstr("box.obj: 12 triangles, closed\n"));
  EXPECT_THAT(result.err, HasSubstr("apart.obj: 12 triangles, closed\n"));
  EXPECT_THAT(result.err, testing::ContainsRegex("state +free\n"));
  EXPECT_THAT(result.err, testing::ContainsRegex("distance +0\\.5 to 0\\.5\n"));
  EXPECT_THAT(result.err, Not(HasSubstr("\r")));
  EXPECT_THAT(folder_.names(), testing::ElementsAreArray(inputs()));
}

TEST_F(DistanceCommand, QuietSaysNothing) {
  EXPECT_EQ(quiet_lines({"box.obj", "apart.obj"}).size(), 1u);
  const ToolResult result = distance({"box.obj", "apart.obj", "-q", "-o", "d.csv"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, IsEmpty());
}

TEST_F(DistanceCommand, VerboseNamesTheSteps) {
  EXPECT_THAT(distance({"box.obj", "apart.obj", "-v"}).err, testing::ContainsRegex("read .*bodies .*distances "));
}

TEST_F(DistanceCommand, WritesAFile) {
  const ToolResult result = distance({"box.obj", "box.obj", "--poses", "poses.csv", "-o", "d.csv"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, testing::ContainsRegex("states +1 free, 1 hit, 1 undecided\n"));
  EXPECT_THAT(result.err, testing::ContainsRegex("least +0: .*\\(pose 2\\)\n"));
  EXPECT_THAT(result.err, testing::ContainsRegex("written +d\\.csv"));
  const std::string table = read_file(path("d.csv"));
  EXPECT_THAT(states_of(table), ElementsAre("free", "hit", "undecided"));
  const std::vector<DistanceLine> lines = lines_of(table);
  EXPECT_NEAR(lines[0].upper, 2, 1e-12);
  EXPECT_EQ(lines[1].on_a, lines[1].on_b);
  EXPECT_LT(lines[2].upper, 1e-12);
  EXPECT_THAT(folder_.names(), ElementsAre("apart.obj", "box.obj", "d.csv", "inner.obj", "poses.csv"));
}

TEST_F(DistanceCommand, TheSameBytesOnAnyNumberOfThreads) {
  std::string poses = "x,y,z,qx,qy,qz,qw\n";
  for (int i = 0; i < 300; ++i) poses += std::to_string(i % 17 - 8) + ",0.1,1.5,0.5,-0.5,0.5,0.5\n";
  test::write_file(path("many.csv"), poses);
  const ToolResult one = distance({"box.obj", "inner.obj", "--poses", "many.csv", "--threads", "1"});
  ASSERT_EQ(one.exit_code, 0) << one.err;
  EXPECT_EQ(std::ranges::count(one.out, '\n'), 301);
  EXPECT_EQ(one.out, distance({"box.obj", "inner.obj", "--poses", "many.csv", "--threads", "3"}).out);
}

TEST_F(DistanceCommand, StreamsGoThrough) {
  const std::string from_file = distance({"box.obj", "box.obj", "--poses", "poses.csv"}).out;
  ToolCall poses = call({"distance", "box.obj", "box.obj", "--poses", "-"});
  poses.standard_input = read_file(path("poses.csv"));
  const ToolResult result = test::run_tool(poses);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, from_file);
  ToolCall mesh = call({"distance", "box.obj", "-", "-o", "-"});
  mesh.standard_input = read_file(path("apart.obj"));
  const ToolResult of_mesh = test::run_tool(mesh);
  EXPECT_EQ(of_mesh.exit_code, 0);
  EXPECT_EQ(of_mesh.out, distance({"box.obj", "apart.obj"}).out);
  EXPECT_THAT(of_mesh.err, HasSubstr("standard input: 12 triangles"));
}

/// A quarter of a turn about z takes a box of [0, 1] to [-1, 0] along x.
TEST_F(DistanceCommand, APoseTurnsB) {
  test::write_file(path("turn.csv"), "qw,qx,qy,qz,x,y,z\n0.7071,0,0,0.7071,3,0,0\n");
  const std::vector<DistanceLine> lines = quiet_lines({"box.obj", "box.obj", "--poses", "turn.csv"});
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(lines[0].lower, 1, 1e-12);
  EXPECT_NEAR(lines[0].upper, 1, 1e-12);
  EXPECT_NEAR(lines[0].on_b[0], 2, 1e-12);
}

TEST_F(DistanceCommand, OneSolidInsideTheOtherIsAHit) {
  for (const auto& [a, b] : {std::pair("box.obj", "inner.obj"), {"inner.obj", "box.obj"}}) {
    const std::vector<DistanceLine> solids = quiet_lines({a, b}), surfaces = quiet_lines({a, b, "--surfaces"});
    ASSERT_EQ(solids.size(), 1u);
    EXPECT_EQ(solids[0].state, "hit");
    EXPECT_EQ(solids[0].upper, 0);
    EXPECT_EQ(solids[0].on_a, solids[0].on_b);
    ASSERT_EQ(surfaces.size(), 1u);
    EXPECT_EQ(surfaces[0].state, "free");
    EXPECT_NEAR(surfaces[0].lower, 0.3, 1e-12);
    EXPECT_NEAR(surfaces[0].upper, 0.3, 1e-12);
  }
}

TEST_F(DistanceCommand, ToleranceAndLimitWidenTheInterval) {
  test::write_file(path("ball.obj"), test::to_obj(test::make_sphere(1, 300)));
  test::write_file(path("diagonal.csv"), "x,y,z\n2,2,1\n");
  const std::vector<std::string> question = {"ball.obj", "ball.obj", "--poses", "diagonal.csv"};
  const auto with = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments = question;
    arguments.insert(arguments.end(), options.begin(), options.end());
    const std::vector<DistanceLine> lines = quiet_lines(arguments);
    return lines.size() == 1 ? lines[0] : DistanceLine();
  };
  const DistanceLine exact = with({}), tolerant = with({"--tolerance", "0.1"}), limited = with({"--limit", "0.25"});
  EXPECT_LT(exact.upper - exact.lower, 1e-12);
  EXPECT_GT(tolerant.upper - tolerant.lower, 1e-6);
  EXPECT_LE(tolerant.upper - tolerant.lower, 0.1 + 1e-12);
  EXPECT_LE(tolerant.lower, exact.upper);
  EXPECT_GE(tolerant.upper, exact.lower);
  EXPECT_NEAR(limited.lower, 0.25, 1e-12);
  EXPECT_GE(limited.upper, exact.lower);
}

TEST_F(DistanceCommand, ALimitOfZeroDecidesCollisionsAlone) {
  const ToolResult result =
      distance({"box.obj", "box.obj", "--poses", "poses.csv", "--limit", "0", "--check", "-o", "d.csv"});
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  const std::vector<DistanceLine> lines = lines_of(read_file(path("d.csv")));
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_THAT(states_of(read_file(path("d.csv"))), ElementsAre("free", "hit", "undecided"));
  EXPECT_LT(lines[0].lower, 1e-9);  // the exact distance, 2, is not computed
  EXPECT_GE(lines[0].upper, 2 - 1e-12);
}

TEST_F(DistanceCommand, CheckPassesAndItsTableIsTheResult) {
  const ToolResult result = distance({"box.obj", "box.obj", "--poses", "poses.csv", "--check", "-o", "d.csv"});
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  EXPECT_THAT(result.out, StartsWith(kCheckColumns));
  EXPECT_THAT(result.out, testing::ContainsRegex("\nlower end <= distance [^\n]* 3 +0 "));
  EXPECT_THAT(result.out, testing::ContainsRegex("\nhit: they have one +1 +0 "));
  EXPECT_THAT(result.out, Not(HasSubstr("first failure")));
  EXPECT_THAT(result.err, Not(HasSubstr(kCheckColumns)));
  EXPECT_THAT(states_of(read_file(path("d.csv"))), ElementsAre("free", "hit", "undecided"));
}

TEST_F(DistanceCommand, TheTableOfACheckLeavesStandardOutputToTheDistances) {
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{}, {"--surfaces"}, {"--tolerance", "0.2"}, {"--limit", "0.2"}}) {
    std::vector<std::string> arguments = {"box.obj", "inner.obj", "--check"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ToolResult result = distance(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(lines_of(result.out).size(), 1u);
    EXPECT_THAT(result.err, HasSubstr(kCheckColumns));
  }
}

TEST_F(DistanceCommand, WrongUsageIs2) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{},
                                                    {"box.obj"},
                                                    {"box.obj", "inner.obj", "apart.obj"},
                                                    {"box.obj", "inner.obj", "--tolerance", "-1"},
                                                    {"box.obj", "inner.obj", "--limit", "-0.5"},
                                                    {"box.obj", "inner.obj", "-q", "-v"},
                                                    {"box.obj", "inner.obj", "-o", "d.json"},
                                                    {"box.obj", "inner.obj", "--poses", "p.csv", "-o", "p.csv"},
                                                    {"-", "-"}}) {
    const ToolResult result = distance(arguments);
    EXPECT_EQ(result.exit_code, 2) << testing::PrintToString(arguments) << result.err;
    EXPECT_THAT(result.out, IsEmpty());
    EXPECT_THAT(result.err, StartsWith("medial-vk: "));
    EXPECT_THAT(result.err, HasSubstr("\nTry medial-vk distance --help.\n"));
  }
}

TEST_F(DistanceCommand, UnreadableFilesAre3AndSayWhy) {
  test::write_file(path("bad.obj"), "v 0 0 zero\n");
  test::write_file(path("bad.csv"), "x,y,z\n1,2,3\n\n1,2,three\n");
  const auto fails_with = [&](const std::vector<std::string>& arguments, const std::string& message) {
    const ToolResult result = distance(arguments);
    EXPECT_EQ(result.exit_code, 3) << result.err;
    EXPECT_THAT(result.out, IsEmpty());
    EXPECT_THAT(result.err, HasSubstr(message));
    EXPECT_THAT(result.err, Not(HasSubstr("Try ")));
  };
  fails_with({"none.obj", "box.obj"}, "medial-vk: none.obj: ");
  fails_with({"box.obj", "none.obj"}, "medial-vk: none.obj: ");
  fails_with({"bad.obj", "box.obj"}, "medial-vk: bad.obj:1: ");
  fails_with({"box.obj", "box.obj", "--poses", "none.csv"},
             "medial-vk: none.csv: cannot be read: No such file or directory\n");
  fails_with({"box.obj", "box.obj", "--poses", "bad.csv"}, "medial-vk: bad.csv:4: z: \"three\" is not a number\n");
  fails_with({"box.obj", "box.obj", "--poses", "-", "-o", "d.csv"}, "medial-vk: stdin: there is no pose\n");
  // Whether a file is written depends on all poses.
  EXPECT_THAT(folder_.names(), ElementsAre("apart.obj", "bad.csv", "bad.obj", "box.obj", "inner.obj", "poses.csv"));
}

// Each of the poses takes a tenth of a second or more, since all pairs of triangles are about as far apart, and
// progress is shown only after thousands.
TEST_F(DistanceCommand, ASignalEndsItWithinPoses) {
  test::write_file(path("outer.obj"), test::to_obj(test::make_sphere(1, 1500)));
  test::write_file(path("centre.obj"), test::to_obj(test::make_sphere(1e-6, 1500)));
  std::string poses = "x,y,z\n";
  for (int i = 0; i < 4000; ++i) poses += "0,0,0\n";
  test::write_file(path("many.csv"), poses);
  test::Tool tool(call({"distance", "outer.obj", "centre.obj", "--surfaces", "--poses", "many.csv", "-o", "d.csv"}));
  std::this_thread::sleep_for(std::chrono::seconds(1));
  ASSERT_TRUE(tool.running());
  tool.send(SIGINT);
  const ToolResult result = tool.wait();
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_THAT(result.err, testing::EndsWith("medial-vk: interrupted; nothing was written\n"));
  EXPECT_THAT(folder_.names(), Not(testing::Contains("d.csv")));
}

TEST_F(DistanceCommand, CannotWriteIs6) {
  const ToolResult result = distance({"box.obj", "apart.obj", "-o", "no/such/folder/d.csv"});
  EXPECT_EQ(result.exit_code, 6);
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, StartsWith("medial-vk: cannot write no/such/folder/d.csv"));
  EXPECT_THAT(folder_.names(), testing::ElementsAreArray(inputs()));
}

}  // namespace
}  // namespace medial_vk
