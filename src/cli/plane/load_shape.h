// The shape of `medial-vk plane`, from a file of shapes or from a slice of a mesh.
#pragma once

#include <stop_token>
#include <vector>

#include "cli/options/plane/plane_options.h"
#include "medial_vk/measurements.h"
#include "medial_vk/result.h"
#include "output/plane_files/plane_record.h"

namespace medial_vk::cli {

/// --slice is a plane, if given. Error: kUsage.
Status check_slice(const PlaneCommandOptions& options);

/// Reads and prepares: sets the input, the shape and what is known of its coordinates. Appends the seconds of "read"
/// and "prepare". Errors: kUsage (the fill rule leaves no area), kInvalidMesh, kOutOfMemory, kInterrupted.
Status load_shape(const PlaneCommandOptions& options, const std::stop_token& stop, PlaneRecord& record,
                  std::vector<StageTime>& times);

}  // namespace medial_vk::cli
