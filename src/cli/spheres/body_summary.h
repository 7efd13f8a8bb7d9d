// Terminal messages of `medial-vk spheres --contract both`.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/options/spheres_options.h"
#include "medial_vk/context.h"
#include "medial_vk/measurements.h"
#include "medial_vk/mesh.h"
#include "medial_vk/sphere_fits.h"
#include "output/atomic_files/atomic_file.h"

namespace medial_vk::cli {

/// A few lines before the work begins: the input, its assumptions and the device, if there is one.
std::string body_opening(const SpheresOptions& options, const MeshReport& report,
                         const std::optional<DeviceDescription>& device);

/// A few lines at the end, after the files have been written.
std::string body_summary(const SpheresOptions& options, const SphereFit& inside, const SphereFit& cover,
                         const std::vector<StageTime>& times, std::span<const OutputFile> files);

}  // namespace medial_vk::cli
