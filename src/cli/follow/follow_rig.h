// The balls as a part of the character's rig.
#pragma once

#include <functional>
#include <vector>

#include "cli/options/follow_options.h"
#include "cli/shared/rest_mesh.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/result.h"
#include "motion_files/mesh_motion.h"
#include "output/rig_files/rig_json.h"
#include "rigs/ball_rig.h"

namespace medial_vk::cli {

/// Binds the balls that have followed the motion to its rig, each to one joint or to several, and proves their radii in
/// every frame, for which all frames are read again. `frames` begins with the rest pose; `mesh` is moved. `seen` gets
/// the finished share. Errors: those of MeshMotion::read_frame() and measure_depths(); kInterrupted.
Result<BallRig> rig_balls(const MeshMotion& motion, const std::vector<RiggedFrame>& frames, VertexMap& map,
                          BallBinding binding, IndexedMesh& mesh, unsigned threads,
                          const std::function<void(double)>& seen);

/// Tests that `--rig` can have balls of this motion. Error: kUsage.
Status check_rig_file(const FollowOptions& options, const MeshMotion& motion);

/// The file of `--rig`. Error: that of encode_rig_gltf().
Result<std::string> encode_rig_as(const std::string& path, const RigFile& file, const GltfSource* source);

/// The joints at rest.
std::vector<AffineMap> joints_at_rest(const MotionRig& rig);

}  // namespace medial_vk::cli
