// The part of a run that is about the union of the balls: significance of sheets, their removal, and its files.
#pragma once

#include <functional>
#include <vector>

#include "cli/options/options.h"
#include "output/files/atomic_file.h"
#include "output/report/run_record.h"

namespace medial_vk::cli {

/// Does anything that is asked for tell of volumes?
bool needs_volumes(const Options& options);

/// Fills in what the record says of the union and of the sheets' significance, makes the files of --sheet-curve and
/// --ball-volumes, and takes the points of sheets that --keep-volume does not keep out of `spheres` and the record.
/// Sheets keep their numbers. `progress(stage, share)`: false stops. Errors: kInterrupted, kOutOfMemory.
Status measure_volumes(const Options& options, const std::function<bool(const char*, double)>& progress,
                       std::vector<MedialSphere>& spheres, RunRecord& record, std::vector<OutputFile>& files);

}  // namespace medial_vk::cli
