// `medial-vk spheres --frames` from outside: what it says of its spheres is what `medial-vk follow` finds, and they are
// better than those of the fit at rest. On the CPU, with few candidates.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <regex>
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
using testing::HasSubstr;
using testing::Not;

/// A box of sides 2, 1 and 1 whose far end shrinks to a fifth in two frames.
class MotionFitCommand : public test::ToolTest {
 protected:
  MotionFitCommand() {
    for (int i = 0; i <= 2; ++i) {
      Mesh box = test::make_box({2, 1, 1});
      for (Point& p : box.vertices) {
        if (p[0] < 1) continue;
        for (std::size_t k = 1; k < 3; ++k) p[k] = 0.5 + (p[k] - 0.5) * (1 - 0.4 * i);
      }
      test::write_file(path("box_" + std::to_string(i) + ".obj"), test::to_obj(box));
    }
  }

  ToolResult fit(std::vector<std::string> more) const {
    std::vector<std::string> arguments = {"spheres", "--backend", "cpu", "--resolution", "20"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(std::move(arguments));
  }

  /// The mean of the column of uncovered shares that `medial-vk follow` measures, and the greatest.
  std::pair<double, double> followed(const std::string& balls) const {
    const ToolResult result = run({"follow", "box_0.obj", "box_1.obj", "box_2.obj", "--balls", balls, "--steps", "0",
                                   "--renew", "0", "-q", "-o", "-"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    std::istringstream lines(result.out);
    std::string line;
    std::getline(lines, line);
    double sum = 0, most = 0;
    int count = 0;
    while (std::getline(lines, line)) {
      std::istringstream words(line);
      std::string word;
      for (int i = 0; i < 6; ++i) std::getline(words, word, ',');
      sum += std::stod(word);
      most = std::max(most, std::stod(word));
      ++count;
    }
    EXPECT_EQ(count, 3);
    return {sum / count, most};
  }
};

/// The mean and the greatest share, in per cent, of the line that begins with the words.
std::pair<double, double> shares_in(const std::string& text, const std::string& words) {
  std::smatch found;
  const std::regex line(words + R"(\s+(?:[a-z ]*?)([0-9.]+) % of the solid on average, ([0-9.]+) % at most)");
  EXPECT_TRUE(std::regex_search(text, found, line)) << text;
  return found.empty() ? std::pair(0.0, 0.0) : std::pair(std::stod(found[1]), std::stod(found[2]));
}

TEST_F(MotionFitCommand, BeatsTheFitAtRestInAllFrames) {
  const ToolResult result =
      fit({"box_0.obj", "--count", "6", "--frames", "box_1.obj", "box_2.obj", "-o", "best.csv", "--check"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("2 frames"));
  ASSERT_EQ(fit({"box_0.obj", "--count", "6", "-o", "plain.csv"}).exit_code, 0);
  const auto best = shares_in(result.err, "uncovered"), rest = shares_in(result.err, "at rest");
  const auto best_followed = followed("best.csv"), rest_followed = followed("plain.csv");
  // Messages have two digits after the point.
  EXPECT_NEAR(best.first, best_followed.first, 0.006);
  EXPECT_NEAR(best.second, best_followed.second, 0.006);
  EXPECT_NEAR(rest.first, rest_followed.first, 0.006);
  EXPECT_NEAR(rest.second, rest_followed.second, 0.006);
  EXPECT_LT(best_followed.first, rest_followed.first);
  // A pattern gives the same frames: box_0 is no frame of its own.
  ASSERT_EQ(fit({"box_0.obj", "--count", "6", "-q", "--frames", "box_[12]*.obj", "-o", "again.csv"}).exit_code, 0);
  EXPECT_EQ(read_file(path("again.csv")), read_file(path("best.csv")));
}

TEST_F(MotionFitCommand, FollowsAnAnimation) {
  test::write_file(path("bow.glb"), test::skinned_animation(0.3).glb());
  const ToolResult result = fit({"bow.glb", "--count", "4", "--frames", "./bow.glb", "--animation", "bow"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("31 frames"));
  EXPECT_THAT(result.err, HasSubstr("bow.spheres.csv"));
  EXPECT_EQ(std::ranges::count(read_file(path("bow.spheres.csv")), '\n'), 5);
  const std::string spheres = read_file(path("bow.spheres.csv"));
  const ToolResult alone = fit({"bow.glb", "--count", "4", "--frames", "--animation", "bow"});
  ASSERT_EQ(alone.exit_code, 0) << alone.err;
  EXPECT_EQ(read_file(path("bow.spheres.csv")), spheres) << "without a file, --frames stands for bow.glb";
  const ToolResult none = fit({"bow.glb", "--count", "4", "--frames", "bow.glb", "--animation", "jump"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, HasSubstr("bow"));
}

// The note is that of `medial-vk follow`.
TEST_F(MotionFitCommand, FramesWithoutAVolumeAreCounted) {
  Mesh flat = test::make_box({2, 1, 1});
  for (Point& p : flat.vertices) p[2] = 0;
  for (const char* name : {"flat_0.obj", "flat_1.obj"}) test::write_file(path(name), test::to_obj(flat));
  const ToolResult one = fit({"box_0.obj", "--count", "4", "--frames", "box_1.obj", "flat_0.obj"});
  ASSERT_EQ(one.exit_code, 0) << one.err;
  EXPECT_THAT(one.err, HasSubstr("; 1 frame has no known volume\n"));
  const ToolResult two = fit({"box_0.obj", "--count", "4", "--frames", "flat_0.obj", "box_1.obj", "flat_1.obj"});
  ASSERT_EQ(two.exit_code, 0) << two.err;
  EXPECT_THAT(two.err, HasSubstr("; 2 frames have no known volume\n"));
  const ToolResult followed = run({"follow", "box_0.obj", "flat_0.obj", "--balls", "box_0.spheres.csv"});
  ASSERT_EQ(followed.exit_code, 0) << followed.err;
  EXPECT_THAT(followed.err, HasSubstr("; 1 frame has no known volume\n"));
}

// The far half of the box is turned over: its volume is taken from that of the near half.
TEST_F(MotionFitCommand, FramesWhoseFacesCrossAreLeftOut) {
  Mesh crossed = test::make_box({2, 1, 1});
  for (Point& p : crossed.vertices) {
    if (p[0] > 1) p[1] = 1.25 - 1.5 * p[1];
  }
  test::write_file(path("crossed.obj"), test::to_obj(crossed));
  const ToolResult result = fit({"box_0.obj", "--count", "4", "--frames", "box_1.obj", "crossed.obj"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(shares_in(result.err, "uncovered"),
            shares_in(fit({"box_0.obj", "--count", "4", "--frames", "box_1.obj"}).err, "uncovered"));
  EXPECT_THAT(result.err, HasSubstr("; 1 frame has no known volume\n"));
}

// The line with the mesh and the number of frames comes before the fit.
TEST_F(MotionFitCommand, BrokenFramesAreFoundBeforeTheFit) {
  Mesh broken = test::make_box({2, 1, 1});
  broken.vertices.back()[1] = 1e19;
  test::write_file(path("far.obj"), test::to_obj(broken));
  const auto fails = [&](const std::string& mesh, const std::string& frame, const std::string& why) {
    const ToolResult result = fit({mesh, "--count", "6", "--frames", "box_1.obj", frame});
    EXPECT_EQ(result.exit_code, 3) << result.err;
    EXPECT_THAT(result.err, HasSubstr(why));
    EXPECT_THAT(result.err, Not(HasSubstr("2 frames")));
  };
  fails("box_0.obj", "far.obj", "far.obj: a coordinate is beyond 1e+18");
  fails("far.obj", "box_2.obj", "far.obj: a coordinate is beyond 1e+18");
  std::string text = test::to_obj(test::make_box({2, 1, 1}));
  text.replace(text.find("v ") + 2, 1, "nan");
  test::write_file(path("nan.obj"), text);
  fails("box_0.obj", "nan.obj", "nan.obj");
}

TEST_F(MotionFitCommand, ErrorsWriteNothing) {
  const auto fails = [&](std::vector<std::string> more, int code, const std::string& why) {
    const ToolResult result = fit(std::move(more));
    EXPECT_EQ(result.exit_code, code) << result.err;
    EXPECT_THAT(result.err, HasSubstr(why));
  };
  fails({"box_0.obj", "--count", "6", "--frames", "none.obj"}, 3, "none.obj");
  fails({"box_0.obj", "--count", "6", "--frames", "none_*.obj"}, 3, "none_");
  Mesh open = test::make_box({2, 1, 1});
  open.triangles.pop_back();
  test::write_file(path("open.obj"), test::to_obj(open));
  fails({"open.obj", "--count", "6", "--frames", "box_1.obj"}, 3, "without a volume");
  Mesh other = test::make_box({2, 1, 1});
  std::swap(other.triangles[0], other.triangles[1]);
  other.triangles.pop_back();
  test::write_file(path("other.obj"), test::to_obj(other));
  fails({"box_0.obj", "--count", "6", "--frames", "other.obj"}, 3, "other.obj");
  for (const std::string& name : folder_.names()) EXPECT_THAT(name, Not(HasSubstr("spheres")));
}

}  // namespace
}  // namespace medial_vk
