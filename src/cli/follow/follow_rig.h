// The balls as a part of the character's rig.
#pragma once

#include <functional>
#include <vector>

#include "cli/follow/rest_mesh.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/result.h"
#include "motion_files/mesh_motion.h"
#include "rigs/ball_rig.h"

namespace medial_vk::cli {

/// Binds the balls that have followed the motion to its rig, and proves their radii in every frame, for which all
/// frames are read again. `frames` begins with the rest pose; `mesh` is moved. `seen` gets the finished share. Errors:
/// those of MeshMotion::read_frame() and measure_depths(); kInterrupted.
Result<BallRig> rig_balls(const MeshMotion& motion, const std::vector<RiggedFrame>& frames, VertexMap& map,
                          IndexedMesh& mesh, unsigned threads, const std::function<void(double)>& seen);

/// The joints at rest.
std::vector<AffineMap> joints_at_rest(const MotionRig& rig);

}  // namespace medial_vk::cli
