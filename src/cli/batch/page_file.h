// The page of `medial-vk batch` as a file.
#pragma once

#include <span>

#include "cli/batch/batch_folder.h"
#include "medial_vk/result.h"
#include "output/batch_files/batch_table.h"

namespace medial_vk::cli {

/// Writes batch.html into the folder: these meshes, with the pictures and files that their lines name. Errors:
/// kCannotWrite, kDiskFails.
Status write_page(const BatchFolder& folder, std::span<const BatchRow> rows);

}  // namespace medial_vk::cli
