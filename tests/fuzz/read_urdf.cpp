// The URDF reader, on any bytes, the queries of a robot before its meshes are read, and its kinematics.
#include "robots/model/read_urdf.h"

#include <algorithm>
#include <cmath>

#include "fuzz/require.h"
#include "robots/model/kinematics.h"

namespace medial_vk::fuzz {
namespace {

bool is_finite(const Point& p) {
  return std::ranges::all_of(p, [](double x) { return std::isfinite(x); });
}

void require_geometry(const Geometry& geometry) {
  require(is_finite(geometry.origin.shift), "positions are finite");
  for (const Point& row : geometry.origin.rotation) {
    require(is_finite(row) && std::ranges::all_of(row, [](double x) { return std::fabs(x) <= 1 + 1e-9; }),
            "rotations are rotations");
  }
  require(is_finite(geometry.scale), "scales are finite");
  if (geometry.kind == GeometryKind::kMesh) {
    require(!geometry.mesh.empty(), "a mesh has a file");
    require(std::ranges::count(geometry.scale, 0.0) == 0, "no scale is zero");
  } else {
    require(is_finite(geometry.size) && geometry.size[0] > 0, "sizes are finite and above zero");
  }
}

void require_robot(const Robot& robot) {
  require(!robot.links.empty(), "a robot has links");
  for (const Link& link : robot.links) {
    require(!link.name.empty(), "links have names");
    for (const Geometry& geometry : link.collision) require_geometry(geometry);
    for (const Geometry& geometry : link.visual) require_geometry(geometry);
  }
  for (const Joint& joint : robot.joints) {
    require(joint.parent < robot.links.size() && joint.child < robot.links.size(), "joints join links");
  }
  require(link_poses(robot).size() == robot.links.size(), "every link has a pose");
}

/// Any position within the limits gives rotations, or a clear message.
void require_kinematics(const Robot& robot) {
  const Kinematics kinematics(robot);
  std::vector<double> values;
  for (const FreeJoint& joint : kinematics.joints()) {
    require(!joint.name.empty() && joint.lower <= joint.upper, "joints have names and limits");
    values.push_back(std::isfinite(joint.upper) ? joint.upper : 1);
  }
  std::vector<Pose> poses(kinematics.links());
  if (const Status status = kinematics.place(values, poses); !status.ok()) {
    require_clear(status.error(), ErrorCode::kInvalidMesh);
    return;
  }
  for (const Pose& pose : poses) {
    require(is_finite(pose.shift), "links have finite poses");
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        double product = 0;
        for (std::size_t k = 0; k < 3; ++k) product += pose.rotation[i][k] * pose.rotation[j][k];
        require(std::fabs(product - (i == j ? 1 : 0)) <= 4.5e-15, "rotations are rotations");
      }
    }
  }
}

}  // namespace
}  // namespace medial_vk::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace medial_vk;
  const Result<Robot> moving = read_urdf(fuzz::as_text(data, size), fuzz::kName, UrdfDetail::kMotion);
  if (moving.ok()) {
    fuzz::require_kinematics(moving.value());
  } else {
    fuzz::require_clear(moving.error(), ErrorCode::kInvalidMesh);
  }
  const Result<Robot> robot = read_urdf(fuzz::as_text(data, size), fuzz::kName);
  if (robot.ok()) {
    fuzz::require_robot(robot.value());
    return 0;
  }
  fuzz::require_clear(robot.error(), ErrorCode::kInvalidMesh);
  fuzz::require(robot.error().message.starts_with(fuzz::kName + ":"), "a message begins with the name of the file");
  return 0;
}
