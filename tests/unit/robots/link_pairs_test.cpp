// Which links of a robot are compared, and the pairs in an SRDF.
#include "robots/model/link_pairs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace medial_vk {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct TestLink {
  std::uint32_t parent, child;
  JointKind kind;
};

Robot robot_with(std::size_t links, const std::vector<TestLink>& joints) {
  Robot robot;
  robot.name = "r";
  for (std::size_t i = 0; i < links; ++i) robot.links.push_back({"l" + std::to_string(i), {}, {}});
  for (const TestLink& link : joints) {
    Joint joint;
    joint.parent = link.parent, joint.child = link.child, joint.kind = link.kind;
    robot.joints.push_back(joint);
  }
  return robot;
}

constexpr JointKind kFixed = JointKind::kFixed, kTurns = JointKind::kRevolute;

TEST(LinkPairs, NeighboursAreJoined) {
  const Robot chain = robot_with(4, {{0, 1, kTurns}, {1, 2, kTurns}, {2, 3, kTurns}});
  const ChosenPairs pairs = choose_pairs(chain, std::vector<bool>(4, true));
  EXPECT_THAT(pairs.joined, ElementsAre(LinkPair{0, 1}, LinkPair{1, 2}, LinkPair{2, 3}));
  EXPECT_THAT(pairs.compared, ElementsAre(LinkPair{0, 2}, LinkPair{0, 3}, LinkPair{1, 3}));
}

/// Link 1, without a solid, stands for link 2 beside it. Links 2 and 4 are one solid with it and with 3, in turn.
TEST(LinkPairs, FixedJointsLeadOn) {
  const Robot robot = robot_with(5, {{0, 1, kTurns}, {1, 2, kFixed}, {2, 3, kTurns}, {3, 4, kFixed}});
  const ChosenPairs pairs = choose_pairs(robot, {true, false, true, true, true});
  EXPECT_THAT(pairs.joined, ElementsAre(LinkPair{0, 2}, LinkPair{2, 3}, LinkPair{3, 4}));
  // Link 4 is fixed to a link with a solid: it may still collide with link 2.
  EXPECT_THAT(pairs.compared, ElementsAre(LinkPair{0, 3}, LinkPair{0, 4}, LinkPair{2, 4}));
  EXPECT_THAT(rigid_links(robot), ElementsAre(0, 1, 1, 3, 3));
  EXPECT_THAT(moving_links(robot), ElementsAre(false, true, true, true, true));
}

TEST(LinkPairs, WhatIsFixedToTheRootRests) {
  const Robot robot = robot_with(4, {{2, 0, kFixed}, {2, 3, kTurns}, {3, 1, kFixed}});
  EXPECT_THAT(moving_links(robot), ElementsAre(false, true, false, true));
  EXPECT_THAT(choose_pairs(robot, {true, true, false, false}).compared, IsEmpty());
}

std::vector<LinkPair> srdf_pairs(const std::string& text) {
  const Result<std::vector<LinkPair>> pairs = read_srdf(text, "r.srdf", robot_with(3, {}));
  EXPECT_TRUE(pairs.ok()) << text;
  return pairs.ok() ? pairs.value() : std::vector<LinkPair>();
}

std::string srdf_message(const std::string& text) {
  const Result<std::vector<LinkPair>> pairs = read_srdf(text, "r.srdf", robot_with(3, {}));
  EXPECT_FALSE(pairs.ok()) << text;
  if (pairs.ok()) return {};
  EXPECT_EQ(pairs.error().code, ErrorCode::kInvalidMesh);
  EXPECT_THAT(pairs.error().message, testing::StartsWith("r.srdf:"));
  return pairs.error().message;
}

TEST(Srdf, PairsAreReadBack) {
  Robot robot = robot_with(3, {});
  robot.links[1].name = "a <b> & \"c\"";
  const std::vector<LinkPair> joined = {{0, 1}}, touching = {{1, 2}};
  const ReasonedPairs left_out[] = {{"Adjacent", joined}, {"Always", touching}};
  const std::string text = encode_srdf(robot, left_out);
  EXPECT_THAT(text, HasSubstr("reason=\"Always\""));
  const Result<std::vector<LinkPair>> pairs = read_srdf(text, "r.srdf", robot);
  ASSERT_TRUE(pairs.ok()) << pairs.error().message;
  EXPECT_THAT(pairs.value(), ElementsAre(LinkPair{0, 1}, LinkPair{1, 2}));
}

TEST(Srdf, PairsAreSortedAndDiffer) {
  EXPECT_THAT(srdf_pairs("<robot><group name='g'/><disable_collisions link1='l2' link2='l1'/>"
                         "<disable_collisions link1='l0' link2='l2' reason='x'/>"
                         "<disable_collisions link1='l1' link2='l2'/></robot>"),
              ElementsAre(LinkPair{0, 2}, LinkPair{1, 2}));
  EXPECT_THAT(srdf_pairs("<robot/>"), IsEmpty());
}

TEST(Srdf, Messages) {
  EXPECT_THAT(srdf_message(""), HasSubstr("empty"));
  EXPECT_THAT(srdf_message("<robot>"), HasSubstr("no well-formed XML"));
  EXPECT_THAT(srdf_message("<sdf/>"), HasSubstr("this is no SRDF"));
  EXPECT_THAT(srdf_message("<robot>\n<disable_collisions link1='l0'/></robot>"),
              testing::AllOf(HasSubstr("r.srdf:2: "), HasSubstr("no link2")));
  EXPECT_THAT(srdf_message("<robot><disable_collisions link1='l0' link2='x'/></robot>"), HasSubstr("\"x\""));
  EXPECT_THAT(srdf_message("<robot><disable_collisions link1='l0' link2='l0'/></robot>"), HasSubstr("twice"));
}

}  // namespace
}  // namespace medial_vk
