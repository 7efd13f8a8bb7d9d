// The balls that follow the mesh: from a file, fitted, or all medial points.
#pragma once

#include <vector>

#include "cli/options/follow_options.h"
#include "cli/shared/shared_of_run.h"
#include "medial_vk/ball.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/result.h"

namespace medial_vk::cli {

/// Whether the options find balls on a device, which `shared.opening` must then open.
bool finds_on_device(const FollowOptions& options);

/// The balls in the rest pose. Appends the seconds to the times of `shared`. Errors: those of read_balls(),
/// fit_spheres() or extract_and_certify(), with a remedy; kInterrupted.
Result<std::vector<Ball>> balls_at_rest(const FollowOptions& options, const IndexedMesh& mesh, SharedOfRun& shared);

}  // namespace medial_vk::cli
