// The reader of URDF (the XML of ROS robots): links, their geometry, joints.
#pragma once

#include <string>
#include <string_view>

#include "medial_vk/result.h"
#include "robots/model/robot.h"

namespace medial_vk {

/// The greatest size: room for some 10,000 links, since a URDF contains no meshes.
inline constexpr std::size_t kMostUrdfBytes = 64u << 20;

/// What is read of a robot.
enum class UrdfDetail {
  kShapes,  ///< Links, and where joints place them at position zero. How joints move is not examined.
  kMotion,  ///< Also how joints move.
};

/// `name` is used in messages. Elements that have no part in this (inertia, materials) are not examined. Any bytes
/// yield a robot or a message. Errors: kInvalidMesh with name and line, in one sentence: no XML, no robot, a link
/// without a name or with that of another, an unknown geometry, a size, scale or origin that is not a finite number or
/// not above zero, a joint to an unknown link, links in a circle. With kMotion also: a joint that is neither fixed,
/// revolute, continuous nor prismatic; one that moves and has no name, or that of another; an axis of length 0; missing
/// or reversed limits; joints that mimic unknown or fixed ones, or each other in a circle.
Result<Robot> read_urdf(std::string_view bytes, const std::string& name, UrdfDetail detail = UrdfDetail::kShapes);

/// Reads a file. Further errors: it cannot be read, or is larger than kMostUrdfBytes.
Result<Robot> read_urdf_file(const std::string& path, UrdfDetail detail = UrdfDetail::kShapes);

/// The bytes of a file. Errors: kInvalidMesh.
Result<std::string> read_urdf_bytes(const std::string& path);

}  // namespace medial_vk
