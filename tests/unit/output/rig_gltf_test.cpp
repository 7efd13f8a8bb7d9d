// The balls of a rig as nodes of the scene: nothing else of it changes, and every engine can place them.
#include "output/rig_files/rig_gltf.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "motion_files/mesh_motion.h"
#include "unit/motion_files/animations.h"

namespace medial_vk {
namespace {

using test::skinned_animation;

/// A skinned tetrahedron, and two balls below its second joint; the third has no radius.
struct BoundBalls {
  MotionRig rig;
  BallRig balls;

  BoundBalls() {
    rig.joints.resize(2);
    rig.joints[1].node = 1;
    rig.joints[1].parent = 0;
    rig.joints[1].rest = AffineMap(AffineMap::Rows{{{0, -4, 0, 5}, {4, 0, 0, 0}, {0, 0, 4, 1}}});
    balls.frames = 3;
    balls.joint_stretches = {1, 4};
    balls.balls.resize(3);
    for (RigBall& ball : balls.balls) {
      ball.joints = {{1, 1, {0.1, 0.2, 1.0 / 3}}};
      ball.radius = 0.5;
      ball.rest_radius = 0.625;
      ball.reach_out = 0.125;
    }
    balls.balls[1].radius = 0;
    balls.balls[1].reach_out = 0.75;
  }

  RigFile file() const { return {"1.2", "bow.glb", rig, balls}; }
};

GltfSource source_of(const std::string& glb) {
  return *parse_animation(glb, "bow.glb", "", {.keep_source = true}).value()->source();
}

TEST(RigGltf, AddsNodesBelowJointsAndKeepsTheRest) {
  const BoundBalls bound;
  const GltfSource source = source_of(skinned_animation().glb());
  const Result<std::string> glb = encode_rig_gltf(bound.file(), source, true);
  ASSERT_TRUE(glb.ok());
  const GltfSource copy = source_of(glb.value());
  EXPECT_EQ(copy.binary, source.binary);
  auto before = nlohmann::json::parse(source.json), after = nlohmann::json::parse(copy.json);
  ASSERT_EQ(after["nodes"].size(), before["nodes"].size() + 2) << "a ball without a radius is none";
  const auto first = static_cast<int>(before["nodes"].size());
  EXPECT_EQ(after["nodes"][1]["children"], nlohmann::json({first, first + 1}));
  const auto node = after["nodes"][first + 1];
  EXPECT_EQ(node["name"], "medial_ball_2");
  EXPECT_EQ(node["translation"], (std::vector<double>{0.1, 0.2, 1.0 / 3}));
  EXPECT_EQ(node["scale"], (std::vector<double>{0.125, 0.125, 0.125})) << "the joint enlarges it four times";
  EXPECT_EQ(node["extras"]["medial_vk"]["ball"], 2);
  EXPECT_EQ(node["extras"]["medial_vk"]["radius"], 0.5);
  EXPECT_EQ(node["extras"]["medial_vk"]["rest_radius"], 0.625);
  EXPECT_EQ(node["extras"]["medial_vk"]["reach_out"], 0.125);
  EXPECT_EQ(node["extras"]["medial_vk"]["joints"], nlohmann::json({1}));
  EXPECT_EQ(node["extras"]["medial_vk"]["weights"], nlohmann::json({1}));
  EXPECT_EQ(after["extras"]["medial_vk"]["balls"], 2);
  EXPECT_EQ(after["extras"]["medial_vk"]["frames"], 3);
  EXPECT_EQ(after["extras"]["medial_vk"]["greatest_reach_out"], 0.125) << "of the nodes";
  // All else is as it was.
  after.erase("extras");
  after["nodes"].erase(static_cast<std::size_t>(first) + 1);
  after["nodes"].erase(static_cast<std::size_t>(first));
  after["nodes"][1].erase("children");
  EXPECT_EQ(after, before);
}

TEST(RigGltf, GlbHasItsLengthsAndAlignment) {
  const BoundBalls bound;
  for (const std::string name : {"", "a", "ab", "abc"}) {  // the JSON in every length modulo 4
    test::AnimationWriter writer = skinned_animation();
    writer.document["nodes"][0]["name"] = name;
    const std::string glb = encode_rig_gltf(bound.file(), source_of(writer.glb()), true).value();
    ASSERT_EQ(glb.substr(0, 4), "glTF");
    const auto word = [&](std::size_t at) {
      std::uint32_t value = 0;
      for (std::size_t k = 0; k < 4; ++k) value |= std::uint32_t{static_cast<unsigned char>(glb[at + k])} << (8 * k);
      return value;
    };
    EXPECT_EQ(word(4), 2u);
    EXPECT_EQ(word(8), glb.size());
    const std::size_t length = word(12);
    EXPECT_EQ(length % 4, 0u);
    EXPECT_EQ(word(20 + length) % 4, 0u);
    EXPECT_EQ(28 + length + word(20 + length), glb.size());
  }
}

TEST(RigGltf, TextHoldsTheBinaryChunk) {
  const BoundBalls bound;
  const GltfSource source = source_of(skinned_animation().glb());
  const std::string text = encode_rig_gltf(bound.file(), source, false).value();
  const auto motion = parse_animation(text, "bow.gltf", "", {.frames = 2, .keep_source = true});
  ASSERT_TRUE(motion.ok()) << motion.error().message;
  MotionFrame frame;
  ASSERT_TRUE(motion.value()->read_frame(1, frame).ok());
  const std::vector<Point> expected = test::skinned_frame(1);
  for (std::size_t v = 0; v < expected.size(); ++v) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(frame.positions[v][k], expected[v][k], 1e-6);
  }
  EXPECT_FALSE(names_other_files(*motion.value()->source()));
}

TEST(RigGltf, RemarksOfTheSceneStay) {
  const BoundBalls bound;
  test::AnimationWriter writer = skinned_animation();
  writer.document["extras"] = {{"author", "someone"}};
  const auto both = nlohmann::json::parse(encode_rig_gltf(bound.file(), source_of(writer.glb()), false).value());
  EXPECT_EQ(both["extras"]["author"], "someone");
  EXPECT_EQ(both["extras"]["medial_vk"]["balls"], 2);
  writer.document["extras"] = "no object";
  const auto one = nlohmann::json::parse(encode_rig_gltf(bound.file(), source_of(writer.glb()), false).value());
  EXPECT_EQ(one["extras"], "no object");
}

TEST(RigGltf, NamesOfFilesMayHoldAnyBytes) {
  const BoundBalls bound;
  const GltfSource source = source_of(skinned_animation().glb());
  const RigFile file = {"1.2", "bow\xff.glb", bound.rig, bound.balls};
  for (const bool is_glb : {false, true}) {
    const Result<std::string> copy = encode_rig_gltf(file, source, is_glb);
    ASSERT_TRUE(copy.ok());
    const std::string text = is_glb ? source_of(copy.value()).json : copy.value();
    EXPECT_EQ(nlohmann::json::parse(text)["extras"]["medial_vk"]["mesh"], "bow\xef\xbf\xbd.glb");
  }
}

TEST(RigGltf, TheDeepestSourceIsCopied) {
  const BoundBalls bound;
  test::AnimationWriter writer = skinned_animation();
  nlohmann::json deep = nlohmann::json::array();
  for (std::uint64_t level = 3; level < kMostSourceLevels; ++level) deep = nlohmann::json::array({std::move(deep)});
  writer.document["asset"]["extras"] = std::move(deep);
  for (const bool is_glb : {false, true}) {
    const GltfSource source = source_of(writer.glb());
    const Result<std::string> copy = encode_rig_gltf(bound.file(), source, is_glb);
    ASSERT_TRUE(copy.ok());
    const auto again = parse_animation(copy.value(), "copy", "", {.keep_source = true});
    ASSERT_TRUE(again.ok()) << again.error().message;
  }
}

TEST(RigGltf, OtherFilesAreSeen) {
  GltfSource source = {R"({"buffers":[{"byteLength":4}],"images":[{"bufferView":0},{"uri":"data:image/png;base64,"}]})",
                       ""};
  EXPECT_FALSE(names_other_files(source));
  source.json = R"({"images":[{"uri":"skin.png"}]})";
  EXPECT_TRUE(names_other_files(source));
  source.json = R"({"buffers":[{"byteLength":4,"uri":"walk.bin"}]})";
  EXPECT_TRUE(names_other_files(source));
}

TEST(RigGltf, SourceIsKeptOnRequestOnly) {
  EXPECT_EQ(parse_animation(skinned_animation().glb(), "bow.glb", "").value()->source(), nullptr);
}

}  // namespace
}  // namespace medial_vk
