// Terminal messages of `medial-vk spheres --frames`.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/options/spheres_options.h"
#include "medial_vk/context.h"
#include "medial_vk/follower.h"
#include "medial_vk/measurements.h"
#include "medial_vk/mesh.h"
#include "output/atomic_files/atomic_file.h"

namespace medial_vk::cli {

/// The balls of a set in a frame, which they have followed.
struct MeasuredFrame {
  std::string name;
  FollowMeasures measures;

  double uncovered_share() const { return measures.uncovered() / measures.solid_volume; }
};

/// The mean of the uncovered shares of frames whose volume is known, as that of the rest pose is.
double mean_uncovered(std::span<const MeasuredFrame> frames);

/// Before the work: the mesh, its frames and the device, if there is one.
std::string motion_fit_opening(const SpheresOptions& options, const MeshReport& report, std::uint64_t frames,
                               const std::optional<DeviceDescription>& device);

/// After it: what `count` spheres leave uncovered, and what those of the fit at rest do. `is_of_rest`: they are the
/// same.
std::string motion_fit_summary(const SpheresOptions& options, std::size_t count, std::span<const MeasuredFrame> frames,
                               std::span<const MeasuredFrame> of_rest, bool is_of_rest,
                               const std::vector<StageTime>& times, std::span<const OutputFile> files);

}  // namespace medial_vk::cli
