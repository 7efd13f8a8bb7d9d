// `medial-vk spheres --contract both`: a mesh as a body file.
#pragma once

#include "cli/options/spheres_options.h"
#include "medial_vk/result.h"

namespace medial_vk::cli {

/// Fits balls inside the mesh and balls that cover it, and writes both with the mesh. A failed `--check` is
/// kCheckFailed.
Status run_body(const SpheresOptions& options);

}  // namespace medial_vk::cli
