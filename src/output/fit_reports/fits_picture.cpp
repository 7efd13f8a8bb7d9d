#include "output/fit_reports/fits_picture.h"

#include <functional>
#include <map>

#include "output/picture/picture.h"

namespace medial_vk {
namespace {

/// Joins all meshes, for the camera and for the gaps between the spheres.
void append_mesh(const IndexedMesh& mesh, const std::function<Point(const Point&)>& place, Mesh& all) {
  const auto first = static_cast<std::uint32_t>(all.vertices.size());
  for (const Point& p : mesh.view().vertices) all.vertices.push_back(place(p));
  for (const Triangle& t : mesh.view().triangles) {
    all.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
}

void append_solid(const FittedSolid& solid, const Pose& link, Mesh& all) {
  const auto place = [&](const Point& p) { return link * (solid.pose * p); };
  if (solid.mesh) append_mesh(*solid.mesh, place, all);
  if (!solid.ball) return;
  // There is no mesh, but the camera must include the ball: an octahedron inside it.
  const double r = solid.ball->radius;
  const auto at = static_cast<std::uint32_t>(all.vertices.size());
  for (const double sign : {-1.0, 1.0}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Point corner = {0, 0, 0};
      corner[axis] = sign * r;
      all.vertices.push_back(place(corner));
    }
  }
  for (const Triangle& t : {Triangle{3, 4, 5}, Triangle{4, 0, 5}, Triangle{0, 1, 5}, Triangle{1, 3, 5},
                            Triangle{4, 3, 2}, Triangle{0, 4, 2}, Triangle{1, 0, 2}, Triangle{3, 1, 2}}) {
    all.triangles.push_back({at + t[0], at + t[1], at + t[2]});
  }
}

}  // namespace

std::vector<Pose> link_poses(const Robot& robot, std::span<const FittedSolid> solids) {
  const std::vector<Pose> links = link_poses(robot);
  std::map<std::string, std::size_t> numbers;
  for (std::size_t i = 0; i < robot.links.size(); ++i) numbers.emplace(robot.links[i].name, i);
  std::vector<Pose> poses;
  for (const FittedSolid& solid : solids) poses.push_back(links[numbers.at(solid.link)]);
  return poses;
}

Result<std::string> encode_fits_picture(const FitsRecord& record, std::span<const Pose> poses, const PictureView& view,
                                        const DeviceDescription* device) {
  Mesh all;
  std::vector<MedialSphere> spheres;
  for (std::size_t i = 0; i < record.solids.size(); ++i) {
    append_solid(record.solids[i], poses[i], all);
    for (const Ball& ball : record.solids[i].levels.back()) {
      MedialSphere sphere{};
      sphere.centre = poses[i] * ball.centre;
      sphere.radius = ball.radius;
      spheres.push_back(sphere);
    }
  }
  PictureOptions look;
  look.view = view;
  look.show = PictureShow::kBalls;
  look.colour = PictureColour::kRadius;
  return encode_png(draw_picture(all, spheres, 0, look, device).picture);
}

}  // namespace medial_vk
