// The pose of one body in the frame of another one, where both have poses in the world.
#pragma once

#include "medial_vk/pose.h"

namespace medial_vk {

/// A pose in the frame of a first body, and its errors: a distance d in that frame differs from the distance in the
/// world by at most `share` d + `length`.
struct RelativePose {
  Pose pose;
  double share = 0, length = 0;
};

/// `reach`: no point of the second body is farther from the origin of its frame.
RelativePose relative_pose(const Pose& first, const Pose& second, double reach);

}  // namespace medial_vk
