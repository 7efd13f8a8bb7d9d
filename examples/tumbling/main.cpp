// Two copies of a solid bounce in a box; a page shows them, with the distance between them in every frame.
//   tumbling MESH.obj PAGE.html [FRAMES]
// make_model makes a mesh. The motion is the same in every run.
#include <cstdlib>
#include <fstream>
#include <iostream>

#include "bodies.h"
#include "model.h"
#include "page.h"

namespace {

medial_vk::Result<std::vector<tumbling::Frame>> frames_of(const medial_vk::Body& body, tumbling::Tumbling& motion,
                                                          int count) {
  std::vector<tumbling::Frame> frames;
  medial_vk::Distance last;
  medial_vk::DistanceBounds last_bounds;
  for (int i = 0; i < count; ++i) {
    if (const medial_vk::Status status = motion.step(); !status) return status.error();
    const medial_vk::Pose pose = motion.relative_pose();
    const auto found = medial_vk::distance(body, body, pose, {}, last);  // starts from the frame before
    if (!found) return found.error();
    last = found.value();
    last_bounds = medial_vk::distance_bounds(body, body, pose, last_bounds);
    const medial_vk::Pose to_world = motion.pose(0);
    frames.push_back({{to_world, motion.pose(1)}, to_world * last.on_a, to_world * last.on_b, last.upper, last_bounds});
  }
  return frames;
}

medial_vk::Status write_page(const char* mesh_file, const char* page_file, int count) {
  const auto mesh = tumbling::read_obj(mesh_file);
  if (!mesh) return mesh.error();
  constexpr std::size_t kBalls = 64;
  const auto body = tumbling::body_of(mesh.value(), kBalls);
  if (!body) return body.error();
  const double side = tumbling::longest_side(mesh.value());
  tumbling::Tumbling motion(body.value(), side);
  const auto frames = frames_of(body.value(), motion, count);
  if (!frames) return frames.error();
  std::ofstream out(page_file, std::ios::binary);
  out << tumbling::page_of(mesh.value(), body.value(), side, motion.half_of_box(), frames.value());
  out.close();
  if (!out) return medial_vk::Error{medial_vk::ErrorCode::kUsage, std::string("cannot write ") + page_file};
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 3 ? std::atoi(argv[3]) : 900;
  if (argc < 3 || count < 1) {
    std::cerr << "usage: tumbling MESH.obj PAGE.html [FRAMES]\n";
    return 2;
  }
  const medial_vk::Status status = write_page(argv[1], argv[2], count);
  if (!status) std::cerr << "tumbling: " << status.error().message << '\n';
  return status ? 0 : 1;
}
