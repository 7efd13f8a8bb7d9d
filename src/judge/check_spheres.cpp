#include "judge/check_spheres.h"

#include "cpu_reference/sphere_certificate.h"
#include "judge/reference_bridge.h"

namespace medial_vk {

reference::Certificate check_by_reference(const PreparedMesh& mesh, const std::vector<Ball>& balls,
                                          SphereContract contract) {
  std::vector<reference::UnionBall> copies;
  copies.reserve(balls.size());
  for (const Ball& ball : balls) {
    copies.push_back({{ball.centre[0], ball.centre[1], ball.centre[2]}, ball.radius});
  }
  return contract == SphereContract::kCover ? reference::check_cover(to_reference(mesh), copies)
                                            : reference::check_inside(to_reference(mesh), copies);
}

}  // namespace medial_vk
