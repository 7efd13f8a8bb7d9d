// `medial-vk clearance` from outside: exit codes, streams, files. Everything here runs without a Vulkan device.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "clearance_command.h"
#include "support/solids/mesh_files.h"
#include "support/solids/solids.h"
#include "tool_test.h"

namespace medial_vk {
namespace {

using test::ClearanceCommand;
using test::ClearanceLine;
using test::clearances_in;
using test::kClearanceRounding;
using test::kRailRobot;
using test::read_file;
using test::states_in;
using test::ToolCall;
using test::ToolResult;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

TEST_F(ClearanceCommand, HelpGoesToStandardOutput) {
  const ToolResult help = clearance({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, StartsWith("medial-vk clearance "));
  EXPECT_THAT(help.err, IsEmpty());
  EXPECT_THAT(run({"--help"}).out, HasSubstr("medial-vk clearance"));
}

/// The hand is 0.5 to the right of the box of the base, plus slide and reach.
TEST_F(ClearanceCommand, LinksAmongEachOther) {
  const ToolResult result = clearance({"rail.urdf", "--joints", "q.csv"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::vector<ClearanceLine> lines = clearances_in(result.out);
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_THAT(states_in(result.out), ElementsAre("free", "hit", "free", "free"));
  const double expected[] = {0.5, 0, 2, 3.5};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LE(lines[i].lower, expected[i]);
    EXPECT_GE(lines[i].upper, expected[i]);
    EXPECT_LT(lines[i].upper - lines[i].lower, 2 * kClearanceRounding);
    EXPECT_EQ(lines[i].first, "base");
    EXPECT_EQ(lines[i].second, "hand");
  }
  EXPECT_THAT(result.err, HasSubstr("rail.urdf: 4 links, 3 free joints, 3 solids\n"));
  EXPECT_THAT(result.err, HasSubstr("1 compared; 1 joined and 1 that always touch are not\n"));
  EXPECT_THAT(result.err, testing::ContainsRegex("states +3 free, 1 hit, 0 undecided\n"));
  EXPECT_THAT(result.err, testing::ContainsRegex("least +0 \\(configuration 2, base and hand\\)\n"));
  EXPECT_THAT(clearance({"rail.urdf", "--joints", "q.csv", "-v"}).err,
              testing::AllOf(testing::ContainsRegex("touch +base and slider\n"), testing::ContainsRegex("pairs .* s")));
}

/// Each file keeps its name, and the summary counts the scene as one link: base and hand, slider and hand with it.
TEST_F(ClearanceCommand, AnSrdfNamesThePairsThatAreLeftOut) {
  const ToolResult found = clearance({"rail.urdf", "--joints", "q.csv", "--write-srdf", "r.srdf", "-o", "c.csv"});
  ASSERT_EQ(found.exit_code, 0) << found.err;
  EXPECT_THAT(found.out, IsEmpty());
  const std::string srdf = read_file(path("r.srdf"));
  EXPECT_THAT(srdf, HasSubstr("<disable_collisions link1=\"slider\" link2=\"hand\" reason=\"Adjacent\"/>"));
  EXPECT_THAT(srdf, HasSubstr("<disable_collisions link1=\"base\" link2=\"slider\" reason=\"Always\"/>"));
  const ToolResult again = clearance({"rail.urdf", "--joints", "q.csv", "--srdf", "r.srdf"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(again.out, read_file(path("c.csv")));
  test::write_file(path("none.srdf"), "<robot name='rail'/>");
  const ToolResult all = clearance({"rail.urdf", "--joints", "q.csv", "--srdf", "none.srdf"});
  EXPECT_THAT(states_in(all.out), ElementsAre("hit", "hit", "hit", "hit"));
}

TEST_F(ClearanceCommand, MimicsFollowAndLimitsAreNoted) {
  std::string robot = kRailRobot;
  const std::string limit = "<limit lower=\"-1\" upper=\"3\"/>";
  robot.replace(robot.find(limit), limit.size(), limit + "<mimic joint='slide' multiplier='2' offset='1'/>");
  test::write_file(path("mimic.urdf"), robot);
  test::write_file(path("slide.csv"), "turn,slide,reach\n0,0,100\n0,0.5,100\n");
  const ToolResult result = clearance({"mimic.urdf", "--joints", "slide.csv"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::vector<ClearanceLine> lines = clearances_in(result.out);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_NEAR(lines[0].upper, 1.5, kClearanceRounding);
  EXPECT_NEAR(lines[1].upper, 3, kClearanceRounding);
  EXPECT_THAT(result.err, testing::ContainsRegex("limits +beyond them in 1 configuration, first in "
                                                 "configuration 2: slide is at 0.5, above 0.25\n"));
}

/// Facets around the sphere prove the lower end, those inside it the upper one.
TEST_F(ClearanceCommand, ASphereIsBetweenItsFacets) {
  test::write_file(path("ball.urdf"), R"(<robot name="b"><link name="a"/>
<link name="ball"><collision><geometry><sphere radius="0.5"/></geometry></collision></link>
<joint name="x" type="prismatic"><parent link="a"/><child link="ball"/><limit lower="-9" upper="9"/></joint></robot>)");
  test::write_file(path("x.csv"), "x\n2\n4.4998\n4.6\n");
  test::write_file(path("tall.obj"), test::to_obj([] {
                     Mesh tall = test::make_box({1, 4, 4});
                     test::translate(tall, {5, -2, -2});
                     return tall;
                   }()));
  const ToolResult result =
      clearance({"ball.urdf", "--joints", "x.csv", "--scene", "tall.obj", "--check", "-o", "c.csv"});
  ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
  const std::vector<ClearanceLine> lines = clearances_in(read_file(path("c.csv")));
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0].state, "free");
  EXPECT_LE(lines[0].lower, 2.5);
  EXPECT_GE(lines[0].upper, 2.5);
  EXPECT_LT(lines[0].upper - lines[0].lower, 0.0012);
  EXPECT_EQ(lines[1].state, "undecided");
  EXPECT_EQ(lines[2].state, "hit");
  EXPECT_THAT(result.err, HasSubstr("between facets"));
}

TEST_F(ClearanceCommand, CheckPassesAndItsTableIsTheResult) {
  const ToolResult result =
      clearance({"rail.urdf", "--joints", "q.csv", "--scene", "wall.obj", "--check", "-o", "c.csv", "--limit", "1.75"});
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  EXPECT_THAT(result.out, StartsWith("condition "));
  EXPECT_THAT(result.out, testing::ContainsRegex("\nlower end <= least distance [^\n]* 4 +0 "));
  EXPECT_THAT(result.out, testing::ContainsRegex("\nhit: some have one +2 +0 "));
}

TEST_F(ClearanceCommand, TheSameBytesOnAnyNumberOfThreads) {
  std::string q = "slide,turn,reach\n";
  for (int i = 0; i < 300; ++i) q += "0.1," + std::to_string(i) + "," + std::to_string(i % 7 - 1) + "\n";
  ToolCall call_one = call({"clearance", "rail.urdf", "--joints", "-", "--threads", "1"});
  call_one.standard_input = q;
  const ToolResult one = test::run_tool(call_one);
  ASSERT_EQ(one.exit_code, 0) << one.err;
  EXPECT_EQ(std::ranges::count(one.out, '\n'), 301);
  call_one.arguments.back() = "3";
  EXPECT_EQ(test::run_tool(call_one).out, one.out);
}

/// The wall is open: it has a cover, but nothing is inside it, so that contact with it is not proved.
TEST_F(ClearanceCommand, BallsAloneHoldTheDistance) {
  const std::vector<std::string> arguments = {"rail.urdf", "--joints", "q.csv", "--balls", "1",
                                              "--backend", "cpu",      "-o",    "c.csv",   "--check"};
  const ToolResult result = clearance(arguments);
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  EXPECT_THAT(result.out, StartsWith("condition "));
  EXPECT_THAT(result.err, testing::ContainsRegex("balls +3 inside and 3 that cover, proved"));
  const std::vector<ClearanceLine> lines = clearances_in(read_file(path("c.csv")));
  ASSERT_EQ(lines.size(), 4u);
  const double expected[] = {0.5, 0, 2, 3.5};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LE(lines[i].lower, expected[i]);
    EXPECT_GE(lines[i].upper, expected[i]);
    EXPECT_EQ(lines[i].first, "base");
    EXPECT_EQ(lines[i].second, "hand");
  }
  EXPECT_THAT(states_in(read_file(path("c.csv"))), ElementsAre("undecided", "hit", "free", "free"));
  EXPECT_GT(lines[3].upper - lines[3].lower, 0.01);
  Mesh open = test::make_box({1, 1, 1});
  test::translate(open, {5, 0, 0});
  open.triangles.pop_back();
  test::write_file(path("open.obj"), test::to_obj(open));
  test::write_file(path("near.csv"), "slide,turn,reach\n0,0,3\n");
  const ToolResult near = clearance({"rail.urdf", "--joints", "near.csv", "--balls", "1", "--resolution", "12",
                                     "--backend", "cpu", "--scene", "open.obj", "-q"});
  EXPECT_EQ(near.exit_code, 0) << near.err;
  EXPECT_THAT(states_in(near.out), ElementsAre("undecided"));
  EXPECT_GT(clearances_in(near.out).at(0).upper, 1);
}

TEST_F(ClearanceCommand, APictureAndAPage) {
  const ToolResult result = clearance({"rail.urdf", "--joints", "q.csv", "--scene", "wall.obj", "-o", "c.csv",
                                       "--picture", "p.png", "--html", "p.html", "--up", "z", "-v"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, testing::ContainsRegex("written +p.png"));
  EXPECT_THAT(result.err, testing::ContainsRegex("time .*picture "));
  EXPECT_THAT(read_file(path("p.png")), StartsWith("\x89PNG"));
  const std::string page = read_file(path("p.html"));
  EXPECT_THAT(page, HasSubstr("<h1>Clearances of rail.urdf</h1>"));
  // The hand touches the base in configuration 2 and the wall in configuration 4.
  EXPECT_THAT(page, HasSubstr("Configuration 2 of 4, that of the least distance: the solids have a common point."));
  EXPECT_THAT(page, HasSubstr("<h2>4 configurations</h2>"));
  EXPECT_THAT(page, HasSubstr("<td>2</td><td>50.00 %</td>"));
  EXPECT_THAT(page, HasSubstr("upper end of the distance, metres; number of configurations"));
  // Beyond the limit there is no closest pair, and one configuration has no number.
  test::write_file(path("one.csv"), "slide,turn,reach\n0,0,3\n");
  const ToolResult far = clearance({"rail.urdf", "--joints", "one.csv", "--limit", "1", "--html", "p.html", "-q"});
  ASSERT_EQ(far.exit_code, 0) << far.err;
  EXPECT_THAT(read_file(path("p.html")), HasSubstr("The configuration: the distance is at least 1, in metres."));
}

TEST_F(ClearanceCommand, APictureOfARowThatIsChosen) {
  const auto drawn = [this](std::vector<std::string> options) {
    options.insert(options.begin(), {"rail.urdf", "--joints", "q.csv", "--scene", "wall.obj", "--picture", "p.png",
                                     "--html", "p.html", "-q"});
    return clearance(std::move(options));
  };
  ASSERT_EQ(drawn({}).exit_code, 0);
  const std::string least = read_file(path("p.png"));
  const ToolResult same = drawn({"--row", "2"});
  ASSERT_EQ(same.exit_code, 0) << same.err;
  EXPECT_EQ(read_file(path("p.png")), least);
  const ToolResult last = drawn({"--row", "4"});
  ASSERT_EQ(last.exit_code, 0) << last.err;
  EXPECT_NE(read_file(path("p.png")), least);
  EXPECT_THAT(read_file(path("p.html")), HasSubstr("<p>Configuration 4 of 4: the solids have a common point.</p>"));
  const ToolResult none = drawn({"--row", "5"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.out, IsEmpty());
  EXPECT_THAT(none.err, HasSubstr("medial-vk: --row 5: there are only 4 configurations\n"));
}

TEST_F(ClearanceCommand, WrongUsageIs2) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{},
                                                    {"rail.urdf"},
                                                    {"box.obj", "--joints", "q.csv"},
                                                    {"rail.urdf", "--joints", "q.csv", "--package", "x"},
                                                    {"rail.urdf", "--joints", "q.csv", "-o", "q.csv"}}) {
    const ToolResult result = clearance(arguments);
    EXPECT_EQ(result.exit_code, 2) << testing::PrintToString(arguments) << result.err;
    EXPECT_THAT(result.out, IsEmpty());
    EXPECT_THAT(result.err, HasSubstr("\nTry medial-vk clearance --help.\n"));
  }
}

TEST_F(ClearanceCommand, UnreadableFilesAre3AndSayWhy) {
  test::write_file(path("bad.csv"), "slide,turn,reach\n0,0,0\n0,zero,0\n");
  test::write_file(path("few.csv"), "slide,turn\n0,0\n");
  test::write_file(path("far.csv"), "slide,turn,reach\n1e18,0,1e18\n");
  test::write_file(path("bad.srdf"), "<robot>\n<disable_collisions link1='base' link2='foot'/></robot>");
  test::write_file(path("floats.urdf"),
                   "<robot><link name='a'/><link name='b'/>\n<joint type='floating'>"
                   "<parent link='a'/><child link='b'/></joint></robot>");
  const auto fails_with = [&](const std::vector<std::string>& arguments, const std::string& message) {
    const ToolResult result = clearance(arguments);
    EXPECT_EQ(result.exit_code, 3) << result.err;
    EXPECT_THAT(result.out, IsEmpty());
    EXPECT_THAT(result.err, HasSubstr(message));
  };
  fails_with({"none.urdf", "--joints", "q.csv"}, "medial-vk: none.urdf: cannot be read: No such file or directory\n");
  fails_with({"floats.urdf", "--joints", "q.csv"}, "medial-vk: floats.urdf:2: the type \"floating\" of a joint");
  fails_with({"rail.urdf", "--joints", "none.csv"}, "medial-vk: none.csv: cannot be read");
  fails_with({"rail.urdf", "--joints", "bad.csv"}, "medial-vk: bad.csv:3: \"turn\": \"zero\" is not a number\n");
  fails_with({"rail.urdf", "--joints", "few.csv"}, "medial-vk: few.csv:1: there is no column for the joint \"reach\"");
  fails_with({"rail.urdf", "--joints", "q.csv", "--scene", "none.obj"}, "medial-vk: none.obj: ");
  fails_with({"rail.urdf", "--joints", "q.csv", "--srdf", "bad.srdf", "-o", "c.csv"},
             "medial-vk: bad.srdf:2: the robot has no link \"foot\"\n");
  // Whether a file is written depends on all of them.
  EXPECT_THAT(folder_.names(), Not(testing::Contains("c.csv")));
  // Beyond the range of distances nothing is proved.
  const ToolResult far = clearance({"rail.urdf", "--joints", "far.csv", "-q"});
  EXPECT_EQ(far.exit_code, 0) << far.err;
  EXPECT_THAT(states_in(far.out), ElementsAre("undecided"));
}

TEST_F(ClearanceCommand, LimitsBeyondNumbersLeaveNoPairOut) {
  std::string robot = kRailRobot;
  const std::string limits = "lower=\"-0.25\" upper=\"0.25\"";
  robot.replace(robot.find(limits), limits.size(), "lower=\"-1e30\" upper=\"1e30\"");
  test::write_file(path("far.urdf"), robot);
  const ToolResult result = clearance({"far.urdf", "--joints", "q.csv"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("2 compared; 1 joined and 0 that always touch are not"));
  const std::string limit = "lower=\"-1e30\"";
  robot.replace(robot.find(limit), limit.size(), "lower=\"1e308\"");
  robot.replace(robot.find("upper=\"1e30\""), 12, "upper=\"1e308\"");
  const std::string reach = "lower=\"-1\" upper=\"3\"";
  robot.replace(robot.find(reach), reach.size(), "lower=\"1e308\" upper=\"1e308\"");
  const std::string axis = "<axis xyz=\"0 0 1\"/>";
  robot.replace(robot.find(axis), axis.size(), "<axis xyz=\"1 0 0\"/>");
  test::write_file(path("farther.urdf"), robot);
  const ToolResult farther = clearance({"farther.urdf", "--joints", "q.csv"});
  EXPECT_EQ(farther.exit_code, 3);
  EXPECT_THAT(farther.err, HasSubstr("medial-vk: farther.urdf: within the limits of the joints, the pose of the link"));
}

TEST_F(ClearanceCommand, AnOpenMeshIsASurface) {
  Mesh open = test::make_box({20, 20, 20});
  test::translate(open, {-9, -9, -9});
  open.triangles.pop_back();
  test::write_file(path("open.obj"), test::to_obj(open));
  const ToolResult result = clearance({"rail.urdf", "--joints", "q.csv", "--scene", "open.obj"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, testing::ContainsRegex("open +1 mesh is not closed"));
  EXPECT_THAT(states_in(result.out), ElementsAre("free", "hit", "free", "free"));
}

TEST_F(ClearanceCommand, CannotWriteIs6) {
  const ToolResult result = clearance({"rail.urdf", "--joints", "q.csv", "-o", "no/such/folder/c.csv"});
  EXPECT_EQ(result.exit_code, 6);
  EXPECT_THAT(result.err, StartsWith("medial-vk: cannot write no/such/folder/c.csv"));
}

}  // namespace
}  // namespace medial_vk
