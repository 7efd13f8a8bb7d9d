// A robot as described by its URDF: links with geometry, and joints between them.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "medial_vk/pose.h"

namespace medial_vk {

enum class GeometryKind { kMesh, kBox, kCylinder, kSphere, kCapsule };

/// Lengths are in metres. Cylinder and capsule lie along z, with their middle at the origin.
struct Geometry {
  GeometryKind kind = GeometryKind::kMesh;
  Pose origin;              ///< From the geometry's frame to that of its link.
  std::string mesh;         ///< As in the file: a path or URI.
  Point scale = {1, 1, 1};  ///< Of a mesh. Negative values mirror it.
  Point size = {0, 0, 0};   ///< Box: sides. Others: radius, then length (of a capsule: without its caps).
  int line = 0;             ///< The line in the URDF.
};

struct Link {
  std::string name;
  std::vector<Geometry> collision;
  std::vector<Geometry> visual;
};

enum class JointKind { kFixed, kRevolute, kContinuous, kPrismatic };

/// The position of a joint that follows another one: multiplier times its position, plus the offset.
struct Mimic {
  std::uint32_t joint = 0;  ///< Index of the other joint.
  double multiplier = 1, offset = 0;
};

struct Joint {
  std::string name;
  std::uint32_t parent = 0;  ///< Index of a link.
  std::uint32_t child = 0;
  Pose origin;  ///< From the child's frame to the parent's, at position zero.
  // With UrdfDetail::kMotion:
  JointKind kind = JointKind::kFixed;
  Point axis = {1, 0, 0};  ///< A unit vector in the child's frame: of the rotation, or of the shift.
  /// Of revolute and prismatic joints, in radians and metres.
  double lower = -std::numeric_limits<double>::infinity(), upper = std::numeric_limits<double>::infinity();
  std::optional<Mimic> mimic;
};

struct Robot {
  std::string name;
  std::vector<Link> links;    ///< In the order of the file.
  std::vector<Joint> joints;  ///< A forest: no link has two parents, none is its own ancestor.
};

/// From each link's frame to that of the root of its tree, all joints at zero.
std::vector<Pose> link_poses(const Robot& robot);

}  // namespace medial_vk
