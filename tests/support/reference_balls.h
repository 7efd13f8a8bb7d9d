// The reference's own balls from the product's.
#pragma once

#include <vector>

#include "cpu_reference/sphere_certificate.h"
#include "medial_vk/ball.h"

namespace medial_vk::test {

inline std::vector<reference::UnionBall> to_reference(const std::vector<Ball>& balls) {
  std::vector<reference::UnionBall> out;
  for (const Ball& ball : balls) out.push_back({{ball.centre[0], ball.centre[1], ball.centre[2]}, ball.radius});
  return out;
}

}  // namespace medial_vk::test
