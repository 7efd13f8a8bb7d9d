// `medial-vk follow --rig` with a scene: its balls are where the file says, for every engine that reads it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "motion_files/mesh_motion.h"
#include "support/solids/mesh_files.h"
#include "tool_test.h"
#include "unit/motion_files/animations.h"

namespace medial_vk {
namespace {

using test::ToolResult;
using testing::HasSubstr;

class FollowRigNodes : public test::ToolTest {};

/// How deep a point lies in a tetrahedron: the least distance from the plane of a face, negative outside.
double depth_in(const Mesh& tetrahedron, const std::vector<Point>& corners, const Point& p) {
  double depth = 1e9;
  for (const Triangle& t : tetrahedron.triangles) {
    std::array<Point, 2> sides;
    Point from_corner;
    for (std::size_t k = 0; k < 3; ++k) {
      sides[0][k] = corners[t[1]][k] - corners[t[0]][k];
      sides[1][k] = corners[t[2]][k] - corners[t[0]][k];
      from_corner[k] = corners[t[0]][k] - p[k];
    }
    const Point normal = {sides[0][1] * sides[1][2] - sides[0][2] * sides[1][1],
                          sides[0][2] * sides[1][0] - sides[0][0] * sides[1][2],
                          sides[0][0] * sides[1][1] - sides[0][1] * sides[1][0]};
    double along = 0, squared = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      along += normal[k] * from_corner[k];
      squared += normal[k] * normal[k];
    }
    depth = std::min(depth, along / std::sqrt(squared));
  }
  return depth;
}

/// The scene of a file with balls as nodes, as an engine reads it: joints and positions of the rest pose and of all
/// frames.
struct SceneWithBalls {
  std::unique_ptr<MeshMotion> motion;
  nlohmann::json file;
  std::vector<MotionFrame> frames;

  explicit SceneWithBalls(const std::string& path) {
    motion = open_animation(path, {.frames_per_second = 4, .keep_source = true}).value();
    file = nlohmann::json::parse(motion->source()->json);
    MotionFrame at_rest;
    for (const RigJoint& joint : motion->rig()->joints) at_rest.joints.push_back(joint.rest);
    at_rest.positions = motion->rest().vertices;
    frames = {at_rest};
    for (std::uint64_t i = 0; i < motion->frame_count(); ++i) {
      EXPECT_TRUE(motion->read_frame(i, frames.emplace_back()).ok());
    }
  }

  /// The nodes of balls below a joint.
  std::vector<nlohmann::json> balls_below(std::size_t joint) const {
    std::vector<nlohmann::json> balls;
    const auto above = file["nodes"][motion->rig()->joints[joint].node];
    for (const auto& child : above.value("children", nlohmann::json::array())) {
      const auto node = file["nodes"][child.get<std::size_t>()];
      if (node.contains("extras")) balls.push_back(node);
    }
    return balls;
  }
};

/// Points evenly on the unit sphere, and those on the axes.
std::vector<Point> directions() {
  std::vector<Point> all = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int i = 0; i < 500; ++i) {
    const double z = (2 * i - 499) / 500.0, across = std::sqrt(1 - z * z), angle = 2.399963 * i;
    all.push_back({across * std::cos(angle), across * std::sin(angle), z});
  }
  return all;
}

// Joints that stretch at rest or in the motion make ellipsoids of the unit balls of nodes.
TEST_F(FollowRigNodes, NodesOfBallsAreInsideWhereJointsScale) {
  test::write_file(path("balls.csv"), "x,y,z,radius\n5.25,0.25,0.25,0.125\n5.2,0.3,1.1,0.1\n5.3,0.4,0.6,0.2\n");
  std::vector<test::AnimationWriter> writers(3, test::skinned_animation(0.3));
  writers[0].document["nodes"][1]["scale"] = {1, 4, 1};
  writers[1].add_channel(1, "scale", {0, 1}, {1, 1, 1, 1.5, 3, 1});
  writers[2].document["nodes"][0]["scale"] = {1, 1.5, 0.75};
  writers[2].add_channel(1, "scale", {0, 1}, {1, 1, 1, 0.5, 0.25, 0.5});
  for (test::AnimationWriter& writer : writers) {
    test::write_file(path("bow.glb"), writer.glb());
    const ToolResult result =
        run({"follow", "bow.glb", "--balls", "balls.csv", "--fps", "4", "--rig", "rig.glb", "-o", "bow.csv"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const SceneWithBalls scene(path("rig.glb"));
    std::size_t balls = 0;
    for (std::size_t joint = 0; joint < scene.motion->rig()->joints.size(); ++joint) {
      for (const nlohmann::json& node : scene.balls_below(joint)) {
        const double scale = node["scale"][0], radius = node["extras"]["medial_vk"]["radius"];
        const auto place = node["translation"].get<Point>();
        double longest = 0;
        for (const MotionFrame& frame : scene.frames) {
          const Point centre = frame.joints[joint](place);
          for (const Point& d : directions()) {
            const Point p =
                frame.joints[joint]({place[0] + scale * d[0], place[1] + scale * d[1], place[2] + scale * d[2]});
            // Rounding of positions of length 10 in a few operations.
            EXPECT_GE(depth_in(scene.motion->rest(), frame.positions, p), -1e-12) << node.dump();
            longest = std::max(longest, std::hypot(p[0] - centre[0], p[1] - centre[1], p[2] - centre[2]));
          }
        }
        EXPECT_LE(longest, radius + 1e-12);
        // Some direction, or its opposite, is within 0.14 of that of the greatest stretch: a cosine above 0.99.
        EXPECT_GE(longest, 0.99 * radius) << "no smaller than it must be";
        ++balls;
      }
    }
    EXPECT_EQ(scene.file["extras"]["medial_vk"]["balls"], balls);
    EXPECT_GE(balls, 2u) << "a centre may leave the solid in one of the motions";
  }
}

// The file alone, as an engine reads it, has the balls that its numbers promise in every frame.
TEST_F(FollowRigNodes, BallsOfARigAreNodesOfTheScene) {
  test::write_file(path("bow.glb"), test::skinned_animation(0.3).glb());
  test::write_file(path("balls.csv"),
                   "x,y,z,radius\n5.25,0.25,0.25,0.125\n5.125,0.25,2,0.0625\n5.2,0.3,1.1,0.1\n5.3,0.4,0.6,0.2\n");
  for (const std::string name : {"rig.glb", "rig.gltf"}) {
    const ToolResult result =
        run({"follow", "bow.glb", "--balls", "balls.csv", "--fps", "4", "--rig", name, "-o", "bow.csv"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const SceneWithBalls scene(path(name));
    const auto remarks = scene.file["extras"]["medial_vk"];
    EXPECT_EQ(remarks["frames"], scene.frames.size());
    std::size_t balls = 0;
    double greatest = 0;
    for (std::size_t joint = 0; joint < scene.motion->rig()->joints.size(); ++joint) {
      for (const nlohmann::json& node : scene.balls_below(joint)) {
        const auto ours = node["extras"]["medial_vk"];
        const double radius = ours["radius"], rest_radius = ours["rest_radius"], reach_out = ours["reach_out"];
        // The numbers of a turn carry a few roundings, and so does its stretch, which is 1.
        EXPECT_NEAR(node["scale"][0].get<double>(), radius, 1e-14) << "these joints do not scale";
        double least = 1e9;
        for (const MotionFrame& frame : scene.frames) {
          const Point centre = frame.joints[joint](node["translation"].get<Point>());
          least = std::min(least, depth_in(scene.motion->rest(), frame.positions, centre));
        }
        // Rounding of positions of length 10 in a few operations.
        EXPECT_NEAR(radius, std::min(rest_radius, least), 1e-12) << "as large as every frame permits";
        EXPECT_NEAR(reach_out, std::max(0.0, rest_radius - least), 1e-12) << "in the worst frame";
        greatest = std::max(greatest, reach_out);
        ++balls;
      }
    }
    EXPECT_EQ(balls, 4u);
    EXPECT_EQ(remarks["balls"], balls);
    EXPECT_EQ(remarks["greatest_reach_out"], greatest);
    EXPECT_GT(greatest, 0) << "a joint alone does not follow the blend";
  }
}

TEST_F(FollowRigNodes, ADeepSceneIsRefused) {
  const auto file_of = [](std::size_t levels) {
    std::string text = test::skinned_animation().gltf();
    return text.insert(1, "\"extras\":" + std::string(levels, '[') + std::string(levels, ']') + ",");
  };
  test::write_file(path("ball.csv"), "x,y,z,radius\n5.25,0.25,0.25,0.125\n");
  test::write_file(path("deep.gltf"), file_of(300'000));
  for (const std::string rig : {"rig.glb", "rig.gltf"}) {
    const ToolResult deep = run({"follow", "deep.gltf", "--balls", "ball.csv", "--rig", rig});
    EXPECT_EQ(deep.exit_code, 3);
    EXPECT_THAT(deep.err, HasSubstr("deep.gltf: its JSON is nested 300001 levels deep"));
    test::write_file(path("flat.gltf"), file_of(500));
    EXPECT_EQ(run({"follow", "flat.gltf", "--balls", "ball.csv", "--fps", "4", "--rig", rig}).exit_code, 0);
  }
  EXPECT_EQ(run({"follow", "deep.gltf", "--balls", "ball.csv", "--fps", "4", "--rig", "rig.json"}).exit_code, 0);
}

TEST_F(FollowRigNodes, ACopyOfASceneInPartsStaysInItsFolder) {
  test::AnimationWriter writer = test::skinned_animation();
  writer.document["images"] = {{{"uri", "skin.png"}}};
  test::write_file(path("bow.glb"), writer.glb());
  test::write_file(path("ball.csv"), "x,y,z,radius\n5.25,0.25,0.25,0.125\n");
  std::filesystem::create_directory(path("other"));
  const ToolResult other = run({"follow", "bow.glb", "--balls", "ball.csv", "--rig", "other/rig.glb"});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, HasSubstr("parts in other files"));
  EXPECT_EQ(run({"follow", "bow.glb", "--balls", "ball.csv", "--rig", "rig.glb"}).exit_code, 0);
}

}  // namespace
}  // namespace medial_vk
