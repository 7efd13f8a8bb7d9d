// The main command: medial spheres of a mesh, and all that follows from them, as files.
#pragma once

#include "cli/options/options.h"
#include "medial_vk/result.h"

namespace medial_vk::cli {

/// Loads the mesh, analyses it, encodes the results and writes them. A failed `--check` is kCheckFailed.
Status run_extract(const Options& options);

}  // namespace medial_vk::cli
