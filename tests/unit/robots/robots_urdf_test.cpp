// The reader of URDF: files that it accepts, its messages for others, and the poses of links.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "robots/model/read_urdf.h"

namespace medial_vk {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string robot_of(const std::string& inner) { return "<robot name='r'>\n" + inner + "</robot>\n"; }

std::string link_of(const std::string& geometry) {
  return robot_of("<link name='a'><collision><geometry>" + geometry + "</geometry></collision></link>\n");
}

Robot read(const std::string& text) {
  Result<Robot> robot = read_urdf(text, "r.urdf");
  EXPECT_TRUE(robot.ok()) << (robot.ok() ? "" : robot.error().message);
  return robot.ok() ? std::move(robot).value() : Robot();
}

std::string message_of(const std::string& text) {
  const Result<Robot> robot = read_urdf(text, "r.urdf");
  EXPECT_FALSE(robot.ok()) << text;
  if (robot.ok()) return "";
  EXPECT_EQ(robot.error().code, ErrorCode::kInvalidMesh);
  EXPECT_EQ(robot.error().message.find('\n'), std::string::npos);
  return robot.error().message;
}

TEST(Urdf, ReadsLinksGeometriesAndJoints) {
  const Robot robot = read(R"(<?xml version="1.0"?>
<robot name="two &amp; more">
  <material name="blue"/>
  <link name="a">
    <inertial><mass value="1"/></inertial>
    <visual><geometry><mesh filename="package://p/a.stl" scale="0.001 0.001 -0.001"/></geometry></visual>
    <collision name="c">
      <origin xyz="1 2 3" rpy="0 0 1.5707963267948966"/>
      <geometry><box size="1 2 .5"/></geometry>
    </collision>
    <collision><geometry><cylinder radius="0.1" length="+2e-1"/></geometry></collision>
  </link>
  <link name="b">
    <collision><geometry><sphere radius="0.25"/></geometry></collision>
    <collision><geometry><capsule length="2" radius="1"/></geometry></collision>
  </link>
  <joint name="j" type="fixed"><parent link="a"/><child link="b"/><origin xyz="0 0 5"/></joint>
</robot>)");
  EXPECT_EQ(robot.name, "two & more");
  ASSERT_EQ(robot.links.size(), 2u);
  ASSERT_EQ(robot.links[0].visual.size(), 1u);
  EXPECT_EQ(robot.links[0].visual[0].mesh, "package://p/a.stl");
  EXPECT_EQ(robot.links[0].visual[0].scale, (Point{0.001, 0.001, -0.001}));
  ASSERT_EQ(robot.links[0].collision.size(), 2u);
  const Geometry& box = robot.links[0].collision[0];
  EXPECT_EQ(box.kind, GeometryKind::kBox);
  EXPECT_EQ(box.size, (Point{1, 2, 0.5}));
  const Point turned = box.origin * Point{1, 0, 0};
  EXPECT_NEAR(turned[0], 1, 1e-15);
  EXPECT_NEAR(turned[1], 3, 1e-15);
  EXPECT_EQ(robot.links[0].collision[1].kind, GeometryKind::kCylinder);
  EXPECT_EQ(robot.links[0].collision[1].size, (Point{0.1, 0.2, 0}));
  EXPECT_EQ(robot.links[1].collision[0].kind, GeometryKind::kSphere);
  EXPECT_EQ(robot.links[1].collision[1].kind, GeometryKind::kCapsule);
  ASSERT_EQ(robot.joints.size(), 1u);
  EXPECT_EQ(robot.joints[0].parent, 0u);
  EXPECT_EQ(robot.joints[0].child, 1u);
  EXPECT_EQ(link_poses(robot)[1].shift, (Point{0, 0, 5}));
}

TEST(Urdf, RollComesBeforePitchBeforeYaw) {
  constexpr double kQuarter = std::numbers::pi / 2;
  // About x: y to z; about y: z to x; about z: x to y.
  const Point p = make_pose({0, 0, 0}, {kQuarter, kQuarter, kQuarter}) * Point{0, 1, 0};
  EXPECT_NEAR(p[0], 0, 1e-15);
  EXPECT_NEAR(p[1], 1, 1e-15);
  EXPECT_NEAR(p[2], 0, 1e-15);
  const Pose half = make_pose({1, 0, 0}, {0, 0, kQuarter});
  const Point twice = (half * half) * Point{1, 0, 0};
  EXPECT_NEAR(twice[0], 0, 1e-15);
  EXPECT_NEAR(twice[1], 1, 1e-15);
}

TEST(Urdf, PosesFollowChainsInWhateverOrder) {
  std::string text;
  for (const char* name : {"d", "c", "b", "a"}) text += std::string("<link name='") + name + "'/>";
  for (const auto& [parent, child] : {std::pair("c", "d"), std::pair("a", "b"), std::pair("b", "c")}) {
    text += std::string("<joint name='j'><parent link='") + parent + "'/><child link='" + child +
            "'/><origin xyz='1 0 0'/></joint>";
  }
  const std::vector<Pose> poses = link_poses(read(robot_of(text)));
  EXPECT_EQ(poses[0].shift[0], 3);
  EXPECT_EQ(poses[1].shift[0], 2);
  EXPECT_EQ(poses[2].shift[0], 1);
  EXPECT_EQ(poses[3].shift[0], 0);
}

TEST(Urdf, RefusesWhatIsNoRobot) {
  EXPECT_EQ(message_of(""), "r.urdf: the file is empty");
  EXPECT_THAT(message_of("<robot><link name='a'>"), StartsWith("r.urdf:1: this is no well-formed XML: "));
  EXPECT_THAT(message_of("<robot></link>"), HasSubstr("mismatched element"));
  EXPECT_THAT(message_of("solid stl\n"), HasSubstr("no well-formed XML"));
  EXPECT_THAT(message_of("<sdf/>"), HasSubstr("outermost element is not <robot>"));
  EXPECT_EQ(message_of(robot_of("")), "r.urdf: the robot has no <link>");
  EXPECT_EQ(message_of(robot_of("<link/>")), "r.urdf:2: a <link> has no name");
  EXPECT_EQ(message_of(robot_of("<link name='a'/>\n<link name='a'/>")), "r.urdf:3: there is another link \"a\"");
  EXPECT_THAT(message_of(robot_of("<link name='a'><visual/></link>")), HasSubstr("a <visual> has no <geometry>"));
}

TEST(Urdf, NestingWithoutEndIsNoCrash) {
  std::string text = "<robot>";
  for (int i = 0; i < 100'000; ++i) text += "<link>";
  EXPECT_THAT(message_of(text), HasSubstr("its elements are nested too deeply"));
}

/// The parser takes quadratic time in the number of an element's attributes.
TEST(Urdf, AttributesWithoutEndAreRefused) {
  const auto box_with = [](std::size_t count) {
    std::string text = "<robot name='r'><!-- <a b='\" --><link name='a'><collision><geometry><box size='1 1 1'";
    for (std::size_t i = 1; i < count; ++i) text += " a" + std::to_string(i) + "=\"<>='\"";
    return text + "/></geometry></collision></link></robot>";
  };
  EXPECT_TRUE(read_urdf(box_with(1000), "r.urdf").ok());
  EXPECT_THAT(message_of(box_with(1001)), HasSubstr("an element has more than 1000 attributes"));
  EXPECT_THAT(message_of(box_with(2'000'000)), HasSubstr("an element has more than 1000 attributes"));
}

TEST(Urdf, GeometryIsChecked) {
  EXPECT_THAT(message_of(link_of("")), HasSubstr("a <geometry> is empty"));
  EXPECT_THAT(message_of(link_of("<cone/>")), HasSubstr("the geometry \"cone\" is unknown; there are mesh, box"));
  EXPECT_THAT(message_of(link_of("<mesh/>")), HasSubstr("a <mesh> has no filename"));
  EXPECT_THAT(message_of(link_of("<mesh filename='a.stl' scale='1 1'/>")), HasSubstr("scale of <mesh>"));
  EXPECT_THAT(message_of(link_of("<mesh filename='a.stl' scale='nan 1 1'/>")), HasSubstr("\"nan\""));
  EXPECT_THAT(message_of(link_of("<mesh filename='a.stl' scale='1 0 1'/>")), HasSubstr("a scale of 0"));
  EXPECT_THAT(message_of(link_of("<box/>")), HasSubstr("a <box> has no size"));
  EXPECT_THAT(message_of(link_of("<box size='1 2 -3'/>")), HasSubstr("not above zero: -3"));
  EXPECT_THAT(message_of(link_of("<box size='1 2 3 4'/>")), HasSubstr("more than three numbers"));
  EXPECT_THAT(message_of(link_of("<sphere/>")), HasSubstr("a <sphere> has no radius"));
  EXPECT_THAT(message_of(link_of("<sphere radius='${r}'/>")), HasSubstr("xacro"));
  EXPECT_THAT(message_of(link_of("<sphere radius='1e999'/>")), HasSubstr("radius of <sphere>"));
  EXPECT_THAT(message_of(link_of("<cylinder radius='1'/>")), HasSubstr("a <cylinder> has no length"));
}

TEST(Urdf, JointsAreAForest) {
  const std::string links = "<link name='a'/><link name='b'/>\n";
  const auto joint = [](const std::string& parent, const std::string& child) {
    return "<joint name='j'><parent link='" + parent + "'/><child link='" + child + "'/></joint>\n";
  };
  EXPECT_THAT(message_of(robot_of(links + joint("a", "z"))), HasSubstr("the link \"z\", which is not there"));
  EXPECT_THAT(message_of(robot_of(links + "<joint name='j'/>")), HasSubstr("has no <parent link=...>"));
  EXPECT_THAT(message_of(robot_of(links + joint("a", "b") + joint("b", "a"))), HasSubstr("back to itself"));
  EXPECT_THAT(message_of(robot_of(links + joint("a", "a"))), HasSubstr("back to itself"));
  EXPECT_THAT(message_of(robot_of(links + joint("a", "b") + joint("a", "b"))), HasSubstr("child of two joints"));
}

TEST(Urdf, MissingFilesAndFoldersAreNamed) {
  const Result<Robot> missing = read_urdf_file("/nowhere/at/all.urdf");
  ASSERT_FALSE(missing.ok());
  EXPECT_THAT(missing.error().message, StartsWith("/nowhere/at/all.urdf: cannot be read: "));
  const Result<Robot> folder = read_urdf_file("/tmp");
  ASSERT_FALSE(folder.ok());
  EXPECT_THAT(folder.error().message, StartsWith("/tmp: "));
}

}  // namespace
}  // namespace medial_vk
