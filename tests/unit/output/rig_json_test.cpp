// The balls of a rig as JSON: matrices column by column, and numbers that read back.
#include "output/rig_files/rig_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace medial_vk {
namespace {

TEST(RigJson, HoldsJointsAndBalls) {
  MotionRig rig;
  rig.joints.resize(2);
  rig.joints[0].name = "hip \"left\"\xff";
  rig.joints[1].name = "knee";
  rig.joints[1].node = 17;
  rig.joints[1].parent = 0;
  rig.joints[1].rest = AffineMap(AffineMap::Rows{{{1, 2, 3, 4}, {5, 6, 7, 8}, {9, 10, 11, 12}}});
  BallRig balls;
  balls.frames = 7;
  balls.balls.resize(1);
  balls.balls[0].radius = 1.0 / 3;
  balls.balls[0].rest_radius = 0.5;
  balls.balls[0].reach_out = 0.25;
  balls.balls[0].joints = {{1, 0.75, {0.1, 0.2, 0.3}}, {0, 0.25, {1, 2, 3}}};
  const auto file = nlohmann::json::parse(encode_rig({"1.2", "dancer.glb", rig, balls}));
  EXPECT_EQ(file["format"], 1);
  EXPECT_EQ(file["mesh"], "dancer.glb");
  EXPECT_EQ(file["frames"], 7);
  EXPECT_EQ(file["greatest_reach_out"], 0.25);
  EXPECT_TRUE(file["joints"][0]["parent"].is_null());
  EXPECT_EQ(file["joints"][1]["parent"], 0);
  EXPECT_EQ(file["joints"][1]["node"], 17) << "of the scene";
  EXPECT_EQ(file["joints"][1]["rest_matrix"], (std::vector<double>{1, 5, 9, 0, 2, 6, 10, 0, 3, 7, 11, 0, 4, 8, 12, 1}));
  const auto& ball = file["balls"][0];
  EXPECT_EQ(ball["radius"], 1.0 / 3) << "the same double";
  EXPECT_EQ(ball["rest_radius"], 0.5);
  ASSERT_EQ(ball["joints"].size(), 2u);
  EXPECT_EQ(ball["joints"][0]["joint"], 1);
  EXPECT_EQ(ball["joints"][0]["weight"], 0.75);
  EXPECT_EQ(ball["joints"][0]["place"], (std::vector<double>{0.1, 0.2, 0.3}));
}

}  // namespace
}  // namespace medial_vk
