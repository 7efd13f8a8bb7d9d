// `medial-vk spheres --frames`: balls for a mesh that deforms.
#pragma once

#include "cli/options/spheres_options.h"
#include "medial_vk/result.h"

namespace medial_vk::cli {

/// Chooses balls inside the mesh at rest which cover most of it as they follow it through all frames, and writes them.
/// A failed `--check` is kCheckFailed.
Status run_motion_fit(const SpheresOptions& options);

}  // namespace medial_vk::cli
