// The CPU reference as a backend: `--backend cpu`.
#pragma once

#include <functional>

#include "medial_vk/extraction.h"

namespace medial_vk {

/// The time that an extraction will take, extrapolated from some of its voxels, which were chosen at random.
struct TimeEstimate {
  double seconds = 0;
  int voxels = 0;           ///< Of the sample.
  bool is_cut_off = false;  ///< The last voxel of the sample took too long, and was not finished.
};

/// Runs in double precision, on one thread, without Vulkan. `on_estimate`, if there is one, is called before the
/// search, after up to about a second, in mode certified.
Extractor reference_extractor(const std::function<void(const TimeEstimate&)>& on_estimate = {});

}  // namespace medial_vk
