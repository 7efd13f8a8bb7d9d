#include "output/rig_files/rig_json.h"

#include <nlohmann/json.hpp>

namespace medial_vk {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kRigFormat = 1;

/// Column by column with the last row, as glTF has matrices.
Json matrix_of(const AffineMap& map) {
  Json numbers = Json::array();
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t row = 0; row < 3; ++row) numbers.push_back(map.rows()[row][column]);
    numbers.push_back(column == 3 ? 1.0 : 0.0);
  }
  return numbers;
}

Json joint_of(const RigJoint& joint) {
  Json parent;  // null: none
  if (joint.parent != RigJoint::kNone) parent = joint.parent;
  return {{"name", joint.name}, {"node", joint.node}, {"parent", parent}, {"rest_matrix", matrix_of(joint.rest)}};
}

Json ball_of(const RigBall& ball) {
  Json joints = Json::array();
  for (const BallJoint& bound : ball.joints) {
    joints.push_back({{"joint", bound.joint}, {"weight", bound.weight}, {"place", bound.place}});
  }
  return {{"radius", ball.radius},
          {"rest_radius", ball.rest_radius},
          {"reach_out", ball.reach_out},
          {"joints", std::move(joints)}};
}

}  // namespace

std::string encode_rig(const RigFile& file) {
  Json joints = Json::array(), balls = Json::array();
  for (const RigJoint& joint : file.rig.joints) joints.push_back(joint_of(joint));
  for (const RigBall& ball : file.balls.balls) balls.push_back(ball_of(ball));
  const Json rig = {{"format", kRigFormat},        {"program", "medial-vk"},
                    {"version", file.version},     {"mesh", file.name},
                    {"frames", file.balls.frames}, {"greatest_reach_out", file.balls.greatest_reach_out()},
                    {"joints", std::move(joints)}, {"balls", std::move(balls)}};
  // Names of joints may hold any bytes.
  return rig.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace medial_vk
