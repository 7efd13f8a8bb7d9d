// `medial-vk clearance` from outside with a scene, with limits, and with balls: bodies that are kept in a folder, body
// files of the scene, and what balls leave to triangles. Everything here runs without a Vulkan device.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "body_files/body_file.h"
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
using test::read_file;
using test::states_in;
using test::ToolResult;
using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

/// A sphere and four boxes, of which two are the same; hand and stand are 0.5 apart, and slide moves the hand away.
constexpr const char* kSlideRobot = R"(<robot name="slide">
<link name="stand"><collision><geometry><mesh filename="box.obj"/></geometry></collision>
  <collision><origin xyz="-1 0.5 0.5"/><geometry><box size="0.8 0.8 1"/></geometry></collision></link>
<link name="between"><collision><origin xyz="0 5 0"/><geometry><sphere radius="0.25"/></geometry></collision></link>
<link name="hand"><collision><origin xyz="1.5 0 0" rpy="0 0 0"/><geometry><mesh filename="hand.obj"/></geometry></collision>
</link>
<link name="copy"><collision><origin xyz="0 0 9"/><geometry><mesh filename="hand.obj"/></geometry></collision></link>
<joint name="fix" type="fixed"><parent link="stand"/><child link="between"/></joint>
<joint name="slide" type="prismatic"><parent link="between"/><child link="hand"/><limit lower="-2" upper="9"/></joint>
<joint name="lift" type="prismatic"><parent link="between"/><child link="copy"/><axis xyz="0 0 1"/>
  <limit lower="0" upper="9"/></joint>
</robot>)";

class ClearanceBodies : public test::ToolTest {
 protected:
  ClearanceBodies() {
    Mesh box = test::make_box({1, 1, 1}), wall = box;
    test::translate(wall, {8, 0, 0});
    test::write_file(path("box.obj"), test::to_obj(box));
    test::write_file(path("hand.obj"), test::to_obj(test::make_box({0.5, 1, 1})));
    test::write_file(path("wall.obj"), test::to_obj(wall));
    test::write_file(path("slide.urdf"), kSlideRobot);
    test::write_file(path("q.csv"), "slide,lift\n0,0\n-1,0\n4,0\n");
    wall_.version = "0";
    wall_.mesh = wall;
    wall_.inside = {{{8.5, 0.5, 0.5}, 0.49}};
    wall_.cover = {{{8.5, 0.5, 0.5}, 0.88}};
    test::write_file(path("wall.npz"), encode_body_file(wall_).value());
  }

  /// With as few candidates as possible, on the CPU.
  ToolResult by_balls(std::vector<std::string> arguments, const char* balls = "2") const {
    arguments.insert(arguments.begin(), {"clearance", "slide.urdf", "--joints", "q.csv", "--balls", balls,
                                         "--resolution", "8", "--backend", "cpu", "-o", "c.csv"});
    return run(std::move(arguments));
  }
  std::string table() const { return test::read_file(path("c.csv")); }
  std::string kept(const std::string& stem) const {
    for (const auto& entry : std::filesystem::directory_iterator(path("kept"))) {
      if (entry.path().filename().string().starts_with(stem + "-")) return entry.path().string();
    }
    ADD_FAILURE() << "no body of " << stem;
    return "";
  }
  std::ptrdiff_t number_of_kept() const {
    return std::distance(std::filesystem::directory_iterator(path("kept")), std::filesystem::directory_iterator());
  }

  BodyFile wall_;
};

/// The sphere needs no fit, and equal links share a body.
TEST_F(ClearanceBodies, AreFittedOnce) {
  const ToolResult first = by_balls({"--bodies", "kept"});
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_THAT(first.err, ContainsRegex("bodies +0 bodies read from kept, 4 fitted and kept there\n"));
  EXPECT_EQ(number_of_kept(), 3);
  const std::string expected = table();
  const ToolResult without = by_balls({});
  EXPECT_EQ(table(), expected);
  EXPECT_THAT(without.err, testing::Not(HasSubstr("bodies")));
  // No device is opened, where there is nothing to fit.
  test::ToolCall again = call({"clearance", "slide.urdf", "--joints", "q.csv", "--balls", "2", "--resolution", "8",
                               "-o", "c.csv", "--bodies", "kept", "--check", "--device", "no such device"});
  const ToolResult second = test::run_tool(again);
  ASSERT_EQ(second.exit_code, 0) << second.err << second.out;
  EXPECT_THAT(second.err, ContainsRegex("bodies +4 bodies read from kept, none fitted\n"));
  EXPECT_EQ(table(), expected);
}

TEST_F(ClearanceBodies, AreThoseOfTheMeshAndTheNumberOfBalls) {
  ASSERT_EQ(by_balls({"--bodies", "kept", "-q"}).exit_code, 0);
  const ToolResult more = by_balls({"--bodies", "kept"}, "3");
  ASSERT_EQ(more.exit_code, 0) << more.err;
  EXPECT_THAT(more.err, ContainsRegex("bodies +0 bodies read from kept, 4 fitted"));
  EXPECT_EQ(number_of_kept(), 6);
  test::write_file(path("hand.obj"), test::to_obj(test::make_box({0.5, 1, 1.25})));
  const ToolResult other = by_balls({"--bodies", "kept", "--scene", "wall.obj"});
  ASSERT_EQ(other.exit_code, 0) << other.err;
  EXPECT_THAT(other.err, ContainsRegex("bodies +2 bodies read from kept, 3 fitted"));
  // One of two solids of a link is missing, so that both are fitted.
  std::filesystem::remove(kept("primitive1"));
  std::filesystem::remove(kept("primitive1"));
  const ToolResult both = by_balls({"--bodies", "kept", "--scene", "wall.obj"});
  EXPECT_THAT(both.err, ContainsRegex("bodies +3 bodies read from kept, 2 fitted"));
}

/// A cylinder is between the mesh of its file and one inside it.
TEST_F(ClearanceBodies, AreReadByOtherCommands) {
  std::string robot = kSlideRobot;
  const std::string box = "<box size=\"0.8 0.8 1\"/>";
  robot.replace(robot.find(box), box.size(), "<cylinder radius=\"0.4\" length=\"1\"/>");
  test::write_file(path("slide.urdf"), robot);
  ASSERT_EQ(by_balls({"--bodies", "kept", "-q"}).exit_code, 0);
  for (const char* stem : {"box", "primitive1"}) {
    const ToolResult result = run({"distance", kept(stem), "wall.npz", "--balls", "--check"});
    EXPECT_EQ(result.exit_code, 0) << result.err << result.out;
    EXPECT_THAT(result.out, ContainsRegex(",free,"));
  }
  const ToolResult again = by_balls({"--bodies", "kept", "--check"});
  EXPECT_EQ(again.exit_code, 0) << again.err << again.out;
  EXPECT_THAT(again.err, ContainsRegex("bodies +4 bodies read from kept, none fitted\n"));
  const BodyFile body = read_body_file(kept("hand")).value();
  EXPECT_LE(body.measures.inside_excess, 0);
  EXPECT_EQ(body.measures.solid_volume, 0.5);
  EXPECT_LT(body.measures.inside_volume, 0.5);
  EXPECT_GT(body.measures.cover_volume, 0.5);
  EXPECT_GT(body.measures.inside_gap.lower, 0);
  // The longest diagonal of the box is 1.5, so a ball of radius 0.75 covers it and reaches out by half a side less.
  EXPECT_GT(body.measures.cover_reach_out.upper, 0.1);
  EXPECT_LT(body.measures.cover_reach_out.upper, 0.75);
}

TEST_F(ClearanceBodies, ThatAreBrokenAreErrorsByName) {
  ASSERT_EQ(by_balls({"--bodies", "kept", "-q"}).exit_code, 0);
  const std::string hand = kept("hand"), whole = test::read_file(hand);
  const auto fails_with = [&](const std::string& bytes, const std::string& message) {
    test::write_file(hand, bytes);
    std::filesystem::remove(path("c.csv"));
    const ToolResult result = by_balls({"--bodies", "kept"});
    EXPECT_EQ(result.exit_code, 3) << result.err;
    EXPECT_THAT(result.err, HasSubstr("medial-vk: kept/" + std::filesystem::path(hand).filename().string() + ": "));
    EXPECT_THAT(result.err, HasSubstr(message));
    EXPECT_THAT(result.err, HasSubstr("; remove the file to have the body fitted again\n"));
    EXPECT_FALSE(std::filesystem::exists(path("c.csv")));
  };
  fails_with(whole.substr(0, whole.size() / 2), "");
  fails_with(test::read_file(kept("box")), "its mesh is not that of hand.obj");
  BodyFile body = decode_body_file(whole, "whole").value();
  BodyFile larger = body, smaller = body, open = body;
  larger.inside[0].radius *= 1.01;
  fails_with(encode_body_file(larger).value(), "reaches out of the solid");
  for (Ball& ball : smaller.cover) ball.radius *= 0.9;
  fails_with(encode_body_file(smaller).value(), "are not proved to cover the surface");
  open.cover.clear();
  fails_with(encode_body_file(open).value(), "has no balls that cover the mesh");
  std::filesystem::remove(hand);
  EXPECT_THAT(by_balls({"--bodies", "kept"}).err, ContainsRegex("bodies +2 bodies read from kept, 2 fitted"));
}

TEST_F(ClearanceBodies, NeedAFolder) {
  const ToolResult file = by_balls({"--bodies", "box.obj"}), nowhere = by_balls({"--bodies", "no/folder"});
  EXPECT_EQ(file.exit_code, 6);
  EXPECT_THAT(file.err, HasSubstr("medial-vk: box.obj: is no folder\n"));
  EXPECT_EQ(nowhere.exit_code, 6);
  EXPECT_THAT(nowhere.err, HasSubstr("no/folder"));
}

TEST_F(ClearanceBodies, OfTheSceneAreFiles) {
  const ToolResult balls = by_balls({"--scene", "wall.npz", "--check"});
  ASSERT_EQ(balls.exit_code, 0) << balls.err << balls.out;
  EXPECT_THAT(balls.err, ContainsRegex("scene +1 mesh; 1 is from a body file, proved again\n"));
  // Hand and wall are 8 - 6 apart in the third configuration; balls give less and more.
  EXPECT_THAT(table(), ContainsRegex("\n3,free,1\\.[0-9]+,2\\.[0-9]+,hand,wall.npz\n"));
  const std::vector<std::string> by_triangles = {"clearance", "slide.urdf", "--joints", "q.csv", "-q", "--scene"};
  const auto of_scene = [&](const char* scene) {
    std::vector<std::string> arguments = by_triangles;
    arguments.emplace_back(scene);
    return run(std::move(arguments));
  };
  std::string expected = of_scene("wall.obj").out;
  ASSERT_THAT(expected, HasSubstr(",hand,wall.obj\n"));
  for (std::size_t at; (at = expected.find("wall.obj")) != std::string::npos;) expected.replace(at, 8, "wall.npz");
  EXPECT_EQ(of_scene("wall.npz").out, expected);
  wall_.cover.clear();
  test::write_file(path("inside.npz"), encode_body_file(wall_).value());
  const ToolResult no_cover = by_balls({"--scene", "inside.npz"});
  EXPECT_EQ(no_cover.exit_code, 3);
  EXPECT_THAT(no_cover.err, HasSubstr("inside.npz: the file has no balls that cover the mesh, and --balls needs them"));
  EXPECT_EQ(of_scene("inside.npz").exit_code, 0);
  wall_.inside[0].radius = 0.51;
  test::write_file(path("out.npz"), encode_body_file(wall_).value());
  const ToolResult out = of_scene("out.npz");
  EXPECT_EQ(out.exit_code, 3);
  EXPECT_THAT(out.err, HasSubstr("out.npz: ball 0 of those inside reaches out of the solid"));
}

/// Lines of configurations that balls leave undecided are those of triangles, and the others those of balls.
TEST_F(ClearanceBodies, LeaveToTrianglesWhatTheyDoNotDecide) {
  const auto lines_of = [](const std::string& table) {
    std::vector<std::string> lines;
    std::istringstream in(table);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
  };
  test::write_file(path("q.csv"), "slide,lift\n0.0625,0\n-0.5625,0\n-1,0\n6,0\n");
  ASSERT_EQ(by_balls({"--bodies", "kept", "-q"}).exit_code, 0);
  const std::vector<std::string> balls = lines_of(table());
  const ToolResult result = by_balls({"--bodies", "kept", "--decide", "--check", "--picture", "p.png", "--row", "1"});
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  const std::vector<std::string> decided = lines_of(table());
  const std::vector<std::string> triangles = lines_of(run({"clearance", "slide.urdf", "--joints", "q.csv", "-q"}).out);
  ASSERT_EQ(decided.size(), 5u);
  ASSERT_EQ(balls.size(), 5u);
  ASSERT_EQ(triangles.size(), 5u);
  std::size_t by_triangles = 0;
  for (std::size_t i = 1; i < 5; ++i) {
    const bool is_undecided = balls[i].find(",undecided,") != std::string::npos;
    EXPECT_EQ(decided[i], is_undecided ? triangles[i] : balls[i]);
    by_triangles += is_undecided ? 1 : 0;
  }
  EXPECT_NE(balls[4], triangles[4]);
  ASSERT_EQ(by_triangles, 1u);
  EXPECT_THAT(result.err, ContainsRegex("states +2 free, 2 hit, 0 undecided\n"));
  EXPECT_THAT(result.err, ContainsRegex("decided +1 configuration by triangles, which balls left undecided\n"));
  EXPECT_THAT(test::read_file(path("p.png")), StartsWith("\x89PNG"));
}

TEST_F(ClearanceCommand, TheSceneIsInTheFrameOfTheRoot) {
  const ToolResult result = clearance({"rail.urdf", "--joints", "q.csv", "--scene", "wall.obj", "-q"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, IsEmpty());
  const std::vector<ClearanceLine> lines = clearances_in(result.out);
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[2].first, "hand");
  EXPECT_EQ(lines[2].second, "wall.obj");
  EXPECT_NEAR(lines[2].lower, 1, kClearanceRounding);
  EXPECT_EQ(lines[3].state, "hit");
  EXPECT_EQ(lines[0].second, "hand");
}

TEST_F(ClearanceCommand, FilesOfASceneAreOneLink) {
  Mesh left = test::make_box({1, 1, 1});
  test::translate(left, {-4, 0, 0});
  test::write_file(path("left.obj"), test::to_obj(left));
  test::write_file(path("both.csv"), "slide,turn,reach\n0,0,2\n0,0,-4\n0,0,-5\n");
  const std::vector<std::string> arguments = {"rail.urdf", "--joints", "both.csv", "--scene", "left.obj",
                                              "--scene",   "wall.obj", "--check",  "-o",      "c.csv"};
  const auto with = [&](const std::vector<std::string>& options) {
    std::vector<std::string> all = arguments;
    all.insert(all.end(), options.begin(), options.end());
    const ToolResult result = clearance(all);
    EXPECT_EQ(result.exit_code, 0) << result.err << result.out;
    EXPECT_THAT(result.err, HasSubstr("3 compared; "));
    return clearances_in(read_file(path("c.csv")));
  };
  const std::vector<ClearanceLine> exact = with({"--picture", "p.png"});
  ASSERT_EQ(exact.size(), 3u);
  const char* const names[] = {"wall.obj", "left.obj", "left.obj"};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(exact[i].first, "hand");
    EXPECT_EQ(exact[i].second, names[i]);
  }
  EXPECT_NEAR(exact[0].upper, 0.5, kClearanceRounding);
  EXPECT_NEAR(exact[1].upper, 0.5, kClearanceRounding);
  EXPECT_EQ(exact[2].state, "hit");
  const std::vector<ClearanceLine> by_balls = with({"--balls", "1", "--backend", "cpu", "--resolution", "12"});
  ASSERT_EQ(by_balls.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(by_balls[i].second, names[i]);
}

TEST_F(ClearanceCommand, ALimitOfZeroDecidesCollisionsAlone) {
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{}, {"--balls", "1", "--backend", "cpu", "--decide"}}) {
    std::vector<std::string> arguments = {"rail.urdf", "--joints", "q.csv",   "--scene", "wall.obj",
                                          "--limit",   "0",        "--check", "-o",      "c.csv"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    arguments.insert(arguments.end(), {"--html", "p.html", "--row", "3"});
    const ToolResult result = clearance(arguments);
    ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
    const std::vector<ClearanceLine> lines = clearances_in(read_file(path("c.csv")));
    ASSERT_EQ(lines.size(), 4u);
    EXPECT_THAT(states_in(read_file(path("c.csv"))), ElementsAre("free", "hit", "free", "hit"));
    EXPECT_GT(lines[2].lower, 0);
    EXPECT_LT(lines[2].lower, 1e-300);
    EXPECT_EQ(lines[3].second, "wall.obj");
    EXPECT_THAT(read_file(path("p.html")), HasSubstr("Configuration 3 of 4: the solids have no common point."));
  }
}

TEST_F(ClearanceCommand, ToleranceAndLimitWidenTheInterval) {
  const std::vector<ClearanceLine> limited =
      clearances_in(clearance({"rail.urdf", "--joints", "q.csv", "--limit", "1"}).out);
  ASSERT_EQ(limited.size(), 4u);
  EXPECT_NEAR(limited[0].upper, 0.5, kClearanceRounding);
  EXPECT_GE(limited[3].lower, 1);
  EXPECT_EQ(limited[3].state, "free");
  const std::vector<ClearanceLine> tolerant =
      clearances_in(clearance({"rail.urdf", "--joints", "q.csv", "--tolerance", "0.1"}).out);
  ASSERT_EQ(tolerant.size(), 4u);
  EXPECT_LE(tolerant[0].lower, 0.5);
  EXPECT_GE(tolerant[0].upper, 0.5);
  EXPECT_LE(tolerant[0].upper - tolerant[0].lower, 0.1 + kClearanceRounding);
}

}  // namespace
}  // namespace medial_vk
