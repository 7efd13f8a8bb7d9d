// Forward kinematics, compared with a computation of its own by Eigen; joints as they are read, and their messages.
#include "robots/model/kinematics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "base/point_ops.h"
#include "robots/model/read_urdf.h"

namespace medial_vk {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using testing::HasSubstr;

/// Links named l0, l1, ... and these joints.
std::string urdf_of(std::size_t links, const std::string& joints) {
  std::string text = "<robot name='r'>";
  for (std::size_t i = 0; i < links; ++i) text += "<link name='l" + std::to_string(i) + "'/>";
  return text + joints + "</robot>";
}

Result<Robot> read_moving(std::size_t links, const std::string& joints) {
  return read_urdf(urdf_of(links, joints), "r.urdf", UrdfDetail::kMotion);
}

std::string ends(int parent, int child) {
  return "<parent link='l" + std::to_string(parent) + "'/><child link='l" + std::to_string(child) + "'/>";
}

std::string message_of_joints(const std::string& joints) {
  const Result<Robot> robot = read_moving(3, joints);
  EXPECT_FALSE(robot.ok()) << joints;
  if (robot.ok()) return {};
  EXPECT_EQ(robot.error().code, ErrorCode::kInvalidMesh);
  EXPECT_THAT(robot.error().message, testing::StartsWith("r.urdf:"));
  return robot.error().message;
}

std::vector<Pose> placed(const Kinematics& kinematics, const std::vector<double>& values) {
  std::vector<Pose> poses(kinematics.links());
  const Status status = kinematics.place(values, poses);
  EXPECT_TRUE(status.ok());
  return poses;
}

void expect_perpendicular(const Pose& pose) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_NEAR(dot(pose.rotation[i], pose.rotation[j]), i == j ? 1 : 0, 4e-15);
    }
  }
}

/// A random joint, and its motion as Eigen composes it.
struct TestJoint {
  int parent, child;
  std::string type;
  Vector3d xyz, rpy, axis;
  int mimics = -1;
  double multiplier = 1, offset = 0;

  std::string text(int number) const {
    const auto words = [](const Vector3d& v) {
      std::string all;
      for (int k = 0; k < 3; ++k) {
        char word[40];
        std::snprintf(word, sizeof word, "%.17g ", v[k]);
        all += word;
      }
      return all;
    };
    std::string joint = "<joint name='j" + std::to_string(number) + "' type='" + type + "'>" + ends(parent, child) +
                        "<origin xyz='" + words(xyz) + "' rpy='" + words(rpy) + "'/><axis xyz='" + words(axis) +
                        "'/><limit lower='-2' upper='2'/>";
    if (mimics >= 0) {
      joint += "<mimic joint='j" + std::to_string(mimics) + "' multiplier='" + std::to_string(multiplier) +
               "' offset='" + std::to_string(offset) + "'/>";
    }
    return joint + "</joint>";
  }

  Isometry3d motion(double position) const {
    Isometry3d m = Isometry3d::Identity();
    m.translate(xyz);
    m.rotate(AngleAxisd(rpy[2], Vector3d::UnitZ()) * AngleAxisd(rpy[1], Vector3d::UnitY()) *
             AngleAxisd(rpy[0], Vector3d::UnitX()));
    if (type == "prismatic") m.translate(position * axis.normalized());
    if (type == "revolute" || type == "continuous") m.rotate(AngleAxisd(position, axis.normalized()));
    return m;
  }
};

class RandomRobot {
 public:
  explicit RandomRobot(unsigned seed) : random_(seed) {
    const char* const types[] = {"fixed", "revolute", "continuous", "prismatic"};
    for (int link = 1; link < kLinks; ++link) {
      TestJoint joint;
      joint.parent = static_cast<int>(random_() % static_cast<unsigned>(link));
      joint.child = link;
      joint.type = types[random_() % 4];
      joint.xyz = vector(2), joint.rpy = vector(4), joint.axis = vector(1);
      const int other = joints_.empty() ? 0 : static_cast<int>(random_() % joints_.size());
      if (!joints_.empty() && joint.type != "fixed" && joints_[static_cast<std::size_t>(other)].type != "fixed" &&
          random_() % 2 == 0) {
        joint.mimics = other, joint.multiplier = -1.5, joint.offset = 0.25;
      }
      joints_.push_back(joint);
    }
  }

  static constexpr int kLinks = 12;

  std::string joints() const {
    std::string text;
    for (std::size_t i = 0; i < joints_.size(); ++i) text += joints_[i].text(static_cast<int>(i));
    return text;
  }
  double number() { return std::uniform_real_distribution<double>(-1, 1)(random_); }

  double position(std::size_t joint, const std::map<std::string, double>& values) const {
    const TestJoint& j = joints_[joint];
    if (j.type == "fixed") return 0;
    if (j.mimics < 0) return values.at("j" + std::to_string(joint));
    return j.multiplier * position(static_cast<std::size_t>(j.mimics), values) + j.offset;
  }

  Isometry3d pose(int link, const std::map<std::string, double>& values) const {
    if (link == 0) return Isometry3d::Identity();
    const auto joint = static_cast<std::size_t>(link - 1);
    return pose(joints_[joint].parent, values) * joints_[joint].motion(position(joint, values));
  }

 private:
  Vector3d vector(double size) {
    const double x = number(), y = number(), z = number();
    return size * Vector3d(x, y, z);
  }

  std::mt19937 random_;
  std::vector<TestJoint> joints_;
};

TEST(KinematicsTest, PlacesLinksAsEigenDoes) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    RandomRobot random(seed);
    const Result<Robot> robot = read_moving(RandomRobot::kLinks, random.joints());
    ASSERT_TRUE(robot.ok()) << robot.error().message;
    const Kinematics kinematics(robot.value());
    std::vector<double> values;
    std::map<std::string, double> by_name;
    for (const FreeJoint& joint : kinematics.joints()) {
      values.push_back(3 * random.number());
      by_name[joint.name] = values.back();
    }
    const std::vector<Pose> poses = placed(kinematics, values);
    for (int link = 0; link < RandomRobot::kLinks; ++link) {
      const Isometry3d expected = random.pose(link, by_name);
      const Pose& pose = poses[static_cast<std::size_t>(link)];
      for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        EXPECT_NEAR(pose.shift[k], expected.translation()[i], 1e-12);
        for (int j = 0; j < 3; ++j) {
          EXPECT_NEAR(pose.rotation[k][static_cast<std::size_t>(j)], expected.linear()(i, j), 1e-13);
        }
      }
      expect_perpendicular(pose);
    }
  }
}

/// Products of thousands of rotations, each of which is off by its rounding.
TEST(KinematicsTest, ALongChainKeepsRotations) {
  constexpr int kJoints = 5000;
  std::string joints;
  for (int i = 0; i < kJoints; ++i) {
    joints += "<joint name='j" + std::to_string(i) + "' type='continuous'>" + ends(i, i + 1) +
              "<axis xyz='1 2 3'/><origin xyz='1 0 0' rpy='0.1 0.2 0.3'/></joint>";
  }
  const Result<Robot> robot = read_moving(kJoints + 1, joints);
  ASSERT_TRUE(robot.ok()) << robot.error().message;
  const std::vector<Pose> poses = placed(Kinematics(robot.value()), std::vector<double>(kJoints, 0.7));
  expect_perpendicular(poses.back());
}

TEST(KinematicsTest, JointsAreInTheOrderOfTheFileAndHaveLimits) {
  const Result<Robot> robot = read_moving(
      5, "<joint name='d' type='prismatic'>" + ends(2, 3) +
             "<axis xyz='0 0 4'/><limit lower='-0.5' upper='1e-1'/></joint>" + "<joint name='a' type='continuous'>" +
             ends(0, 1) + "</joint><joint type='fixed'>" + ends(1, 2) +
             "</joint><joint name='m' type='revolute'><limit effort='1'/><mimic joint='a'/>" + ends(3, 4) + "</joint>");
  ASSERT_TRUE(robot.ok()) << robot.error().message;
  const Kinematics kinematics(robot.value());
  ASSERT_EQ(kinematics.joints().size(), 2u);
  EXPECT_EQ(kinematics.joints()[0].name, "d");
  EXPECT_EQ(kinematics.joints()[0].lower, -0.5);
  EXPECT_EQ(kinematics.joints()[0].upper, 0.1);
  EXPECT_EQ(kinematics.joints()[1].name, "a");
  EXPECT_EQ(kinematics.joints()[1].upper, std::numeric_limits<double>::infinity());
  EXPECT_EQ(robot.value().joints[0].axis, (Point{0, 0, 1}));
  EXPECT_EQ(robot.value().joints[1].axis, (Point{1, 0, 0}));  // the default of URDF
  EXPECT_EQ(robot.value().joints[3].lower, 0);
  // The first shifts by 2 along z, which the second has turned by a quarter about x; the mimic turns by as much.
  const std::vector<Pose> poses = placed(kinematics, {2, std::numbers::pi / 2});
  EXPECT_NEAR(poses[3].shift[1], -2, 1e-15);
  EXPECT_NEAR(poses[3].shift[2], 0, 1e-15);
  EXPECT_NEAR(poses[4].rotation[1][1], -1, 1e-15);
}

TEST(KinematicsTest, PosesBeyondNumbersAreErrors) {
  const Result<Robot> robot = read_moving(2, "<joint name='a' type='continuous'>" + ends(0, 1) + "</joint>");
  ASSERT_TRUE(robot.ok());
  const Kinematics kinematics(robot.value());
  std::vector<Pose> poses(2);
  const double values[] = {std::numeric_limits<double>::infinity()};
  const Status status = kinematics.place(values, poses);
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error().message, HasSubstr("\"l1\""));
}

TEST(KinematicsTest, MessagesOfJoints) {
  const std::string end = ends(0, 1) + "</joint>", limit = "<limit lower='0' upper='1'/>";
  EXPECT_THAT(message_of_joints("<joint name='a'>" + end), HasSubstr("no type"));
  EXPECT_THAT(message_of_joints("<joint name='a' type='floating'>" + end), HasSubstr("\"floating\""));
  EXPECT_THAT(message_of_joints("<joint type='continuous'>" + end), HasSubstr("no name"));
  EXPECT_THAT(message_of_joints("<joint name='a' type='revolute'>" + end), HasSubstr("revolute joint has no <limit>"));
  EXPECT_THAT(message_of_joints("<joint name='a' type='prismatic'>" + end),
              HasSubstr("prismatic joint has no <limit>"));
  EXPECT_THAT(message_of_joints("<joint name='a' type='prismatic'><limit lower='1' upper='0'/>" + end),
              HasSubstr("above the upper one"));
  EXPECT_THAT(message_of_joints("<joint name='a' type='prismatic'><limit lower='x'/>" + end), HasSubstr("\"x\""));
  EXPECT_THAT(message_of_joints("<joint name='a' type='continuous'><axis xyz='0 0 0'/>" + end), HasSubstr("<axis>"));
  EXPECT_THAT(message_of_joints("<joint name='a' type='continuous'><axis/>" + end), HasSubstr("no xyz"));
  EXPECT_THAT(message_of_joints("<joint name='a' type='continuous'><mimic/>" + end), HasSubstr("names no joint"));
  EXPECT_THAT(message_of_joints("<joint name='a' type='continuous'><mimic joint='b'/>" + end), HasSubstr("\"b\""));
  EXPECT_THAT(message_of_joints("<joint name='a' type='continuous'><mimic joint='a'/>" + end), HasSubstr("itself"));
  const std::string second = "<joint name='b' type='continuous'><mimic joint='a'/>" + ends(1, 2) + "</joint>";
  EXPECT_THAT(message_of_joints("<joint name='a' type='continuous'><mimic joint='b'/>" + end + second),
              HasSubstr("itself"));
  EXPECT_THAT(message_of_joints("<joint name='a' type='continuous'>" + end + "<joint name='a' type='continuous'>" +
                                ends(1, 2) + "</joint>"),
              HasSubstr("another joint"));
  EXPECT_TRUE(read_moving(2, "<joint name='a' type='revolute'>" + limit + end).ok());
}

/// Spheres need no motion, and their robots may lack what it needs.
TEST(KinematicsTest, WithoutMotionJointsAreNotExamined) {
  EXPECT_TRUE(read_urdf(urdf_of(2, "<joint type='floating'><axis xyz='x'/>" + ends(0, 1) + "</joint>"), "r.urdf").ok());
}

}  // namespace
}  // namespace medial_vk
