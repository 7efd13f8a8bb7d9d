// Runs `medial-vk batch --merge`: the results of several runs, each in a folder of its own, become those of one.
#pragma once

#include "cli/options/batch/batch_options.h"
#include "medial_vk/result.h"

namespace medial_vk::cli {

/// The folder of the results gets the lines of all tables, in the order of the folders, and hard links to their files,
/// or copies where the file system has none. Files that an earlier table there names, and no line does now, are
/// removed. A mesh whose run has not ended becomes a failed one, as does one without a file that its line names, unless
/// the folder has these results from before. Errors: kUsage if two meshes have one name, a result would replace a mesh,
/// or the table there names something out of the folder; kInvalidMesh if a folder has no table, or one that cannot be
/// read; kCannotWrite, kDiskFails; kInterrupted; kSomeFailed if there are meshes that failed.
Status merge_batches(const BatchOptions& options);

}  // namespace medial_vk::cli
