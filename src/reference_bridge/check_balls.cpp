#include "reference_bridge/check_balls.h"

#include <utility>

#include "cpu_reference/certificate.h"
#include "cpu_reference/sphere_certificate.h"
#include "reference_bridge/reference_bridge.h"

namespace medial_vk {
namespace {

CheckReport from_reference(reference::Certificate certificate) {
  CheckReport report;
  report.lines.reserve(certificate.lines.size());
  for (reference::CertificateLine& line : certificate.lines) {
    report.lines.push_back({std::move(line.condition), line.tested, line.failed, line.worst, std::move(line.unit),
                            std::move(line.first_failure)});
  }
  return report;
}

std::vector<reference::UnionBall> to_reference(std::span<const Ball> balls) {
  std::vector<reference::UnionBall> copies;
  copies.reserve(balls.size());
  for (const Ball& ball : balls) {
    copies.push_back({{ball.centre[0], ball.centre[1], ball.centre[2]}, ball.radius});
  }
  return copies;
}

}  // namespace

CheckReport check_medial_spheres(const IndexedMesh& mesh, const VoxelGrid& grid,
                                 const std::vector<MedialSphere>& spheres, double epsilon, double object_angle,
                                 double radius) {
  return from_reference(reference::check(medial_vk::to_reference(mesh), medial_vk::to_reference(grid, spheres), epsilon,
                                         object_angle, radius));
}

CheckReport check_balls_inside(const PreparedMesh& mesh, std::span<const Ball> balls) {
  return from_reference(reference::check_inside(medial_vk::to_reference(mesh), to_reference(balls)));
}

CheckReport check_balls_cover(const PreparedMesh& mesh, std::span<const Ball> balls) {
  return from_reference(reference::check_cover(medial_vk::to_reference(mesh), to_reference(balls)));
}

}  // namespace medial_vk
