// Random poses, the same in every run.
#pragma once

#include <random>

#include "medial_vk/pose.h"

namespace medial_vk::test {

using Random = std::mt19937_64;

inline double uniform(Random& random, double from, double to) {
  return std::uniform_real_distribution<>(from, to)(random);
}

inline Point point_in_cube(Random& random, double half) {
  return {uniform(random, -half, half), uniform(random, -half, half), uniform(random, -half, half)};
}

/// Any rotation, from a quaternion of normal numbers.
inline Pose any_pose(Random& random, const Point& shift) {
  std::normal_distribution<> normal;
  const double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
  return make_pose(shift, Quaternion(x, y, z, w)).value();
}

}  // namespace medial_vk::test
