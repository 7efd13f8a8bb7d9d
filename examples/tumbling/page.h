// The page of the example.
#pragma once

#include <medial_vk/medial_vk.h>

#include <array>
#include <string>
#include <vector>

namespace tumbling {

struct Frame {
  std::array<medial_vk::Pose, 2> poses;  ///< Of both copies, in the world.
  medial_vk::Point on_a, on_b;           ///< The nearest points, in the world.
  double distance = 0;                   ///< By triangles.
  medial_vk::DistanceBounds bounds;      ///< By balls.
};

/// One file for a browser, which needs no network. Lengths are shares of `side`.
std::string page_of(const medial_vk::Mesh& mesh, const medial_vk::Body& body, double side, double half_of_box,
                    const std::vector<Frame>& frames);

}  // namespace tumbling
