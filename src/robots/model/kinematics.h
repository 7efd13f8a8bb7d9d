// Forward kinematics: where the links of a robot are, from the positions of its joints.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "medial_vk/pose.h"
#include "medial_vk/result.h"
#include "robots/model/robot.h"

namespace medial_vk {

/// A joint with a position of its own: one that moves and mimics no other one.
struct FreeJoint {
  std::string name;
  JointKind kind = JointKind::kRevolute;
  double lower = 0, upper = 0;  ///< In radians or metres; infinite without limits.
};

/// The joints of a robot in an order in which poses are composed. A value: it does not refer to the robot.
class Kinematics {
 public:
  /// Precondition: the robot was read with UrdfDetail::kMotion.
  explicit Kinematics(const Robot& robot);

  std::size_t links() const { return links_; }
  std::span<const FreeJoint> joints() const { return joints_; }  ///< In the order of the file.

  /// Writes the pose of every link, from its frame to that of the root of its tree. `values` has the position of each
  /// of joints(), in radians or metres, whether or not it keeps the limits; sizes match. The joint maps the child's
  /// frame to the parent's by its origin after the rotation about its axis, or the shift along it. Products of the rows
  /// of a rotation are within 4e-15 of 0 and 1, however long the chain is. In exact arithmetic a pose differs from the
  /// result by about 1e-15 for each joint above, and by that times lengths. Error: kInvalidMesh, with the link, where a
  /// pose is beyond the range of numbers.
  Status place(std::span<const double> values, std::span<Pose> poses) const;

 private:
  /// A joint; its position is multiplier times a value, plus offset.
  struct Step {
    std::uint32_t parent = 0, child = 0;
    JointKind kind = JointKind::kFixed;
    Pose origin;
    Point axis = {1, 0, 0};
    std::size_t value = 0;
    double multiplier = 1, offset = 0;
  };

  Step step_of(const Robot& robot, const Joint& joint, const std::vector<std::size_t>& value_of) const;

  std::size_t links_ = 0;
  std::vector<FreeJoint> joints_;
  std::vector<std::string> names_;  // of links
  std::vector<std::uint32_t> roots_;
  std::vector<Step> steps_;  // parents before children
};

}  // namespace medial_vk
