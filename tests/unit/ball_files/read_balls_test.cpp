// Balls from tables: columns in any order, the last of several sets, and what is refused.
#include "ball_files/read_balls.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "ball_files/ball_arrays.h"
#include "output/medial_ply/medial_file.h"
#include "output/numpy_files/npz_writer.h"

namespace medial_vk::test {
namespace {

std::vector<Ball> balls_of(const std::string& text) {
  const Result<std::vector<Ball>> balls = parse_balls(text, "b.csv");
  EXPECT_TRUE(balls) << balls.error().message;
  return balls ? balls.value() : std::vector<Ball>();
}

std::string error_of(const std::string& text) {
  const Result<std::vector<Ball>> balls = parse_balls(text, "b.csv");
  EXPECT_FALSE(balls);
  if (balls) return {};
  EXPECT_EQ(balls.error().code, ErrorCode::kInvalidMesh);
  return balls.error().message;
}

TEST(ReadBalls, ColumnsMayComeInAnyOrderAmongOthers) {
  const std::vector<Ball> balls = balls_of("part,radius,z,y,x\narm,0.5,3,2,1\nhand,0.25,-3,-2,-1e2\n");
  ASSERT_EQ(balls.size(), 2u);
  EXPECT_EQ(balls[0].centre, (Point{1, 2, 3}));
  EXPECT_EQ(balls[0].radius, 0.5);
  EXPECT_EQ(balls[1].centre, (Point{-100, -2, -3}));
  EXPECT_EQ(balls[1].radius, 0.25);
}

TEST(ReadBalls, OfSeveralLevelsTheLastIsTaken) {
  const std::vector<Ball> balls = balls_of("x,y,z,radius,level\n0,0,0,1,0\n1,0,0,2,1\n2,0,0,3,1\n");
  ASSERT_EQ(balls.size(), 2u);
  EXPECT_EQ(balls[0].radius, 2);
  EXPECT_EQ(balls[1].radius, 3);
  EXPECT_EQ(balls_of("x,y,z,radius,level\n1,0,0,2,1\n0,0,0,1,0\n").size(), 1u);
  EXPECT_EQ(balls_of("x,y,z,radius,level\n1,0,0,2,-1\n").size(), 1u);
}

TEST(ReadBalls, RefusesWhatIsNoTableOfBallsAndNamesTheLine) {
  EXPECT_EQ(error_of(""), "b.csv: there is no ball");
  EXPECT_EQ(error_of("x,y,z,radius\n"), "b.csv: there is no ball");
  EXPECT_EQ(error_of("x,y,z\n1,2,3\n"),
            "b.csv:1: the first line must name the columns x, y, z and radius, in any order (a file of balls is such a "
            "table, a medial PLY, or an .npz or .json that this program wrote)");
  EXPECT_EQ(error_of("link,x,y,z,radius\narm,1,2,3,4\n"),
            "b.csv:1: the balls are those of the links of a robot, which are several solids");
  EXPECT_EQ(error_of("x,x,y,z,radius\n1,1,2,3,4\n"), "b.csv:1: two columns are named x");
  EXPECT_EQ(error_of("x,y,z,radius\n1,2,3\n"), "b.csv:2: 3 values, where the first line names 4");
  EXPECT_EQ(error_of("x,y,z,radius\n1,2,3,0\n"), "b.csv:2: the radius 0 is not positive");
  EXPECT_EQ(error_of("x,y,z,radius\n1,2,3,-1\n"), "b.csv:2: the radius -1 is not positive");
  EXPECT_TRUE(error_of("x,y,z,radius\n1,2,nan,1\n").starts_with("b.csv:2: z: ")) << "not finite";
  EXPECT_TRUE(error_of("x,y,z,radius\n1,2,1e999,1\n").starts_with("b.csv:2: z: ")) << "not finite";
  EXPECT_EQ(error_of("x,y,z,radius\n0,0,0,1\n1,-2e18,3,1\n"), "b.csv:3: there is a number beyond 1e+18");
  EXPECT_EQ(error_of("x,y,z,radius\n0,0,0,2e18\n"), "b.csv:2: there is a number beyond 1e+18");
  EXPECT_EQ(balls_of("x,y,z,radius\n1e18,-1e18,0,1e18\n").size(), 1u);
}

const std::string kBall = R"("centre":[0,0,0],"radius":1)", kSpokeA = R"("spoke_a":[1,0,0])",
                  kSpokeB = R"("spoke_b":[0,1,0])";

/// The message about a list of objects with these members.
std::string error_of_list(const std::vector<std::string>& objects) {
  std::string list;
  for (const std::string& members : objects) list += (list.empty() ? "{" : ",{") + members + "}";
  const Result<BallsWithSpokes> read = balls_of_json("{\"points\":[" + list + "]}", "b.json");
  EXPECT_FALSE(read);
  if (read) return {};
  EXPECT_EQ(read.error().code, ErrorCode::kInvalidMesh);
  return read.error().message;
}

TEST(ReadBalls, OfAListAllHaveBothSpokesOrNone) {
  const std::string pair = kBall + "," + kSpokeA + "," + kSpokeB;
  const std::string both = "there must be both spoke_a and spoke_b, of three numbers each, or neither";
  EXPECT_EQ(error_of_list({pair, kBall + "," + kSpokeA}), "b.json: ball 1: " + both);
  EXPECT_EQ(error_of_list({kBall + "," + kSpokeB}), "b.json: ball 0: " + both);
  EXPECT_EQ(error_of_list({kBall + "," + kSpokeB + R"(,"spoke_a":[1,0])"}), "b.json: ball 0: " + both);
  EXPECT_EQ(error_of_list({kBall + "," + kSpokeB + R"(,"spoke_a":[1,0,null])"}), "b.json: ball 0: " + both);
  EXPECT_EQ(error_of_list({kBall + R"(,"spoke_a":null,"spoke_b":null)"}), "b.json: ball 0: " + both);
  EXPECT_EQ(error_of_list({pair, pair, kBall}), "b.json: ball 2: it has no spokes, but the balls before have them");
  EXPECT_EQ(error_of_list({kBall, kBall, pair}), "b.json: ball 2: it has spokes, but the balls before have none");
  EXPECT_EQ(error_of_list({kBall + R"(,"spoke_a":[1e200,0,0],)" + kSpokeB}),
            "b.json: ball 0: a spoke is no unit vector");
  EXPECT_EQ(error_of_list({kBall, R"("centre":[0,-2e18,0],"radius":1)"}),
            "b.json: ball 1: there is a number beyond 1e+18");
}

TEST(ReadBalls, ArraysHaveBothSpokesOrNone) {
  const auto bytes_of = [](std::vector<double> centre, bool has_a, bool has_b) {
    const std::vector<double> radius = {1};
    const std::vector<float> spoke = {0, 0, 1};
    NpzWriter arrays;
    arrays.numbers<double>("centre", {1, 3}, centre);
    arrays.numbers<double>("radius", {1}, radius);
    if (has_a) arrays.numbers<float>("spoke_a", {1, 3}, spoke);
    if (has_b) arrays.numbers<float>("spoke_b", {1, 3}, spoke);
    return arrays.finish().value();
  };
  EXPECT_EQ(balls_of_arrays(bytes_of({1, 2, 3}, true, true), "b.npz").value().spokes.size(), 1u);
  EXPECT_EQ(balls_of_arrays(bytes_of({1, 2, 3}, false, false), "b.npz").value().spokes.size(), 0u);
  for (const bool has_a : {true, false}) {
    const Result<BallsWithSpokes> read = balls_of_arrays(bytes_of({1, 2, 3}, has_a, !has_a), "b.npz");
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::kInvalidMesh);
    EXPECT_EQ(read.error().message, "b.npz: there must be both arrays spoke_a and spoke_b, or neither");
  }
  const Result<BallsWithSpokes> far = balls_of_arrays(bytes_of({1, 2, 3e18}, false, false), "b.npz");
  ASSERT_FALSE(far);
  EXPECT_EQ(far.error().message, "b.npz: ball 0: there is a number beyond 1e+18");
}

// What reads balls takes them for those of a solid: those of its outside are refused in each format.
TEST(ReadBalls, PointsOutsideOfTheSolidAreErrorsOfUsage) {
  const auto expect_refused = [](const auto& read, const std::string& place) {
    ASSERT_FALSE(read) << place;
    EXPECT_EQ(read.error().code, ErrorCode::kUsage);
    EXPECT_TRUE(read.error().message.starts_with(place + ": there are points outside")) << read.error().message;
  };
  expect_refused(parse_balls("x,y,z,radius,side\n0,0,0,1,inside\n1,2,3,4,outside\n", "b.csv"), "b.csv:3");
  EXPECT_EQ(balls_of("x,y,z,radius,side\n0,0,0,1,inside\n1,2,3,4,left\n").size(), 2u) << "a table of any origin";
  expect_refused(balls_of_json("{\"points\":[{" + kBall + "},{" + kBall + R"(,"side":"outside"}]})", "b.json"),
                 "b.json: ball 1");
  EXPECT_TRUE(balls_of_json("{\"points\":[{" + kBall + R"(,"side":"inside"}]})", "b.json"));
  for (const char last : {'\0', '\1'}) {
    NpzWriter arrays;
    arrays.numbers<double>("centre", {2, 3}, std::vector<double>{0, 0, 0, 1, 2, 3});
    arrays.numbers<double>("radius", {2}, std::vector<double>{1, 1});
    arrays.add("side", "|u1", {2}, std::string{'\0', last});
    const auto read = balls_of_arrays(arrays.finish().value(), "b.npz");
    if (last == '\0') {
      EXPECT_TRUE(read);
    } else {
      expect_refused(read, "b.npz");
    }
  }
}

// A medial PLY is read from a file.
TEST(ReadBalls, PointsOutsideInAMedialPlyAreErrorsOfUsage) {
  MedialSphere sphere;
  sphere.radius = 1;
  sphere.spoke_a = {0, 0, 1};
  sphere.spoke_b = {0, 0, -1};
  const std::vector<MedialSphere> spheres = {sphere, sphere};
  MedialHeader header;
  header.version = "1.2.3";
  header.voxel_size = 1;
  header.epsilon = 0.01;
  header.object_angle = 0.6;
  const std::string path = testing::TempDir() + "sides_of_balls.ply";
  for (const std::size_t inside : {2, 1, 0}) {
    header.inside_count = inside;
    std::ofstream(path, std::ios::binary) << encode_ply(header, spheres, false);
    const auto read = read_balls(path);
    EXPECT_EQ(static_cast<bool>(read), inside == 2);
    if (!read) {
      EXPECT_EQ(read.error().code, ErrorCode::kUsage) << read.error().message;
    }
  }
  std::filesystem::remove(path);
}

// Shortest texts of floats are not those of doubles: 0.6f is 0.60000002384185791015625.
TEST(ReadBalls, SpokesInTextAreFloats) {
  const std::string table =
      "x,y,z,radius,spoke_a_x,spoke_a_y,spoke_a_z,spoke_b_x,spoke_b_y,spoke_b_z\n0,0,0,0.3,0.6,0.8,0,0,-0.6,-0.8\n";
  const std::string list =
      R"({"points":[{"centre":[0,0,0],"radius":0.3,"spoke_a":[0.6,0.8,0],"spoke_b":[0,-0.6,-0.8]}]})";
  for (const Result<BallsWithSpokes>& read : {parse_balls_with_spokes(table, "b.csv"), balls_of_json(list, "b.json")}) {
    ASSERT_TRUE(read);
    ASSERT_EQ(read.value().spokes.size(), 1u);
    EXPECT_EQ(read.value().spokes[0].a, (Point{0.6f, 0.8f, 0}));
    EXPECT_EQ(read.value().spokes[0].b, (Point{0, -0.6f, -0.8f}));
    EXPECT_EQ(read.value().balls[0].radius, 0.3);
  }
}

}  // namespace
}  // namespace medial_vk::test
