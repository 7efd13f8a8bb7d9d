// `medial-vk follow --contract cover` from outside: every output, what is refused, and that written balls cover every
// frame by the reference. Most balls come from a table, so that no device is needed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "input/read_mesh.h"
#include "medial_vk/prepare.h"
#include "medial_vk/sphere_proofs.h"
#include "output/numpy_files/npz_reader.h"
#include "reference_bridge/check_balls.h"
#include "support/indexed.h"
#include "support/solids/mesh_files.h"
#include "support/solids/motions.h"
#include "support/solids/solids.h"
#include "tool_test.h"
#include "unit/motion_files/animations.h"

namespace medial_vk {
namespace {

using test::read_file;
using test::ToolResult;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

constexpr const char* kCoverColumns =
    "frame,name,time,solid_volume,ball_volume,added_percent,reach_out_bound,proved,steady,grown,unused\n";

/// The words of the lines of a table, without the first line.
std::vector<std::vector<std::string>> cover_table(const std::string& table) {
  std::istringstream text(table);
  std::vector<std::vector<std::string>> lines;
  std::string line;
  for (std::getline(text, line); std::getline(text, line);) {
    std::istringstream in(line);
    std::vector<std::string>& words = lines.emplace_back();
    for (std::string word; std::getline(in, word, ',');) words.push_back(word);
  }
  return lines;
}

/// The balls of all frames of a .npz, without those of radius 0.
std::vector<std::vector<Ball>> balls_of_frames(const std::string& bytes) {
  const auto arrays = read_npz(bytes, "motion").value();
  const NpyArray& array = arrays.at("balls");
  std::vector<double> numbers(array.bytes.size() / sizeof(double));
  std::memcpy(numbers.data(), array.bytes.data(), array.bytes.size());
  std::vector<std::vector<Ball>> frames(array.shape.at(0));
  for (std::size_t i = 0; i < array.shape[0] * array.shape.at(1); ++i) {
    const double* const n = &numbers[4 * i];
    if (n[3] > 0) frames[i / array.shape[1]].push_back({{n[0], n[1], n[2]}, n[3]});
  }
  return frames;
}

/// A box of sides 2, 1 and 1 at rest in two balls, and frames that stretch it to 3 and 4.
class FollowCovers : public test::ToolTest {
 protected:
  FollowCovers() {
    for (int i = 0; i <= 2; ++i) write_mesh("box_" + std::to_string(i) + ".obj", test::make_box({2.0 + i, 1, 1}));
    test::write_file(path("balls.csv"), "x,y,z,radius\n0.5,0.5,0.5,0.875\n1.5,0.5,0.5,0.875\n");
  }

  void write_mesh(const std::string& name, const Mesh& mesh) const { test::write_file(path(name), test::to_obj(mesh)); }
  PreparedMesh prepared(const std::string& name) const { return prepare_mesh(read_mesh(path(name)).value()).value(); }

  ToolResult follow(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"follow", "--contract", "cover"});
    return run(std::move(arguments));
  }
  ToolResult follow_box(std::vector<std::string> more) const {
    std::vector<std::string> arguments = {"box_0.obj", "box_1.obj", "box_2.obj", "--balls", "balls.csv"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return follow(std::move(arguments));
  }
};

TEST_F(FollowCovers, WriteEveryFormat) {
  const ToolResult result = follow_box({"-o", "a.npz", "-o", "a.glb", "-o", "a.csv", "--picture", "a.png", "--check"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("box_0.obj: 12 triangles, closed; 2 frames"));
  EXPECT_THAT(result.err, HasSubstr("proved    the balls cover the solid in every frame\n"));
  EXPECT_THAT(result.err, HasSubstr("reach out by at most "));
  EXPECT_THAT(result.out, HasSubstr("the balls cover every triangle"));
  EXPECT_THAT(result.out, HasSubstr("no cavity"));
  const std::string table = read_file(path("a.csv"));
  EXPECT_THAT(table, StartsWith(kCoverColumns));
  const auto lines = cover_table(table);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0][1], "rest");
  EXPECT_EQ(lines[2][1], "box_2.obj");
  for (std::size_t i = 0; i < 3; ++i) {
    const double solid = std::stod(lines[i][3]), balls = std::stod(lines[i][4]);
    EXPECT_NEAR(solid, 2.0 + static_cast<double>(i), 1e-12);
    EXPECT_NEAR(std::stod(lines[i][5]), 100 * (balls - solid) / solid, 1e-9);
    EXPECT_EQ(lines[i][7], "solid");
    EXPECT_EQ(std::stoi(lines[i][8]) + std::stoi(lines[i][9]) + std::stoi(lines[i][10]), 2);
  }
  // At rest a ball holds half of the box: it has at least the radius sqrt(3) / 2, and reaches out by less than 1 / 2.
  EXPECT_GE(std::stod(lines[0][6]), std::sqrt(3.0) / 2 - 0.5);
  EXPECT_LT(std::stod(lines[0][6]), 0.5);
  EXPECT_EQ(lines[2][9], "2") << "halves of a box that is twice as long need balls of 1.4 times the radius";
  EXPECT_THAT(read_file(path("a.npz")), StartsWith("PK"));
  EXPECT_THAT(read_file(path("a.glb")), StartsWith("glTF"));
  EXPECT_THAT(read_file(path("a.png")), StartsWith("\x89PNG"));
}

TEST_F(FollowCovers, HaveAPage) {
  const ToolResult result = follow_box({"-q", "--html", "a.html"});
  if (result.exit_code == 2) GTEST_SKIP() << result.err;  // a build without npm
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, IsEmpty());
  EXPECT_THAT(read_file(path("a.html")), HasSubstr("\"rule\":\"cover\""));
  EXPECT_THAT(read_file(path("box_0.follow.npz")), StartsWith("PK")) << "without an output the arrays are written here";
}

TEST_F(FollowCovers, GrownBallsAreCountedAsChosen) {
  const ToolResult many = follow_box({"-q", "-o", "-", "--grown", "1"});
  const ToolResult none = follow_box({"-q", "-o", "-", "--grown", "10"});
  ASSERT_EQ(many.exit_code, 0) << many.err;
  EXPECT_EQ(cover_table(many.out)[0][9], "0") << "at rest none has grown";
  EXPECT_EQ(cover_table(many.out)[2][9], "2");
  EXPECT_EQ(cover_table(none.out)[2][9], "0");
}

TEST_F(FollowCovers, TheSameRunGivesTheSameBytes) {
  for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--tighten"}, {"--steps", "3"}}) {
    const auto with = [&](std::vector<std::string> others) {
      others.insert(others.end(), more.begin(), more.end());
      return follow_box(std::move(others));
    };
    const ToolResult once = with({"-o", "-", "-q", "--threads", "1"}), again = with({"-o", "-", "-q"});
    EXPECT_EQ(once.exit_code, 0) << once.err;
    EXPECT_EQ(once.out, again.out);
  }
}

TEST_F(FollowCovers, AFrameDoesNotDependOnThoseBefore) {
  const ToolResult both = follow_box({"-o", "-", "-q"});
  const ToolResult last = follow({"box_0.obj", "box_2.obj", "--balls", "balls.csv", "-o", "-", "-q"});
  ASSERT_EQ(both.exit_code, 0) << both.err;
  EXPECT_EQ(cover_table(both.out)[2][4], cover_table(last.out)[1][4]) << "the volume of the balls";
}

TEST_F(FollowCovers, BallsOfABodyAreThoseThatCover) {
  const ToolResult body = run_cpu({"spheres", "box_0.obj", "--contract", "both", "--count", "4", "-o", "box.npz"});
  ASSERT_EQ(body.exit_code, 0) << body.err;
  const ToolResult result = follow({"box_0.obj", "box_1.obj", "--balls", "box.npz", "-o", "-", "--check"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(FollowCovers, AreFittedToTheRestPose) {
  const ToolResult result = follow(
      {"box_0.obj", "box_1.obj", "--count", "4", "--backend", "cpu", "--resolution", "6", "-o", "a.npz", "--check"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  // A cover may be better with fewer balls than are allowed.
  EXPECT_THAT(result.err, testing::ContainsRegex("balls     [1-4]\n"));
  EXPECT_THAT(result.err, HasSubstr("the balls cover the solid in every frame"));
}

TEST_F(FollowCovers, AFileThatDoesNotCoverIsRefused) {
  test::write_file(path("small.csv"), "x,y,z,radius\n0.5,0.5,0.5,0.8\n1.5,0.5,0.5,0.875\n");
  const ToolResult small = follow({"box_0.obj", "box_1.obj", "--balls", "small.csv"});
  EXPECT_EQ(small.exit_code, 2);
  EXPECT_THAT(small.err, HasSubstr("--balls small.csv: the balls do not cover box_0.obj: "));
  EXPECT_THAT(small.err, HasSubstr(" of 12 triangles are not covered by them, the first at ("));
  EXPECT_THAT(folder_.names(), Not(testing::Contains("box_0.follow.npz"))) << "nothing is written";
  // Balls around small cells at the boundary, which leave the middle of a large box out.
  std::string shell = "x,y,z,radius\n";
  for (int i = 0; i < 8 * 8 * 8; ++i) {
    const std::array<int, 3> at = {i % 8, i / 8 % 8, i / 64};
    if (std::ranges::none_of(at, [](int k) { return k == 0 || k == 7; })) continue;
    for (const int k : at) shell += std::to_string(0.5 + k) + ",";
    shell += "0.875\n";
  }
  test::write_file(path("shell.csv"), shell);
  write_mesh("large.obj", test::make_box({8, 8, 8}));
  const ToolResult cavity = follow({"large.obj", "large.obj", "--balls", "shell.csv"});
  EXPECT_EQ(cavity.exit_code, 2);
  EXPECT_THAT(cavity.err, HasSubstr("--balls shell.csv: the balls do not cover large.obj: they leave a cavity"));
}

TEST_F(FollowCovers, AFileWithNumbersOutOfRangeIsRefused) {
  test::write_file(path("far.csv"), "x,y,z,radius\n0.5,0.5,0.5,4\n1e19,0,0,1\n");
  const ToolResult far = follow({"box_0.obj", "box_1.obj", "--balls", "far.csv"});
  EXPECT_EQ(far.exit_code, 3);
  EXPECT_THAT(far.err, HasSubstr("far.csv:3: there is a number beyond 1e+18"));
}

TEST_F(FollowCovers, StepsAndDivisionsNeverMakeThemLarger) {
  const auto volumes = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"-q", "-o", "-"});
    const ToolResult result = follow_box(std::move(more));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    std::vector<double> found;
    for (const auto& line : cover_table(result.out)) found.push_back(std::stod(line.at(4)));
    EXPECT_EQ(found.size(), 3u);
    return found;
  };
  const std::vector<double> none = volumes({"--steps", "0"}), steps = volumes({"--steps", "4"});
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LE(steps[i], none[i]) << i;
  EXPECT_LT(steps[2], none[2]);
  EXPECT_LE(volumes({"--steps", "0", "--tighten"})[0], none[0]) << "the rest pose, which is divided anew, too";
}

TEST_F(FollowCovers, OptionsOfBallsInsideAreRefused) {
  const ToolResult rig = follow_box({"--renew", "3"});
  EXPECT_EQ(rig.exit_code, 2);
  EXPECT_THAT(rig.err, HasSubstr("--renew is about balls inside; it cannot be used with --contract cover"));
  EXPECT_THAT(rig.err, HasSubstr("Try medial-vk follow --help."));
}

TEST_F(FollowCovers, OfAnOpenMeshHoldItsSurface) {
  Mesh open = test::make_box({2, 1, 1});
  open.triangles.pop_back();
  write_mesh("open.obj", open);
  const ToolResult result = follow({"open.obj", "open.obj", "--balls", "balls.csv", "-o", "-"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("proved    the balls cover the surface, which is not closed, in every frame"));
  const std::vector<std::string> rest = cover_table(result.out)[0];
  EXPECT_EQ(rest[3], "") << "no volume";
  EXPECT_EQ(rest[6], "") << "no solid to reach out of";
  EXPECT_EQ(rest[7], "surface");
  const ToolResult check = follow({"open.obj", "open.obj", "--balls", "balls.csv", "-o", "a.npz", "--check"});
  EXPECT_EQ(check.exit_code, 7) << "the contract is about a solid";
  EXPECT_THAT(check.out, HasSubstr("the mesh is closed"));
}

TEST_F(FollowCovers, FollowAnAnimation) {
  test::write_file(path("bow.glb"), test::skinned_animation().glb());
  const ToolResult result = follow(
      {"bow.glb", "--count", "3", "--backend", "cpu", "--resolution", "6", "--fps", "4", "-o", "bow.csv", "--check"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("the balls cover the solid in every frame"));
}

/// The check of the tool is that of the reference. Each corner of the box is at the distance of the radius from the
/// middle of its half, and in no other ball: balls that are a millionth smaller do not pass.
TEST_F(FollowCovers, ThatAreTooSmallAreFoundByTheCheck) {
  const ToolResult result = follow_box({"--steps", "0", "-q", "-o", "a.npz"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::vector<std::vector<Ball>> frames = balls_of_frames(read_file(path("a.npz")));
  ASSERT_EQ(frames.size(), 3u);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const PreparedMesh mesh = prepared("box_" + std::to_string(i) + ".obj");
    std::vector<Ball> balls = frames[i];
    EXPECT_TRUE(check_balls_cover(mesh, balls).passed());
    for (Ball& ball : balls) ball.radius *= 1 - 1e-6;
    const CheckReport report = check_balls_cover(mesh, balls);
    EXPECT_FALSE(report.passed());
    EXPECT_THAT(report.lines.at(1).first_failure, HasSubstr("triangle")) << report.lines[1].condition;
  }
}

/// Motions of a torus, among them one that ends as the mirror image, with balls around the middles of its rings.
class FollowCoversOfMotions : public FollowCovers {
 protected:
  FollowCoversOfMotions() {
    constexpr std::uint32_t kOfARing = 12, kRings = 24;
    const Mesh torus = test::make_turned_torus(kOfARing, kRings);
    write_mesh("rest.obj", torus);
    // The tube has the radius 0.4, and its outermost points between two middles are 0.45 from both.
    std::string text = "x,y,z,radius\n";
    for (std::uint32_t ring = 0; ring < kRings; ++ring) {
      Point middle = {0, 0, 0};
      for (std::uint32_t i = 0; i < kOfARing; ++i) {
        for (std::size_t k = 0; k < 3; ++k) middle[k] += torus.vertices[ring * kOfARing + i][k] / kOfARing;
      }
      for (const double x : middle) text += std::to_string(x) + ",";
      text += "0.5\n";
    }
    test::write_file(path("rings.csv"), text);
  }

  /// Frames of all motions; the last one is mirrored. Returns their names.
  std::vector<std::string> write_frames() const {
    std::vector<std::string> names;
    const Mesh rest = read_mesh(path("rest.obj")).value();
    const auto add = [&](const std::vector<Point>& vertices) {
      Mesh frame = rest;
      frame.vertices = vertices;
      names.push_back("frame_" + std::to_string(names.size()) + ".obj");
      write_mesh(names.back(), frame);
    };
    for (const test::Motion motion : test::kMotions) {
      for (const double time : {0.5, 1.0}) add(test::moved_vertices(rest.vertices, motion, time));
    }
    std::vector<Point> mirrored = rest.vertices;
    for (Point& p : mirrored) p[0] = -p[0];
    add(mirrored);
    return names;
  }
};

TEST_F(FollowCoversOfMotions, AreProvedFromTheFilesAlone) {
  const std::vector<std::string> frames = write_frames();
  for (const char* const more : {"--check", "--tighten"}) {
    std::vector<std::string> arguments = {"rest.obj"};
    arguments.insert(arguments.end(), frames.begin(), frames.end());
    arguments.insert(arguments.end(), {"--balls", "rings.csv", "-o", "a.npz", more});
    const ToolResult result = follow(arguments);
    ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
    EXPECT_THAT(result.err, HasSubstr("the balls cover the solid in every frame"));
    const std::vector<std::vector<Ball>> balls = balls_of_frames(read_file(path("a.npz")));
    ASSERT_EQ(balls.size(), frames.size() + 1);
    for (std::size_t i = 0; i < balls.size(); ++i) {
      const std::string name = i == 0 ? "rest.obj" : frames[i - 1];
      const IndexedMesh mesh = test::indexed(prepared(name));
      EXPECT_TRUE(prove_spheres(mesh, {}, balls[i]).value().cover.proved()) << name;
    }
  }
}

}  // namespace
}  // namespace medial_vk
