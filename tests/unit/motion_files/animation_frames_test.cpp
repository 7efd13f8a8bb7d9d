// Frames of animations in glTF: skins, shapes and nodes, against closed forms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "assimp_scenes/read_scene.h"
#include "motion_files/mesh_motion.h"
#include "support/scenes/scene_files.h"
#include "support/solids/solids.h"
#include "unit/motion_files/animations.h"

namespace medial_vk {
namespace {

using namespace test;
using nlohmann::json;
using testing::ElementsAre;

std::unique_ptr<MeshMotion> motion_of(const std::string& bytes, const AnimationOptions& options = {}) {
  Result<std::unique_ptr<MeshMotion>> motion = parse_animation(bytes, "a.glb", "", options);
  EXPECT_TRUE(motion.ok()) << motion.error().message;
  return motion.ok() ? std::move(motion).value() : nullptr;
}

MotionFrame frame_of(const MeshMotion& motion, std::uint64_t index) {
  MotionFrame frame;
  const Status status = motion.read_frame(index, frame);
  EXPECT_TRUE(status.ok()) << status.error().message;
  return frame;
}

void expect_near(const std::vector<Point>& positions, const std::vector<Point>& expected, double error) {
  ASSERT_EQ(positions.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(positions[i][k], expected[i][k], error) << "vertex " << i;
  }
}

// The only numbers of the file that are not exact are the two square roots of 1/2. As floats they are equal, so that
// the angle is exact, and their length becomes 1: what remains is rounding in double, of some twenty operations on
// numbers below 8: at most 20 * 8 * 2^-53.
constexpr double kRounding = 160 * 0x1p-53;

TEST(AnimationFrames, SkinnedVerticesFollowTheirJoints) {
  for (const std::string& bytes : {skinned_animation().glb(), skinned_animation().gltf()}) {
    const auto motion = motion_of(bytes, {.frames_per_second = 8});
    ASSERT_TRUE(motion);
    ASSERT_EQ(motion->frame_count(), 9u);
    expect_near(motion->rest().vertices, skinned_frame(0), 0);
    EXPECT_EQ(motion->rest().triangles, animated_tetrahedron().triangles);
    EXPECT_EQ(motion->separable_vertices(), 0u);
    for (const std::uint64_t i : {8u, 0u, 3u, 5u}) {
      const MotionFrame frame = frame_of(*motion, i);
      expect_near(frame.positions, skinned_frame(static_cast<double>(i) / 8), kRounding);
      EXPECT_EQ(frame.time, static_cast<double>(i) / 8);
    }
    EXPECT_EQ(frame_of(*motion, 1).name, "bow 0.1250 s");
  }
}

TEST(AnimationFrames, TheRigGivesTheSamePositions) {
  const auto motion = motion_of(skinned_animation().glb(), {.frames_per_second = 8});
  ASSERT_TRUE(motion);
  const MotionRig& rig = *motion->rig();
  ASSERT_EQ(rig.joints.size(), 2u);
  EXPECT_EQ(rig.joints[0].name, "base");
  EXPECT_EQ(rig.joints[0].parent, RigJoint::kNone);
  EXPECT_EQ(rig.joints[1].name, "tip");
  EXPECT_EQ(rig.joints[1].parent, 0u);
  EXPECT_EQ(rig.joints[1].rest(Point{0, 0, 0}), (Point{5, 0, 1}));
  EXPECT_FALSE(rig.has_shapes);
  EXPECT_THAT(rig.influences_of(1), ElementsAre(RigInfluence{0, .75}, RigInfluence{1, .25}));
  EXPECT_THAT(rig.influences_of(3), ElementsAre(RigInfluence{1, 1}));
  const MotionFrame frame = frame_of(*motion, 5);
  ASSERT_EQ(frame.joints.size(), 2u);
  for (std::size_t v = 0; v < rig.bind_positions.size(); ++v) {
    Point sum = {0, 0, 0};
    for (const RigInfluence& influence : rig.influences_of(v)) {
      const AffineMap map = frame.joints[influence.joint] * rig.joints[influence.joint].inverse_bind;
      for (std::size_t k = 0; k < 3; ++k) sum[k] += influence.weight * map(rig.bind_positions[v])[k];
    }
    expect_near({sum}, {frame.positions[v]}, kRounding);
  }
}

TEST(AnimationFrames, AllSetsOfJointsCount) {
  // The tip has five joints of equal weight, four in the first set: the fourth and the fifth move along x.
  AnimationWriter writer(
      {{{"mesh", 0}, {"skin", 0}}, json::object(), json::object(), json::object(), json::object(), json::object()},
      {0, 1, 2, 3, 4, 5});
  writer.add_mesh(animated_tetrahedron());
  writer.add_influences(0, {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 1, 2, 3}},
                        {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1});
  writer.add_influences(1, {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, {4, 0, 0, 0}},
                        {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 4, 0, 0, 0});
  writer.document["skins"] = {{{"joints", {1, 2, 3, 4, 5}}}};
  writer.add_channel(4, "translation", {0, 1}, {0, 0, 0, 8, 0, 0});
  writer.add_channel(5, "translation", {0, 1}, {0, 0, 0, 16, 0, 0});
  const auto motion = motion_of(writer.glb(), {.frames = 2});
  ASSERT_TRUE(motion);
  // Weights 1, 1, 1, 1 and 4 have the sum 8: 1/8 of 8 and 1/2 of 16.
  EXPECT_EQ(frame_of(*motion, 1).positions[3], (Point{9, 0, 3}));
  EXPECT_EQ(frame_of(*motion, 1).positions[1], (Point{1, 0, 0}));
}

TEST(AnimationFrames, ShapesAreAddedByTheirWeightsOfAnySign) {
  const auto motion =
      motion_of(morphing_animation("LINEAR", {1, 2, 4}, {0, 0, 1, -2, .5, 3}).glb(), {.frames_per_second = 4});
  ASSERT_TRUE(motion);
  ASSERT_EQ(motion->frame_count(), 13u);
  EXPECT_TRUE(motion->rig()->has_shapes);
  EXPECT_EQ(motion->rest().vertices, animated_tetrahedron().vertices);
  for (std::uint64_t i = 0; i <= 12; ++i) {
    const double t = static_cast<double>(i) / 4, u = (t - 1) / 2;
    EXPECT_EQ(frame_of(*motion, i).positions, t <= 1 ? morphed(t, -2 * t) : morphed(1 - .5 * u, -2 + 5 * u)) << t;
    EXPECT_EQ(frame_of(*motion, i).time, 1 + t);
  }
}

TEST(AnimationFrames, StepsHoldTheKeyBefore) {
  const auto motion =
      motion_of(morphing_animation("STEP", {0, 1, 2}, {1, 2, 3, 4, 5, 6}).glb(), {.frames_per_second = 4});
  ASSERT_TRUE(motion);
  for (const std::uint64_t i : {0u, 3u}) EXPECT_EQ(frame_of(*motion, i).positions, morphed(1, 2));
  for (const std::uint64_t i : {4u, 7u}) EXPECT_EQ(frame_of(*motion, i).positions, morphed(3, 4));
  EXPECT_EQ(frame_of(*motion, 8).positions, morphed(5, 6));
}

TEST(AnimationFrames, CubicSplinesHaveTheTangentsOfTheFile) {
  // By key: tangents before, values, tangents behind, of two weights each. 2 seconds from key to key.
  const std::vector<double> values = {9, 9, 0, 1, 2, -4, 1, 8, 4, 1, 9, 9};
  const auto motion = motion_of(morphing_animation("CUBICSPLINE", {0, 2}, values).glb(), {.frames_per_second = 2});
  ASSERT_TRUE(motion);
  ASSERT_EQ(motion->frame_count(), 5u);
  for (std::uint64_t i = 0; i <= 4; ++i) {
    const double t = static_cast<double>(i) / 4, t2 = t * t, t3 = t2 * t;
    const auto value = [&](double from, double leaving, double to, double arriving) {
      return from * (2 * t3 - 3 * t2 + 1) + 2 * leaving * (t3 - 2 * t2 + t) + to * (3 * t2 - 2 * t3) +
             2 * arriving * (t3 - t2);
    };
    EXPECT_EQ(frame_of(*motion, i).positions, morphed(value(0, 2, 4, 1), value(1, -4, 1, 8))) << t;
  }
}

TEST(AnimationFrames, WeightsWithoutAChannelAreThoseOfNodeOrMesh) {
  for (const bool of_node : {false, true}) {
    AnimationWriter writer = morphing_animation("LINEAR", {0, 1}, {0, 0, 0, 0});
    writer.document.erase("animations");
    writer.document["meshes"][0]["weights"] = {2, 1};
    if (of_node) writer.document["nodes"][0]["weights"] = {3, 0};
    writer.add_channel(0, "translation", {0, 1}, {0, 0, 0, 0, 0, 1});
    const auto motion = motion_of(writer.glb(), {.frames = 1});
    ASSERT_TRUE(motion);
    EXPECT_EQ(frame_of(*motion, 0).positions, of_node ? morphed(3, 0) : morphed(2, 1));
    EXPECT_EQ(motion->rest().vertices, morphed(0, 0)) << "as the tool reads every scene";
  }
}

TEST(AnimationFrames, NodesCarryTheirMeshesAndTheNodesBelow) {
  AnimationWriter writer(json::array({{{"name", "arm"}, {"children", {1}}, {"translation", {1, 2, 3}}},
                                      {{"name", "hand"}, {"mesh", 0}, {"scale", {2, 1, 1}}}}));
  writer.add_mesh(animated_tetrahedron());
  writer.add_channel(0, "translation", {0, 1}, {1, 2, 3, 5, 2, 3});
  writer.add_channel(1, "scale", {0, .5, 1}, {2, 1, 1, 2, 4, 1, 1, 1, 1}, "STEP");
  const auto motion = motion_of(writer.glb(), {.frames_per_second = 4});
  ASSERT_TRUE(motion);
  for (std::uint64_t i = 0; i <= 4; ++i) {
    const Point scale = i < 2 ? Point{2, 1, 1} : i < 4 ? Point{2, 4, 1} : Point{1, 1, 1};
    std::vector<Point> expected = animated_tetrahedron().vertices;
    for (Point& p : expected)
      p = {1 + static_cast<double>(i) + scale[0] * p[0], 2 + scale[1] * p[1], 3 + scale[2] * p[2]};
    EXPECT_EQ(frame_of(*motion, i).positions, expected) << i;
  }
  ASSERT_EQ(motion->rig()->joints.size(), 1u) << "the node that shows the mesh";
  EXPECT_EQ(motion->rig()->joints[0].name, "hand");
}

TEST(AnimationFrames, RotationsTakeTheShorterWay) {
  // Half a turn about z in two equal steps, the second of which ends at the negative quaternion of the same rotation.
  AnimationWriter writer(json::array({{{"mesh", 0}}}));
  writer.add_mesh(animated_tetrahedron());
  const double half = std::sqrt(.5);
  writer.add_channel(0, "rotation", {0, 1, 2}, {0, 0, 0, 1, 0, 0, half, half, 0, 0, -1, 0});
  const auto motion = motion_of(writer.glb(), {.frames_per_second = 4});
  ASSERT_TRUE(motion);
  for (std::uint64_t i = 0; i <= 8; ++i) {
    const double angle = static_cast<double>(i) / 4 * std::acos(0);
    std::vector<Point> expected = animated_tetrahedron().vertices;
    for (Point& p : expected) {
      p = {std::cos(angle) * p[0] - std::sin(angle) * p[1], std::sin(angle) * p[0] + std::cos(angle) * p[1], p[2]};
    }
    expect_near(frame_of(*motion, i).positions, expected, kRounding);
  }
}

TEST(AnimationFrames, NormalizedAndSparseNumbersAreRead) {
  AnimationWriter writer = skinned_animation();
  // Weights as bytes: 3/4 and 1/4 are 191.25 and 63.75 of 255, so take 204 and 51: 4/5 and 1/5.
  std::string weights(16, '\0');
  for (const int full : {0, 8, 12}) weights[static_cast<std::size_t>(full)] = '\xff';
  weights[4] = static_cast<char>(204);
  weights[5] = static_cast<char>(51);
  writer.primitive()["attributes"]["WEIGHTS_0"] =
      writer.add_accessor(weights, GltfWriter::kByte, "VEC4", 4, {{"normalized", true}});
  // A shape of zeros, in which only the third corner moves.
  const int index = writer.add_accessor(bytes_of(std::uint32_t{2}, false), GltfWriter::kUint, "SCALAR", 1);
  const int value = writer.add_floats({0, 0, .5}, "VEC3", 3);
  const auto view = [&](int accessor) {
    return writer.document["accessors"][static_cast<std::size_t>(accessor)]["bufferView"];
  };
  writer.document["accessors"].push_back(
      {{"componentType", GltfWriter::kFloat},
       {"count", 4},
       {"type", "VEC3"},
       {"sparse",
        {{"count", 1},
         {"indices", {{"bufferView", view(index)}, {"componentType", GltfWriter::kUint}}},
         {"values", {{"bufferView", view(value)}}}}}});
  writer.primitive()["targets"] = {{{"POSITION", writer.document["accessors"].size() - 1}}};
  writer.add_channel(2, "weights", {0, 1}, {0, 2});
  const auto motion = motion_of(writer.glb(), {.frames = 2});
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->rig()->influences_of(1)[0].weight, .8, 1e-15);
  EXPECT_NEAR(motion->rig()->influences_of(1)[1].weight, .2, 1e-15);
  expect_near({frame_of(*motion, 1).positions[2]}, {{5, 2, 1}}, kRounding);
}

TEST(AnimationFrames, AreAtTheTimesThatAreAskedFor) {
  const std::string bytes = morphing_animation("LINEAR", {.5, 2.5}, {0, 0, 1, 0}).glb();
  const auto times = [&](const AnimationOptions& options) {
    std::vector<double> all;
    const auto motion = motion_of(bytes, options);
    for (std::uint64_t i = 0; motion && i < motion->frame_count(); ++i) all.push_back(*frame_of(*motion, i).time);
    return all;
  };
  EXPECT_THAT(times({.frames_per_second = 1}), ElementsAre(.5, 1.5, 2.5));
  EXPECT_THAT(times({.frames_per_second = .6}), ElementsAre(.5, .5 + 1 / .6));
  EXPECT_THAT(times({.frames = 5}), ElementsAre(.5, 1, 1.5, 2, 2.5));
  EXPECT_THAT(times({.frames = 1, .start = 2}), ElementsAre(2));
  EXPECT_THAT(times({.frames = 3, .start = 1, .end = 1.5}), ElementsAre(1, 1.25, 1.5));
  EXPECT_THAT(times({.frames_per_second = 2, .start = 2, .end = 3}), ElementsAre(2, 2.5, 3));
  EXPECT_EQ(times({}).size(), 61u);
  // Before the first key and behind the last one the mesh stands still.
  const auto still = motion_of(bytes, {.frames = 2, .start = -1, .end = 5});
  ASSERT_TRUE(still);
  EXPECT_EQ(frame_of(*still, 0).positions, morphed(0, 0));
  EXPECT_EQ(frame_of(*still, 1).positions, morphed(1, 0));
}

// A third of a second as a float is above 1/3, one tenth, too: a frame must not be lost to that, and none be added.
TEST(AnimationFrames, TheLastKeyIsAFrameWhereTimesAreRounded) {
  for (const double rate : {24., 25., 30., 60.}) {
    for (const int last : {1, 7, 10, 100, 1001}) {
      const std::string bytes = morphing_animation("LINEAR", {0, last / rate}, {0, 0, 1, 0}).glb();
      const auto motion = motion_of(bytes, {.frames_per_second = rate});
      ASSERT_TRUE(motion);
      EXPECT_EQ(motion->frame_count(), static_cast<std::uint64_t>(last) + 1) << rate;
    }
  }
}

TEST(AnimationFrames, SeamsAreOneVertexAndCountedIfTheyMayOpen) {
  for (const bool opens : {false, true}) {
    AnimationWriter writer(json::array({{{"mesh", 0}}}));
    Mesh seam = animated_tetrahedron();
    seam.vertices.push_back(seam.vertices[3]);
    seam.triangles[3][2] = 4;
    writer.add_mesh(seam);
    writer.add_shape({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 4, 0, 0, opens ? 5. : 4.});
    writer.add_channel(0, "weights", {0, 1}, {0, 1});
    const auto motion = motion_of(writer.glb(), {.frames = 2});
    ASSERT_TRUE(motion);
    EXPECT_EQ(motion->rest().vertices, animated_tetrahedron().vertices);
    EXPECT_EQ(motion->separable_vertices(), opens ? 1u : 0u);
    EXPECT_EQ(frame_of(*motion, 1).positions, morphed(1, 0));
  }
}

// ---- The mesh at rest is that of read_mesh_file().

using Corners = std::vector<std::array<Point, 3>>;

Corners corners_of(const Mesh& mesh) {
  Corners corners;
  for (const Triangle& t : mesh.triangles) {
    corners.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
  }
  return corners;
}

void expect_as_assimp_reads(const std::string& bytes) {
  const Result<std::vector<ScenePart>> parts = read_scene({.bytes = bytes, .name = "a", .format = "gltf", .path = ""});
  ASSERT_TRUE(parts.ok()) << parts.error().message;
  const Result<Mesh> expected = join_parts(parts.value(), "a");
  ASSERT_TRUE(expected.ok());
  const auto motion = motion_of(bytes);
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->rest().vertices.size(), expected.value().vertices.size());
  const Corners own = corners_of(motion->rest()), others = corners_of(expected.value());
  ASSERT_EQ(own.size(), others.size());
  // assimp composes the matrices of nodes in float: some units of 2^-24 of the largest coordinate, 40.
  for (std::size_t i = 0; i < own.size(); ++i) {
    expect_near({own[i].begin(), own[i].end()}, {others[i].begin(), others[i].end()}, 8 * 40 * 0x1p-24);
  }
}

bool has_assimp() {
  const Result<std::vector<ScenePart>> any = read_scene({.bytes = "{", .name = "a", .format = "gltf", .path = ""});
  return any.error().message.find("this build reads no") == std::string::npos;
}

TEST(AnimationFrames, TheRestIsTheMeshThatTheToolReadsOtherwise) {
  if (!has_assimp()) GTEST_SKIP() << "a build without assimp";
  expect_as_assimp_reads(skinned_animation().gltf());
  expect_as_assimp_reads(morphing_animation("LINEAR", {0, 1}, {0, 0, 1, 1}).gltf());
  // A mesh that a node shows with a skin and another without is left out: assimp has the joints in the mesh, for both.
  SceneMesh two = {{make_box({1, 2, 3}), make_box({3, 1, 1})}};
  SceneMesh lines = {{make_box({1, 1, 1})}, 1};
  const std::vector<SceneNode> nodes = {
      {.name = "far", .translation = {10, 20, 30}},
      {.name = "a", .mesh = 0, .parent = 0, .rotation = {.5, .5, -.5, .5}, .scale = {2, -1, 3}},
      {.name = "b", .mesh = 1, .parent = 1, .translation = {1, 0, 0}},
      {.name = "c", .mesh = 0, .scale = {-1, -1, -1}},
      {.name = "d", .mesh = 3, .skin = 1},
      {.name = "e", .mesh = 2}};
  json document = json::parse(to_gltf({two, {{make_box({2, 2, 2})}}, lines, {{make_box({1, 2, 1})}}}, nodes).text);
  document["animations"] = {
      {{"channels", json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}})},
       {"samplers", json::array({{{"input", 0}, {"output", 1}}})}}};
  // Keys in a buffer of their own: at 0 and 1, the origin and (0, 0, 1).
  AnimationWriter keys(json::array());
  keys.add_channel(0, "translation", {0, 1}, {0, 0, 0, 0, 0, 1});
  keys.gltf();
  const auto accessors = document["accessors"].size(), views = document["bufferViews"].size();
  for (json view : keys.document["bufferViews"]) {
    view["buffer"] = 1;
    document["bufferViews"].push_back(view);
  }
  for (json accessor : keys.document["accessors"]) {
    accessor["bufferView"] = accessor["bufferView"].get<std::size_t>() + views;
    document["accessors"].push_back(accessor);
  }
  document["buffers"].push_back(keys.document["buffers"][0]);
  document["animations"][0]["samplers"][0] = {{"input", accessors}, {"output", accessors + 1}};
  expect_as_assimp_reads(document.dump());
}

}  // namespace
}  // namespace medial_vk
