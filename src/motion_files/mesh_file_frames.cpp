// Frames that are mesh files.
#include <fmt/format.h>

#include <filesystem>
#include <new>

#include "input/read_mesh.h"
#include "input/text_scanner.h"
#include "motion_files/mesh_motion.h"
#include "motion_files/same_triangles.h"
#include "platform/paths.h"
#include "scene_files/read_mesh_file.h"

namespace medial_vk {
namespace {

class MeshFileMotion : public MeshMotion {
 public:
  MeshFileMotion(Mesh rest, std::string rest_name, std::vector<std::string> frames)
      : rest_(std::move(rest)), rest_name_(std::move(rest_name)), frames_(std::move(frames)) {}

  const Mesh& rest() const override { return rest_; }
  std::uint64_t frame_count() const override { return frames_.size(); }

  Status read_frame(std::uint64_t index, MotionFrame& frame) const override {
    const std::string& path = frames_.at(index);
    try {
      Result<Mesh> mesh = read_mesh_file(path);
      if (!mesh) return mesh.error();
      const std::string name = name_of_input(path);
      if (Status same = compare_faces(rest_, rest_name_, mesh.value(), name); !same) return same;
      frame.name = name;
      frame.time.reset();
      frame.joints.clear();
      frame.positions.assign(mesh.value().vertices.begin(), mesh.value().vertices.end());
      return {};
    } catch (const std::bad_alloc&) {
      return Error{ErrorCode::kOutOfMemory, fmt::format("{}: not enough memory to read it", name_of_input(path))};
    }
  }

 private:
  Mesh rest_;
  std::string rest_name_;
  std::vector<std::string> frames_;
};

/// A frame that is not there is an error before the first of many has been computed.
Status find_frames(const std::string& rest, const std::vector<std::string>& frames) {
  if (frames.empty()) return Error{ErrorCode::kUsage, "a motion has at least one frame"};
  if (frames.size() > kMostFrames) {
    return Error{ErrorCode::kUsage, fmt::format("{} frames are more than {}", frames.size(), kMostFrames)};
  }
  bool has_input = rest == "-";
  for (const std::string& frame : frames) {
    if (frame == "-") {
      if (has_input) return Error{ErrorCode::kUsage, "only one mesh of a motion can be standard input"};
      has_input = true;
      continue;
    }
    std::error_code error;
    if (!std::filesystem::exists(platform::path_of(frame), error)) return file_error(frame, "there is no such file");
  }
  return {};
}

}  // namespace

Result<std::unique_ptr<MeshMotion>> open_mesh_files(const std::string& rest, std::vector<std::string> frames) {
  if (Status there = find_frames(rest, frames); !there) return there.error();
  Result<Mesh> mesh = read_mesh_file(rest);
  if (!mesh) return mesh.error();
  return std::unique_ptr<MeshMotion>(
      std::make_unique<MeshFileMotion>(std::move(mesh).value(), name_of_input(rest), std::move(frames)));
}

}  // namespace medial_vk
