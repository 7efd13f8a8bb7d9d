// Options of the main command that many meshes of one run share, for other commands that run it. Only for files that
// parse options.
#pragma once

#include "cli/options/declarations.h"
#include "cli/options/options.h"

namespace medial_vk::cli {

/// Every option of the main command but MESH, --each, -o, --html and those that end a run at once.
void declare_shared(Declarations& add, Options& options);

/// Whether the options can be used together; it does not read the names of files. Error: kUsage.
Status check_combinations(const Options& options);

/// Completes the names of files, and what follows from them; tests all options that depend on them. Error: kUsage.
Status complete_files(Options& options);

}  // namespace medial_vk::cli
