// The messages of `medial-vk follow`.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "cli/options/follow_options.h"
#include "cli/shared/rest_mesh.h"
#include "medial_vk/measurements.h"
#include "output/atomic_files/atomic_file.h"
#include "output/motion_files/motion_record.h"
#include "rigs/ball_rig.h"

namespace medial_vk::cli {

/// Before the work: the mesh and its frames. `separable`: vertices of an animation that stand for several of the file.
std::string follow_opening(const FollowOptions& options, const MeshReport& report, std::uint64_t frames,
                           std::uint64_t separable);

/// After it. `closed`: the mesh; `rig` has no balls unless one was made; `update_seconds` is the time in which balls
/// were moved, in all frames.
std::string follow_summary(const FollowOptions& options, const MotionRecord& record, bool closed, const BallRig& rig,
                           const PartedVertices& parted, double update_seconds, const std::vector<StageTime>& times,
                           std::span<const OutputFile> files);

}  // namespace medial_vk::cli
