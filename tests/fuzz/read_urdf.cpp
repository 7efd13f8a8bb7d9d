// The URDF reader, on any bytes, and the queries of a robot before its meshes are read.
#include "robots/model/read_urdf.h"

#include <algorithm>
#include <cmath>

#include "fuzz/require.h"

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

}  // namespace
}  // namespace medial_vk::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace medial_vk;
  const Result<Robot> robot = read_urdf(fuzz::as_text(data, size), fuzz::kName);
  if (robot.ok()) {
    fuzz::require_robot(robot.value());
    return 0;
  }
  fuzz::require_clear(robot.error(), ErrorCode::kInvalidMesh);
  fuzz::require(robot.error().message.starts_with(fuzz::kName + ":"), "a message begins with the name of the file");
  return 0;
}
