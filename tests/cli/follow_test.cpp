// `medial-vk follow` from outside: files, messages, exit codes. Balls come from a table, so that no device is needed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "support/solids/mesh_files.h"
#include "support/solids/solids.h"
#include "tool_test.h"
#include "unit/motion_files/animations.h"

namespace medial_vk {
namespace {

using test::read_file;
using test::ToolResult;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

constexpr const char* kFrameColumns = "frame,name,time,solid_volume,ball_volume,uncovered_percent";

/// The words of the line of a frame.
std::vector<std::string> frame_line(const std::string& table, std::size_t frame) {
  std::istringstream text(table);
  std::string line;
  for (std::size_t i = 0; i <= frame + 1; ++i) std::getline(text, line);
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; std::getline(in, word, ',');) words.push_back(word);
  return words;
}

/// A box of sides 2, 1 and 1 at rest, and frames that stretch it to 3 and 4.
class FollowCommand : public test::ToolTest {
 protected:
  FollowCommand() {
    for (int i = 0; i <= 2; ++i) {
      const Mesh box = test::make_box({2.0 + i, 1, 1});
      test::write_file(path("box_" + std::to_string(i) + ".obj"), test::to_obj(box));
    }
    test::write_file(path("balls.csv"), "x,y,z,radius\n0.5,0.5,0.5,0.5\n1.5,0.5,0.5,0.5\n1,0.5,0.5,0.25\n");
  }

  ToolResult follow(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "follow");
    return run(std::move(arguments));
  }
  ToolResult follow_box(std::vector<std::string> more) const {
    std::vector<std::string> arguments = {"box_0.obj", "box_1.obj", "box_2.obj", "--balls", "balls.csv"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return follow(std::move(arguments));
  }
};

TEST_F(FollowCommand, WritesEveryFormat) {
  const ToolResult result = follow_box({"-o", "a.npz", "-o", "a.glb", "-o", "a.csv", "--picture", "a.png", "--check"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("box_0.obj: 12 triangles, closed; 2 frames"));
  EXPECT_THAT(result.err, HasSubstr("3 medial"));
  EXPECT_THAT(result.out, HasSubstr("radius <= exact distance"));
  EXPECT_THAT(folder_.names(),
              ElementsAre("a.csv", "a.glb", "a.npz", "a.png", "balls.csv", "box_0.obj", "box_1.obj", "box_2.obj"));
  const std::string table = read_file(path("a.csv"));
  EXPECT_THAT(table, StartsWith(kFrameColumns));
  const std::vector<std::string> rest = frame_line(table, 0), last = frame_line(table, 2);
  EXPECT_EQ(rest[1], "rest");
  EXPECT_EQ(last[1], "box_2.obj");
  EXPECT_NEAR(std::stod(rest[3]), 2, 1e-12);
  EXPECT_NEAR(std::stod(last[3]), 4, 1e-12);
  EXPECT_THAT(read_file(path("a.npz")), StartsWith("PK"));
  EXPECT_THAT(read_file(path("a.glb")), StartsWith("glTF"));
  EXPECT_THAT(read_file(path("a.png")), StartsWith("\x89PNG"));
}

TEST_F(FollowCommand, WithoutAnOutputTheArraysAreWrittenHere) {
  const ToolResult result = follow_box({"-q"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, IsEmpty());
  EXPECT_THAT(read_file(path("box_0.follow.npz")), StartsWith("PK"));
}

TEST_F(FollowCommand, PatternsStandForTheirFilesInOrder) {
  const ToolResult by_name = follow_box({"-o", "-", "-q"});
  ASSERT_EQ(by_name.exit_code, 0) << by_name.err;
  for (const char* pattern : {"box_%d.obj", "box_#.obj", "box_*.obj"}) {
    const ToolResult result = follow({"box_0.obj", pattern, "--balls", "balls.csv", "-o", "-", "-q"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(frame_line(result.out, 1)[1], "box_0.obj") << "the pattern also stands for the rest pose";
    EXPECT_EQ(frame_line(result.out, 3)[3], frame_line(by_name.out, 2)[3]);
  }
}

TEST_F(FollowCommand, APatternAsRestPoseStandsAlone) {
  const ToolResult result = follow({"box_*.obj", "box_1.obj", "--balls", "balls.csv", "-q"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err,
              testing::HasSubstr("\"box_*.obj\" stands for several files, and the rest pose is one: a pattern "
                                 "is the only mesh, or comes after REST"));
}

TEST_F(FollowCommand, APatternAloneBeginsWithTheRestPose) {
  const ToolResult by_name = follow_box({"-o", "-", "-q"});
  ASSERT_EQ(by_name.exit_code, 0) << by_name.err;
  for (const char* pattern : {"box_%d.obj", "box_*.obj", "box_[0-2].obj"}) {
    const ToolResult result = follow({pattern, "--balls", "balls.csv", "-o", "-", "-q"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out, by_name.out) << pattern;
  }
  ASSERT_EQ(follow({"box_*.obj", "--balls", "balls.csv", "-q"}).exit_code, 0);
  EXPECT_THAT(folder_.names(), testing::Contains("box_0.follow.npz"));
  const ToolResult one = follow({"box_[0].obj", "--balls", "balls.csv"});
  EXPECT_EQ(one.exit_code, 2);
  EXPECT_THAT(one.err, HasSubstr("'box_[0].obj' stands for box_0.obj alone"));
  const ToolResult none = follow({"box_[7-9].obj", "--balls", "balls.csv"});
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_THAT(none.err, HasSubstr("box_[7-9].obj: there is no such file"));
}

TEST_F(FollowCommand, TheSameRunGivesTheSameBytes) {
  const ToolResult once = follow_box({"-o", "-", "-q", "--threads", "1"}), again = follow_box({"-o", "-", "-q"});
  EXPECT_EQ(once.exit_code, 0) << once.err;
  EXPECT_EQ(once.out, again.out);
}

TEST_F(FollowCommand, FromRestAFrameDoesNotDependOnThoseBefore) {
  const ToolResult both = follow_box({"-o", "-", "-q", "--from-rest"});
  const ToolResult last = follow({"box_0.obj", "box_2.obj", "--balls", "balls.csv", "-o", "-", "-q", "--from-rest"});
  ASSERT_EQ(both.exit_code, 0) << both.err;
  EXPECT_EQ(frame_line(both.out, 2)[4], frame_line(last.out, 1)[4]) << "the volume of the balls";
}

TEST_F(FollowCommand, BallsAreChosenAnew) {
  test::write_file(path("near.csv"), "x,y,z,radius\n0.5,0.5,0.5,0.5\n0.6,0.5,0.5,0.5\n0.7,0.5,0.5,0.5\n");
  const std::vector<std::string> plain = {"box_0.obj", "box_1.obj", "box_2.obj", "--balls", "near.csv", "--steps", "0"};
  const auto follow_near = [&](std::vector<std::string> more) {
    more.insert(more.begin(), plain.begin(), plain.end());
    return follow(std::move(more));
  };
  const ToolResult result =
      follow_near({"-o", "a.csv", "-o", "a.npz", "--renew", "1", "--renew-factor", "1", "--check"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("times a ball, in "));
  EXPECT_THAT(result.err, HasSubstr("at most 1 in one; beyond 1 times what is uncovered at rest"));
  const ToolResult without = follow_near({"-o", "-", "-q", "--renew", "0"});
  ASSERT_EQ(without.exit_code, 0) << without.err;
  EXPECT_THAT(without.out, testing::Not(HasSubstr("renewed")));
  const std::string table = read_file(path("a.csv"));
  EXPECT_THAT(table, HasSubstr("lost,renewed\n0,rest,"));
  EXPECT_EQ(frame_line(table, 0).back(), "0");
  EXPECT_EQ(frame_line(table, 1).back(), "1") << "three balls are near one end";
  EXPECT_GT(std::stod(frame_line(table, 1)[4]), std::stod(frame_line(without.out, 1)[4])) << "the volume of the balls";
  EXPECT_THAT(read_file(path("a.npz")), HasSubstr("origins.npy"));
}

TEST_F(FollowCommand, AnOpenMeshHasNoVolumeThatCouldGrow) {
  Mesh open = test::make_box({2, 1, 1});
  open.triangles.pop_back();
  test::write_file(path("open.obj"), test::to_obj(open));
  const ToolResult result = follow({"open.obj", "open.obj", "--balls", "balls.csv", "--renew", "1"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("--renew: open.obj is not closed"));
  EXPECT_EQ(follow({"open.obj", "open.obj", "--balls", "balls.csv", "--renew-factor", "2"}).exit_code, 2);
  EXPECT_EQ(follow({"open.obj", "open.obj", "--balls", "balls.csv"}).exit_code, 0);
}

TEST_F(FollowCommand, ThePublishedRuleReportsWhatMayBeOutside) {
  const ToolResult result = follow_box({"-o", "a.csv", "-o", "a.npz", "--rule", "published"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("outside   at most"));
  EXPECT_THAT(result.err, HasSubstr(" % by samples (standard error "));
  const std::string table = read_file(path("a.csv"));
  EXPECT_THAT(table, HasSubstr("outside_bound,outside_estimate,outside_error,gap_lower"));
  for (std::size_t frame = 0; frame < 3; ++frame) {
    const std::vector<std::string> numbers = frame_line(table, frame);
    const double bound = std::stod(numbers[6]), estimate = std::stod(numbers[7]), error = std::stod(numbers[8]);
    EXPECT_GT(error, 0) << frame;
    EXPECT_LE(estimate, bound + 4 * error) << frame;
  }
  EXPECT_EQ(follow_box({"-o", "again.csv", "-q", "--rule", "published"}).exit_code, 0);
  EXPECT_EQ(read_file(path("again.csv")), table);
  EXPECT_THAT(follow_box({"-o", "-", "-q"}).out, testing::Not(HasSubstr("outside_estimate")));
}

// An open mesh has no volume, and of balls that all are lost nothing is outside.
TEST_F(FollowCommand, ThePublishedRuleHasEstimatesOfClosedFramesAlone) {
  Mesh open = test::make_box({2, 1, 1}), flat = open;
  open.triangles.pop_back();
  for (Point& p : flat.vertices) p[2] = 0;
  test::write_file(path("open.obj"), test::to_obj(open));
  test::write_file(path("flat.obj"), test::to_obj(flat));
  const ToolResult of_open = follow({"open.obj", "open.obj", "--balls", "balls.csv", "--rule", "published", "-o", "-"});
  ASSERT_EQ(of_open.exit_code, 0) << of_open.err;
  EXPECT_EQ(frame_line(of_open.out, 1)[7], "");
  EXPECT_EQ(frame_line(of_open.out, 1)[8], "");
  const ToolResult of_flat =
      follow({"box_0.obj", "flat.obj", "--balls", "balls.csv", "--rule", "published", "-o", "-"});
  ASSERT_EQ(of_flat.exit_code, 0) << of_flat.err;
  EXPECT_EQ(frame_line(of_flat.out, 1)[7], "0");
  EXPECT_EQ(frame_line(of_flat.out, 1)[8], "0");
}

TEST_F(FollowCommand, FramesThatDifferAreNamed) {
  test::write_file(path("other.obj"), test::to_obj(test::make_sphere(1, 100)));
  const ToolResult other = follow({"box_0.obj", "other.obj", "--balls", "balls.csv"});
  EXPECT_EQ(other.exit_code, 3);
  EXPECT_THAT(other.err, HasSubstr("other.obj: "));
  EXPECT_THAT(other.err, HasSubstr("where box_0.obj has"));
  const ToolResult missing = follow({"box_0.obj", "no.obj", "--balls", "balls.csv"});
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_THAT(missing.err, HasSubstr("no.obj"));
  const ToolResult still = follow({"box_0.obj", "--balls", "balls.csv"});
  EXPECT_EQ(still.exit_code, 3);
  EXPECT_THAT(still.err, HasSubstr("it has no animation"));
  EXPECT_THAT(folder_.names(), testing::Not(testing::Contains("box_0.follow.npz"))) << "nothing is written";
}

TEST_F(FollowCommand, BallsThatAreNotInsideAreRefused) {
  test::write_file(path("large.csv"), "x,y,z,radius\n0.5,0.5,0.5,0.75\n");
  const ToolResult large = follow({"box_0.obj", "box_1.obj", "--balls", "large.csv"});
  EXPECT_EQ(large.exit_code, 2);
  EXPECT_THAT(large.err, HasSubstr("--balls large.csv: ball 0 is not inside the mesh"));
  const ToolResult none = follow({"box_0.obj", "box_1.obj", "--balls", "box_2.obj"});
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_THAT(none.err, HasSubstr("box_2.obj:1: the first line must name the columns"));
}

TEST_F(FollowCommand, NoFrameIsOverwritten) {
  const ToolResult result =
      follow({"box_0.obj", "box_*.obj", "--balls", "balls.csv", "-o", "a.npz", "--html", "box_2.html"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  test::write_file(path("f_1.glb"), test::skinned_animation().glb());
  test::write_file(path("f_2.glb"), test::skinned_animation().glb());
  const ToolResult over = follow({"f_1.glb", "f_*.glb", "--balls", "balls.csv", "-o", "f_2.glb"});
  EXPECT_EQ(over.exit_code, 2);
  EXPECT_THAT(over.err, HasSubstr("--output would overwrite the input f_2.glb"));
}

TEST_F(FollowCommand, CrossingFacesHaveNoVolume) {
  Mesh both = test::make_box({2, 1, 1}), second = test::make_box({1, 0.5, 0.5});
  test::translate(second, {1.5, 0.25, 0.25});
  const auto first = static_cast<std::uint32_t>(both.vertices.size());
  both.vertices.insert(both.vertices.end(), second.vertices.begin(), second.vertices.end());
  for (const Triangle& t : second.triangles) both.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  test::write_file(path("both.obj"), test::to_obj(both));
  test::write_file(path("one.csv"), "x,y,z,radius\n0.5,0.5,0.5,0.5\n");
  const ToolResult result = follow({"both.obj", "both.obj", "--balls", "one.csv", "-o", "-"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("no volume is known"));
  EXPECT_EQ(frame_line(result.out, 1)[3], "");
}

// A mirrored solid has the volume of the solid. That of a flat or a folded frame does not follow from its triangles:
// where the parts of a folded ball overlap, their winding numbers cancel, and so do the halves of a bow.
TEST_F(FollowCommand, FramesWithoutAKnownVolumeSayNoShare) {
  const Mesh ball = test::make_sphere(1, 300);
  const auto write = [&](const char* name, const std::function<Point(const Point&)>& place) {
    Mesh moved = ball;
    for (Point& p : moved.vertices) p = place(p);
    test::write_file(path(name), test::to_obj(moved));
  };
  write("rest.obj", [](const Point& p) { return p; });
  write("mirrored.obj", [](const Point& p) { return Point{-p[0], p[1], p[2]}; });
  write("inverted.obj", [](const Point& p) { return Point{-p[0], -p[1], -p[2]}; });
  write("folded.obj", [](const Point& p) { return Point{std::fabs(p[0] - 0.2), p[1], p[2] + 0.5 * p[0]}; });
  write("bow.obj", [](const Point& p) { return Point{p[0], (p[0] - 0.2) * p[1], p[2]}; });
  write("flat.obj", [](const Point& p) { return Point{p[0], p[1], 0.1 * p[0] + 0.3 * p[1]}; });
  test::write_file(path("cover.csv"), "x,y,z,radius\n0,0,0,1.01\n");
  test::write_file(path("inside.csv"), "x,y,z,radius\n0,0,0,0.9\n0.5,0,0,0.25\n-0.5,0,0,0.25\n");
  const auto run_on = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"rest.obj", "mirrored.obj", "inverted.obj", "folded.obj", "bow.obj", "flat.obj", "-o",
                               "a.csv", "-o", "a.npz", "--html", "a.html", "--picture", "a.png"});
    return follow(std::move(more));
  };
  for (const std::vector<std::string>& contract : {std::vector<std::string>{"--balls", "inside.csv"},
                                                   {"--balls", "inside.csv", "--rule", "published"},
                                                   {"--balls", "cover.csv", "--contract", "cover"}}) {
    const ToolResult result = run_on(contract);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("; 3 frames have no known volume\n"));
    EXPECT_THAT(result.err, HasSubstr("no volume is known of a frame that is flat, or whose faces cross"));
    EXPECT_THAT(result.err, HasSubstr("2 frames are mirrored: their inside is that of the mesh turned inside out"));
    const std::string table = read_file(path("a.csv"));
    for (const std::size_t known : {0u, 1u, 2u}) {
      EXPECT_NEAR(std::stod(frame_line(table, known)[3]), test::signed_volume(ball), 1e-12) << known;
      EXPECT_GT(std::stod(frame_line(table, known)[5]), 0) << "share of " << known;
    }
    for (const std::size_t unknown : {3u, 4u, 5u}) {
      EXPECT_EQ(frame_line(table, unknown)[3], "") << "solid_volume of " << unknown;
      EXPECT_EQ(frame_line(table, unknown)[5], "") << "share of " << unknown;
    }
  }
}

TEST_F(FollowCommand, AnOpenMeshWithoutBallsInsideIsRefused) {
  Mesh open = test::make_box({2, 1, 1});
  open.triangles.resize(2);
  test::write_file(path("open.obj"), test::to_obj(open));
  const ToolResult result = follow({"open.obj", "open.obj", "--balls", "balls.csv"});
  EXPECT_THAT(result.exit_code, testing::AnyOf(2, 3)) << result.err;
  EXPECT_THAT(folder_.names(), testing::Not(testing::Contains("open.follow.npz")));
}

TEST_F(FollowCommand, NamesMayHoldAnyBytes) {
  const std::string name = "n\xff.obj";
  test::write_file(path(name), test::to_obj(test::make_box({2, 1, 1})));
  const ToolResult result = follow({name, "box_1.obj", "--balls", "balls.csv", "-o", "n.glb", "-q"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::string scene = "n\xff.glb";
  test::write_file(path(scene), test::skinned_animation().glb());
  test::write_file(path("ball.csv"), "x,y,z,radius\n5.25,0.25,0.25,0.125\n");
  for (const char* const rig : {"rig.glb", "rig.gltf", "rig.json"}) {
    const ToolResult rigged = follow({scene, "--balls", "ball.csv", "--fps", "4", "--rig", rig, "-o", "n.npz", "-q"});
    EXPECT_EQ(rigged.exit_code, 0) << rigged.err;
  }
}

TEST_F(FollowCommand, VerticesThatPartMoveAsTheFirst) {
  // The corner at the origin, twice; its copy moves alone.
  std::string rest = test::to_obj(test::make_box({2, 1, 1})), moved = rest;
  const std::size_t first_line = rest.find("v ");
  const std::string corner = rest.substr(first_line, rest.find('\n', first_line) - first_line + 1);
  rest.insert(first_line, corner);
  moved.insert(first_line, "v -0.25 0 0\n");
  const auto shifted = [](const std::string& text) {
    std::istringstream in(text);
    std::string out, line;
    while (std::getline(in, line)) {
      std::istringstream words(line);
      std::string kind;
      words >> kind;
      if (kind != "f") {
        out += line + "\n";
        continue;
      }
      out += "f";
      for (std::size_t i; words >> i;) out += " " + std::to_string(i + 1);
      out += "\n";
    }
    return out;
  };
  test::write_file(path("rest.obj"), shifted(rest) + "f 1 3 2\n");
  test::write_file(path("moved.obj"), shifted(moved) + "f 1 3 2\n");
  const ToolResult result = follow({"rest.obj", "moved.obj", "--balls", "balls.csv"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("up to 0.25 apart in a frame"));
}

TEST_F(FollowCommand, AnimationsAreFollowedAndRigged) {
  test::write_file(path("bow.glb"), test::skinned_animation().glb());
  test::write_file(path("ball.csv"), "x,y,z,radius\n5.25,0.25,0.25,0.125\n");
  const ToolResult result = follow({"bow.glb", "--balls", "ball.csv", "--fps", "4", "-o", "bow.csv", "-o", "bow.npz",
                                    "--rig", "bow.json", "--html", "bow.html", "--check"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("5 frames")) << "at 0, 1/4 ... 1";
  EXPECT_EQ(frame_line(read_file(path("bow.csv")), 5)[2], "1.25") << "the last frame follows the rest pose after five";
  const auto rig = nlohmann::json::parse(read_file(path("bow.json")));
  EXPECT_EQ(rig["frames"], 6) << "with the rest pose";
  ASSERT_EQ(rig["joints"].size(), 2u);
  EXPECT_EQ(rig["joints"][1]["name"], "tip");
  ASSERT_EQ(rig["balls"].size(), 1u);
  EXPECT_GT(rig["balls"][0]["radius"], 0);
  EXPECT_LE(rig["balls"][0]["radius"], rig["balls"][0]["rest_radius"]);
  EXPECT_THAT(read_file(path("bow.html")), HasSubstr("bow.glb"));
  const ToolResult other = follow({"bow.glb", "--balls", "ball.csv", "--animation", "jump"});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, HasSubstr("bow")) << "the animations that there are";
}

TEST_F(FollowCommand, HelpNeedsNoMesh) {
  const ToolResult help = follow({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, StartsWith("medial-vk follow moves balls"));
  const ToolResult nothing = follow({});
  EXPECT_EQ(nothing.exit_code, 2);
  EXPECT_THAT(nothing.err, HasSubstr("Try medial-vk follow --help."));
}

}  // namespace
}  // namespace medial_vk
