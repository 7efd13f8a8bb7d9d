// Poses in the form that the reference takes.
#pragma once

#include "cpu_reference/distance.h"
#include "medial_vk/pose.h"
#include "support/eigen_points.h"

namespace medial_vk::test {

inline reference::Motion to_reference(const Pose& pose) {
  reference::Motion motion;
  for (int i = 0; i < 3; ++i) motion.rotation.row(i) = to_eigen(pose.rotation[static_cast<std::size_t>(i)]);
  motion.shift = to_eigen(pose.shift);
  return motion;
}

}  // namespace medial_vk::test
