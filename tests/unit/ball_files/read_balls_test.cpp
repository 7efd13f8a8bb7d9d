// Balls from tables: columns in any order, the last of several sets, and what is refused.
#include "ball_files/read_balls.h"

#include <gtest/gtest.h>

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
            "table, a "
            "medial PLY or a body file)");
  EXPECT_EQ(error_of("link,x,y,z,radius\narm,1,2,3,4\n"),
            "b.csv:1: the balls are those of the links of a robot, which are several solids");
  EXPECT_EQ(error_of("x,x,y,z,radius\n1,1,2,3,4\n"), "b.csv:1: two columns are named x");
  EXPECT_EQ(error_of("x,y,z,radius\n1,2,3\n"), "b.csv:2: 3 values, where the first line names 4");
  EXPECT_EQ(error_of("x,y,z,radius\n1,2,3,0\n"), "b.csv:2: the radius 0 is not positive");
  EXPECT_EQ(error_of("x,y,z,radius\n1,2,3,-1\n"), "b.csv:2: the radius -1 is not positive");
  EXPECT_TRUE(error_of("x,y,z,radius\n1,2,nan,1\n").starts_with("b.csv:2: z: ")) << "not finite";
  EXPECT_TRUE(error_of("x,y,z,radius\n1,2,1e999,1\n").starts_with("b.csv:2: z: ")) << "not finite";
}

}  // namespace
}  // namespace medial_vk::test
