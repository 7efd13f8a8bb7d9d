// Random poses, the same in every run.
#pragma once

#include <cmath>
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

/// Any rotation, from a unit quaternion.
inline Pose any_pose(Random& random, const Point& shift) {
  std::normal_distribution<> normal;
  double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
  const double norm = std::sqrt(w * w + x * x + y * y + z * z);
  w /= norm, x /= norm, y /= norm, z /= norm;
  return {{{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
            {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
            {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}},
          shift};
}

}  // namespace medial_vk::test
