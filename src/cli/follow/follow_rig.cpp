#include "cli/follow/follow_rig.h"

#include <fmt/format.h>

#include <cstddef>
#include <filesystem>
#include <utility>

#include "cli/follow/frame_depths.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/messages.h"
#include "common/file_extension.h"
#include "output/rig_files/rig_gltf.h"
#include "platform/paths.h"

namespace medial_vk::cli {
namespace {

/// Limits the radii in a frame.
Status prove_frame(const RiggedFrame& frame, const std::vector<Point>& vertices, unsigned threads, IndexedMesh& mesh,
                   BallRig& balls) {
  const std::vector<Point> centres = posed_centres(balls, frame.joints);
  std::vector<double> depths(centres.size());
  if (Status status = depths_in_frame(vertices, centres, threads, mesh, depths); !status) return status;
  limit_radii(depths, balls);
  return {};
}

}  // namespace

Status check_rig_file(const FollowOptions& options, const MeshMotion& motion) {
  if (options.rig.empty()) return {};
  if (motion.rig() == nullptr) {
    return Error{ErrorCode::kUsage, "--rig is about the joints of an animation; meshes have none"};
  }
  const GltfSource* const source = motion.source();
  if (source == nullptr || options.rest == "-" || !names_other_files(*source)) return {};
  const auto folder_of = [](const std::string& path) {
    std::error_code error;
    return std::filesystem::weakly_canonical(std::filesystem::absolute(platform::path_of(path), error).parent_path(),
                                             error);
  };
  if (folder_of(options.rig) == folder_of(options.rest)) return {};
  return Error{ErrorCode::kUsage,
               fmt::format("--rig {}: {} has parts in other files, so its copy must be in the same folder", options.rig,
                           options.rest)};
}

Result<std::string> encode_rig_as(const std::string& path, const RigFile& file, const GltfSource* source) {
  if (source == nullptr) return encode_rig(file);
  return encode_rig_gltf(file, *source, file_extension(path) == ".glb");
}

std::vector<AffineMap> joints_at_rest(const MotionRig& rig) {
  std::vector<AffineMap> joints;
  for (const RigJoint& joint : rig.joints) joints.push_back(joint.rest);
  return joints;
}

Result<BallRig> rig_balls(const MeshMotion& motion, const std::vector<RiggedFrame>& frames, VertexMap& map,
                          BallBinding binding, IndexedMesh& mesh, unsigned threads,
                          const std::function<void(double)>& seen) {
  const MotionRig& rig = *motion.rig();
  const auto goes_on = [&](double done) {
    seen(0.5 * done);
    return !interrupted();
  };
  BallRig balls = bind_balls(rig, motion.rest().vertices, frames, binding, goes_on);
  std::vector<Point> vertices;
  MotionFrame frame;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (interrupted()) return stopped();
    seen(0.5 + 0.5 * static_cast<double>(i) / static_cast<double>(frames.size()));
    if (i == 0) {
      map.map(motion.rest().vertices, vertices);
    } else {
      if (Status status = motion.read_frame(i - 1, frame); !status) return status.error();
      map.map(frame.positions, vertices);
    }
    if (Status status = prove_frame(frames[i], vertices, threads, mesh, balls); !status) return status.error();
  }
  return balls;
}

}  // namespace medial_vk::cli
