#include "robots/model/kinematics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/point_ops.h"
#include "base/quoted.h"

namespace medial_vk {
namespace {

/// By `angle` about a unit vector (Rodrigues): cos I + sin [axis]x + (1 - cos) axis axis^T.
Pose rotation_about(const Point& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle), t = 1 - c;
  const auto [x, y, z] = axis;
  Pose pose;
  pose.rotation = {{{t * x * x + c, t * x * y - s * z, t * x * z + s * y},
                    {t * x * y + s * z, t * y * y + c, t * y * z - s * x},
                    {t * x * z - s * y, t * y * z + s * x, t * z * z + c}}};
  return pose;
}

/// Rows of a rotation to within some 1e-7 become rows to within rounding (Gram and Schmidt). With u = 2^-53: the length
/// of a row has a relative error of 2.5u, so that a row divided by it has a square of 1 to within 9u. The product of
/// the first two rows, before and after the second division, is the rounding of dot() and of the difference, less than
/// 5u. The third row has errors of 2u in each coordinate, 3.5u in all: its products with the others are less than 9u,
/// and its square is 1 to within 9u + 9u + 7u. Everything is within 32u, less than 4e-15.
void make_perpendicular(Pose& pose) {
  auto& rows = pose.rotation;
  rows[0] = (1 / length(rows[0])) * rows[0];
  rows[1] = rows[1] - dot(rows[0], rows[1]) * rows[0];
  rows[1] = (1 / length(rows[1])) * rows[1];
  rows[2] = cross(rows[0], rows[1]);
}

bool is_finite(const Pose& pose) {
  const auto finite = [](const Point& p) { return std::ranges::all_of(p, [](double x) { return std::isfinite(x); }); };
  return finite(pose.shift) && std::ranges::all_of(pose.rotation, finite);
}

}  // namespace

Kinematics::Kinematics(const Robot& robot) : links_(robot.links.size()) {
  for (const Link& link : robot.links) names_.push_back(link.name);
  std::vector<std::size_t> value_of(robot.joints.size(), 0);
  std::vector<std::vector<std::uint32_t>> below(links_);
  std::vector<bool> is_child(links_, false);
  for (std::uint32_t i = 0; i < robot.joints.size(); ++i) {
    const Joint& joint = robot.joints[i];
    below[joint.parent].push_back(i);
    is_child[joint.child] = true;
    if (joint.kind == JointKind::kFixed || joint.mimic) continue;
    value_of[i] = joints_.size();
    joints_.push_back({joint.name, joint.kind, joint.lower, joint.upper});
  }
  std::vector<std::uint32_t> waiting;
  for (std::uint32_t link = 0; link < links_; ++link) {
    if (!is_child[link]) waiting.push_back(link);
  }
  roots_ = waiting;
  for (std::size_t i = 0; i < waiting.size(); ++i) {
    for (const std::uint32_t joint : below[waiting[i]]) {
      steps_.push_back(step_of(robot, robot.joints[joint], value_of));
      waiting.push_back(robot.joints[joint].child);
    }
  }
}

Kinematics::Step Kinematics::step_of(const Robot& robot, const Joint& joint,
                                     const std::vector<std::size_t>& value_of) const {
  Step step = {joint.parent, joint.child, joint.kind, joint.origin, joint.axis};
  const Joint* source = &joint;
  for (; source->mimic; source = &robot.joints[source->mimic->joint]) {
    step.offset += step.multiplier * source->mimic->offset;
    step.multiplier *= source->mimic->multiplier;
  }
  step.value = value_of[static_cast<std::size_t>(source - robot.joints.data())];
  return step;
}

Status Kinematics::place(std::span<const double> values, std::span<Pose> poses) const {
  for (const std::uint32_t root : roots_) poses[root] = Pose();
  for (const Step& step : steps_) {
    Pose pose = poses[step.parent] * step.origin;
    if (step.kind != JointKind::kFixed) {
      const double position = step.multiplier * values[step.value] + step.offset;
      if (step.kind == JointKind::kPrismatic) {
        pose.shift = pose * (position * step.axis);
      } else {
        pose = pose * rotation_about(step.axis, position);
      }
    }
    make_perpendicular(pose);
    poses[step.child] = pose;
    if (is_finite(pose)) continue;
    return Error{ErrorCode::kInvalidMesh, fmt::format("the pose of the link {} is beyond the range of numbers",
                                                      medial_vk::quoted(names_[step.child]))};
  }
  return {};
}

}  // namespace medial_vk
