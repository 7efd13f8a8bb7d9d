// Tables of poses: columns in any order, unusual files, and messages with the line of the mistake.
#include "pose_files/read_poses.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<Pose> poses_of(const std::string& text) {
  const Result<std::vector<Pose>> poses = parse_poses(text, "p.csv");
  EXPECT_TRUE(poses.ok()) << poses.error().message;
  return poses.ok() ? poses.value() : std::vector<Pose>();
}

std::string message_for(const std::string& text) {
  const Result<std::vector<Pose>> poses = parse_poses(text, "p.csv");
  EXPECT_FALSE(poses.ok()) << text;
  if (poses.ok()) return {};
  EXPECT_EQ(poses.error().code, ErrorCode::kInvalidMesh);
  return poses.error().message;
}

Pose shifted(double x, double y, double z) {
  Pose pose;
  pose.shift = {x, y, z};
  return pose;
}

void expect_near(const Point& a, const Point& b) {
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 1e-15) << k;
}

TEST(ReadPoses, WithoutARotation) {
  EXPECT_THAT(poses_of("x,y,z\n1,2,3\n-0.5,+1e-3,.25\n"), ElementsAre(shifted(1, 2, 3), shifted(-0.5, 1e-3, 0.25)));
  EXPECT_THAT(poses_of("x,y,z\n1,2,3"), ElementsAre(shifted(1, 2, 3)));
}

TEST(ReadPoses, NumbersAreTheNearestDoubles) {
  const std::vector<Pose> poses = poses_of("x,y,z\n0.1,1e-400,1.2345678901234567e17\n");
  EXPECT_THAT(poses, ElementsAre(shifted(0.1, 0, 1.2345678901234567e17)));
}

/// A quarter of a turn about z, in both senses, and a third of one about the diagonal.
TEST(ReadPoses, ARotationIsAQuaternion) {
  const std::string s = "0.70710678118654752";
  const std::vector<Pose> poses =
      poses_of("x,y,z,qx,qy,qz,qw\n5,6,7,0,0," + s + "," + s + "\n5,6,7,0,0,-" + s + "," + s + "\n0,0,0,.5,.5,.5,.5\n");
  ASSERT_EQ(poses.size(), 3u);
  EXPECT_EQ(poses[0].shift, (Point{5, 6, 7}));
  expect_near(poses[0] * Point{1, 0, 0}, {5, 7, 7});
  expect_near(poses[0] * Point{0, 1, 0}, {4, 6, 7});
  expect_near(poses[1] * Point{1, 0, 0}, {5, 5, 7});
  expect_near(poses[2] * Point{1, 2, 3}, {3, 1, 2});
}

TEST(ReadPoses, ColumnsAreInAnyOrder) {
  const std::vector<Pose> usual = poses_of("x,y,z,qx,qy,qz,qw\n1,2,3,.1,.7,-.1,.7\n4,5,6,0,0,0,1\n");
  EXPECT_EQ(usual, poses_of("qw,qx,qy,qz,z,y,x\n.7,.1,.7,-.1,3,2,1\n1,0,0,0,6,5,4\n"));
  EXPECT_EQ(usual, poses_of("qz,x,qw,y,qx,z,qy\n-.1,1,.7,2,.1,3,.7\n0,4,1,5,0,6,0\n"));
}

TEST(ReadPoses, OtherColumnsAreIgnored) {
  EXPECT_THAT(poses_of("name,x,time,y,z,,X\na part,1,0:01,2,3,,nan\nb,4,,5,6,\"\",\n"),
              ElementsAre(shifted(1, 2, 3), shifted(4, 5, 6)));
}

TEST(ReadPoses, FilesOfOtherProgramsAreRead) {
  const std::vector<Pose> expected = {shifted(1, 2, 3), shifted(4, 5, 6)};
  EXPECT_EQ(poses_of("x,y,z\r\n1,2,3\r\n4,5,6\r\n"), expected) << "CR LF";
  EXPECT_EQ(poses_of("\xef\xbb\xbfx,y,z\n1,2,3\n4,5,6\n"), expected) << "byte order mark";
  EXPECT_EQ(poses_of("\n\r\n  \t\nx,y,z\n\n1,2,3\n \n4,5,6\n\n\n"), expected) << "blank lines";
  EXPECT_EQ(poses_of(" x ,\ty, z\n 1,2\t,3\n4 , 5,6 \n"), expected) << "blanks around words";
}

/// Numbers that were written with three digits are no unit quaternion.
TEST(ReadPoses, AQuaternionIsNormalised) {
  const std::vector<Pose> poses =
      poses_of("x,y,z,qx,qy,qz,qw\n0,0,0,0.183,0.365,0.548,0.73\n0,0,0,0,0,0,1.0099\n0,0,0,0.9901,0,0,0\n");
  ASSERT_EQ(poses.size(), 3u);
  for (const Pose& pose : poses) {
    const std::array<Point, 3>& rows = pose.rotation;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(dot(rows[i], rows[j]), i == j, 1e-15) << i << ' ' << j;
    }
    EXPECT_NEAR(dot(cross(rows[0], rows[1]), rows[2]), 1, 1e-15);
  }
  EXPECT_EQ(poses[1], Pose());
  EXPECT_EQ(poses[2].rotation, (std::array<Point, 3>{{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}}));
}

TEST(ReadPoses, TheFirstLineNamesTheColumns) {
  const std::string needed =
      "the first line must name the columns: x,y,z, and with a rotation also qx,qy,qz,qw, in any order";
  EXPECT_EQ(message_for("1,2,3\n4,5,6\n"), "p.csv:1: " + needed);
  EXPECT_EQ(message_for("\n\nx,y\n1,2\n"), "p.csv:3: " + needed);
  EXPECT_EQ(message_for("x;y;z\n1;2;3\n"), "p.csv:1: " + needed);
  EXPECT_EQ(message_for("X,Y,Z\n1,2,3\n"), "p.csv:1: " + needed);
  EXPECT_EQ(message_for("qx,qy,qz,qw\n0,0,0,1\n"), "p.csv:1: " + needed);
  for (const char* some : {"qw", "qx", "qx,qy,qz", "qw,qz,qy"}) {
    EXPECT_EQ(message_for(std::string("x,y,z,") + some + "\n"), "p.csv:1: " + needed) << some;
  }
}

TEST(ReadPoses, NoNameMayBeGivenTwice) {
  EXPECT_EQ(message_for("\nx,y,z,x\n1,2,3,4\n"), "p.csv:2: two columns are named x");
  EXPECT_EQ(message_for("x,y,z,qx,qy,qz,qw,qw,qw\n"), "p.csv:1: two columns are named qw");
}

TEST(ReadPoses, EveryLineHasAllValues) {
  EXPECT_EQ(message_for("x,y,z\n1,2,3\n\n1,2\n"), "p.csv:4: 2 values, where the first line names 3");
  EXPECT_EQ(message_for("x,y,z\n1,2,3,4\n"), "p.csv:2: 4 values, where the first line names 3");
  EXPECT_EQ(message_for("name,x,y,z\n1,2,3\n"), "p.csv:2: 3 values, where the first line names 4");
}

TEST(ReadPoses, ValuesAreFiniteNumbers) {
  EXPECT_EQ(message_for("x,y,z\r\n1,2,3\r\n1,two,3\r\n"), "p.csv:3: y: \"two\" is not a number");
  EXPECT_EQ(message_for("z,y,x\n1,2,\n"), "p.csv:2: x: \"\" is not a number");
  EXPECT_EQ(message_for("x,y,z\n1,2,3 4\n"), "p.csv:2: z: \"3 4\" is not a number");
  EXPECT_EQ(message_for("x,y,z\n1,2,1e400\n"), "p.csv:2: z: \"1e400\" is beyond the range of a double");
  EXPECT_EQ(message_for("x,y,z\n1,2,-2e18\n"), "p.csv:2: z: \"-2e18\" is beyond 1e+18");
  EXPECT_THAT(message_for("x,y,z\ninf,0,0\n"), HasSubstr("p.csv:2: x: \"inf\" is "));
  EXPECT_THAT(message_for("x,y,z,qx,qy,qz,qw\n0,0,0,0,0,0,nan\n"), HasSubstr("p.csv:2: qw: \"nan\" is "));
  // A message stays readable.
  EXPECT_THAT(message_for("x,y,z\n" + std::string(1000, '\x01') + ",0,0\n"), testing::SizeIs(testing::Lt(100u)));
}

TEST(ReadPoses, AQuaternionHasTheLengthOne) {
  const auto of = [](const std::string& quaternion) {
    return message_for("x,y,z,qx,qy,qz,qw\n0,0,0,0,0,0,1\n0,0,0," + quaternion + "\n");
  };
  EXPECT_EQ(of("0,0,0,0"), "p.csv:3: the quaternion has the length 0 instead of 1");
  EXPECT_EQ(of("1,1,1,1"), "p.csv:3: the quaternion has the length 2 instead of 1");
  EXPECT_EQ(of("0,0,0,1.02"), "p.csv:3: the quaternion has the length 1.02 instead of 1");
  EXPECT_EQ(of("0,-0.98,0,0"), "p.csv:3: the quaternion has the length 0.98 instead of 1");
  EXPECT_EQ(of("1e17,1e17,1e17,1e17"), "p.csv:3: the quaternion has the length 2e+17 instead of 1");
}

TEST(ReadPoses, ATableHasAPose) {
  for (const char* text : {"", "\n\n", "\xef\xbb\xbf", "x,y,z", "x,y,z\n\n"}) {
    EXPECT_EQ(message_for(text), "p.csv: there is no pose") << text;
  }
}

TEST(ReadPoses, OfAFile) {
  const std::string path = testing::TempDir() + "medial_vk_read_poses.csv";
  std::filesystem::remove(path);
  const Result<std::vector<Pose>> missing = read_poses(path);
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().code, ErrorCode::kInvalidMesh);
  EXPECT_EQ(missing.error().message, path + ": cannot be read: No such file or directory");
  std::ofstream(path) << "x,y,z\n1,2,3\n";
  const Result<std::vector<Pose>> poses = read_poses(path);
  ASSERT_TRUE(poses.ok()) << poses.error().message;
  EXPECT_THAT(poses.value(), ElementsAre(shifted(1, 2, 3)));
  std::ofstream(path) << "x,y,z\n1,2\n";
  EXPECT_THAT(read_poses(path).error().message, testing::StartsWith(path + ":2: "));
  std::filesystem::remove(path);
  EXPECT_EQ(read_poses(testing::TempDir()).error().message, testing::TempDir() + ": cannot be read: Is a directory");
}

}  // namespace
}  // namespace medial_vk
