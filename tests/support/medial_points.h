// A header and some medial spheres to write to files, far enough from 0 that rounding shows.
#pragma once

#include <vector>

#include "output/medial_ply/medial_file.h"

namespace medial_vk::test {

inline MedialHeader some_header() {
  MedialHeader header;
  header.version = "1.2.3";
  header.grid_origin = {-1.0, 0.1, 1e-9};
  header.voxel_size = 0.00625;
  header.epsilon = 0.0000625;
  header.object_angle = 0.6;
  header.radius_threshold = 0.125;
  return header;
}

inline std::vector<MedialSphere> some_spheres() {
  std::vector<MedialSphere> spheres(3);
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const auto x = static_cast<double>(i);
    spheres[i].centre = {1e6 / 3.0 + x, -0.2 - 0.1 * x, 1e-3 * x / 7};
    spheres[i].radius = 0.1 + x / 3;
    spheres[i].spoke_a = {0.6f, -0.8f, 0.0f};
    spheres[i].spoke_b = {-1.0f, 0.0f, 1e-7f};
    spheres[i].object_angle = 0.6f + 0.45f * static_cast<float>(i);
    spheres[i].flux = -0.25f;
    spheres[i].sheet = static_cast<std::int32_t>(i) - 1;
    spheres[i].voxel = {7, 0, static_cast<std::uint32_t>(i)};
  }
  return spheres;
}

}  // namespace medial_vk::test
