// `medial-vk distance` with body files from outside: answers by balls, files that are refused, pictures and pages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "body_files/body_file.h"
#include "support/solids/mesh_files.h"
#include "support/solids/solids.h"
#include "tool_test.h"

namespace medial_vk {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// A unit box with a ball in it, and one around it.
class BodyFiles : public test::ToolTest {
 protected:
  BodyFiles() {
    body_.version = "0";
    body_.mesh = test::make_box({1, 1, 1});
    body_.inside = {{{0.5, 0.5, 0.5}, 0.49}};
    body_.cover = {{{0.5, 0.5, 0.5}, 0.88}};
    write("box.npz", body_);
    test::write_file(path("box.obj"), test::to_obj(body_.mesh));
    test::write_file(path("poses.csv"), "x,y,z\n3,0,0\n1.2,0,0\n0.5,0,0\n");
  }
  void write(const char* name, const BodyFile& body) const {
    test::write_file(path(name), encode_body_file(body).value());
  }
  test::ToolResult distance(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "distance");
    return run(std::move(arguments));
  }

  BodyFile body_;
};

TEST_F(BodyFiles, AnswerByBallsAlone) {
  const test::ToolResult result = distance({"box.npz", "box.npz", "--poses", "poses.csv", "--balls", "--check"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, StartsWith("lower,upper,state,ax,ay,az,bx,by,bz\n"));
  EXPECT_THAT(result.out, HasSubstr(",free,"));
  EXPECT_THAT(result.out, HasSubstr(",undecided,"));
  EXPECT_THAT(result.err, HasSubstr("1 inside and 1 that cover it, proved again"));
  // Points of the spheres around the middles of the boxes, on the line between them; of a hit one that both balls hold.
  std::vector<std::vector<std::string>> lines;
  std::istringstream text(result.out);
  for (std::string line; std::getline(text, line);) {
    std::istringstream in(line);
    lines.emplace_back();
    for (std::string word; std::getline(in, word, ',');) lines.back().push_back(word);
    ASSERT_EQ(lines.back().size(), 9u) << line;
  }
  ASSERT_EQ(lines.size(), 4u);
  constexpr double kRounding = 1e-15;  // some roundings of numbers below 4
  for (std::size_t i = 1; i < 4; ++i) {
    for (const std::size_t k : {4u, 5u, 7u, 8u}) EXPECT_NEAR(std::stod(lines[i][k]), 0.5, kRounding);
  }
  for (const auto& [line, x] : {std::pair(1, 3.0), {2, 1.2}}) {
    EXPECT_NEAR(std::stod(lines[line][3]), 0.99, kRounding);
    EXPECT_NEAR(std::stod(lines[line][6]), x + 0.01, kRounding);
  }
  EXPECT_EQ(lines[3][3], lines[3][6]);
  EXPECT_GE(std::stod(lines[3][3]), 0.51);
  EXPECT_LE(std::stod(lines[3][3]), 0.99);
}

/// There is no upper end, and no point that would prove one.
TEST_F(BodyFiles, WithoutBallsInsideThereAreNoPoints) {
  body_.inside.clear();
  write("cover.npz", body_);
  test::write_file(path("pose.csv"), "x,y,z\n3,0,0\n");
  const test::ToolResult result =
      distance({"cover.npz", "box.npz", "--balls", "--poses", "pose.csv", "--check", "-o", "d.csv"});
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  EXPECT_THAT(test::read_file(path("d.csv")), testing::EndsWith(",inf,free,nan,nan,nan,nan,nan,nan\n"));
}

TEST_F(BodyFiles, OfOnePoseNameTheBallsThatDecide) {
  body_.inside.insert(body_.inside.begin(), {{0.1, 0.5, 0.5}, 0.05});
  write("two.npz", body_);
  test::write_file(path("pose.csv"), "x,y,z\n3,0,0\n");
  const test::ToolResult result = distance({"box.npz", "two.npz", "--balls", "--poses", "pose.csv"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, testing::ContainsRegex(
                              "by +lower end by cover 0 of A and 0 of B, upper end by inside 0 of A and 1 of B\n"));
}

TEST_F(BodyFiles, AnswerByTrianglesBesideAMesh) {
  const test::ToolResult of_mesh = distance({"box.obj", "box.obj", "--poses", "poses.csv"});
  const test::ToolResult result = distance({"box.npz", "box.obj", "--poses", "poses.csv", "--check"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr(",free,"));
  EXPECT_THAT(of_mesh.out, HasSubstr(",hit,"));
  EXPECT_THAT(result.out, HasSubstr("\n0,0,hit,"));
}

TEST_F(BodyFiles, AreRefusedIfABallReachesOutOrAPointIsLeftOut) {
  BodyFile out = body_, open = body_;
  out.inside[0].radius = 0.51;
  open.cover[0].radius = 0.86;
  write("out.npz", out);
  write("open.npz", open);
  const test::ToolResult reaches = distance({"out.npz", "box.obj"}), leaves = distance({"box.npz", "open.npz"});
  EXPECT_EQ(reaches.exit_code, 3);
  EXPECT_THAT(reaches.err, HasSubstr("out.npz: ball 0 of those inside reaches out of the solid"));
  EXPECT_EQ(leaves.exit_code, 3);
  EXPECT_THAT(leaves.err, HasSubstr("open.npz: the balls of the cover are not proved to cover"));
}

TEST_F(BodyFiles, APictureAndAPage) {
  const test::ToolResult result = distance(
      {"box.npz", "box.npz", "--poses", "poses.csv", "-o", "d.csv", "--picture", "d.png", "--html", "d.html", "-q"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(test::read_file(path("d.png")), StartsWith("\x89PNG"));
  const std::string page = test::read_file(path("d.html"));
  EXPECT_THAT(page, StartsWith("<!doctype html>"));
  EXPECT_THAT(page, HasSubstr("Pose 3 of 3, that of the least distance"));
  EXPECT_THAT(page, HasSubstr("<td>2</td><td>66.67 %</td>"));
  EXPECT_THAT(page, HasSubstr("</svg>"));
}

TEST_F(BodyFiles, APictureOfARowThatIsChosen) {
  const auto drawn = [this](std::vector<std::string> options) {
    options.insert(options.begin(), {"box.npz", "box.npz", "--picture", "d.png", "--html", "d.html", "-q"});
    return distance(std::move(options));
  };
  ASSERT_EQ(drawn({"--poses", "poses.csv"}).exit_code, 0);
  const std::string least = test::read_file(path("d.png"));
  ASSERT_EQ(drawn({"--poses", "poses.csv", "--row", "3"}).exit_code, 0);
  EXPECT_EQ(test::read_file(path("d.png")), least);
  const test::ToolResult first = drawn({"--poses", "poses.csv", "--row", "1"});
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_NE(test::read_file(path("d.png")), least);
  EXPECT_THAT(test::read_file(path("d.html")), HasSubstr("<p>Pose 1 of 3: the distance is between "));
  const test::ToolResult none = drawn({"--poses", "poses.csv", "--row", "4"}), second = drawn({"--row", "2"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, HasSubstr("medial-vk: --row 4: there are only 3 poses\n"));
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_THAT(second.err, HasSubstr("medial-vk: --row 2: there is only 1 pose\n"));
}

}  // namespace
}  // namespace medial_vk
