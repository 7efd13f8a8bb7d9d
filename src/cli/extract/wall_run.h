// The least walls, and gaps, of a run of the main command, and whether they are as thick as it demands.
#pragma once

#include <string>
#include <vector>

#include "boundary_fields/thin_places.h"
#include "cli/options/options.h"
#include "cli/terminal/progress.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/measurements.h"

namespace medial_vk::cli {

/// For --least-wall, --least-gap, --min-wall and --min-gap. Appends the seconds to `times`. Errors: those of the
/// library.
Result<std::vector<WallRecord>> measure_walls(const IndexedMesh& mesh, const Options& options, Progress& progress,
                                              std::vector<StageTime>& times);

/// A line of the summary.
std::string describe_walls(const WallRecord& record);

/// The places, a row for each; empty if there are none.
std::string places_table(const std::vector<WallRecord>& records);

/// ok, or kWallTooThin.
Status verdict(const std::vector<WallRecord>& records);

}  // namespace medial_vk::cli
