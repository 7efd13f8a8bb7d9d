// The picture and the page of `medial-vk distance`.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/options/distance_options.h"
#include "cli/shared/load_body.h"
#include "medial_vk/proximity.h"
#include "medial_vk/result.h"
#include "output/atomic_files/atomic_file.h"

namespace medial_vk::cli {

/// A run, as its views see it. One of `distances` and `bounds` is empty, the other has as many as there are poses.
struct DistanceView {
  const LoadedBody& side_a;
  const LoadedBody& side_b;
  const Body& body_a;
  const Body& body_b;
  std::span<const Pose> poses;
  std::span<const Distance> distances;
  std::span<const DistanceBounds> bounds;
};

/// Appends the files that the options name: both solids in the pose of the options' row, without one in that whose
/// upper end is least, the first of several. Error: kOutOfMemory.
Status append_distance_views(const DistanceCommandOptions& options, const DistanceView& view,
                             std::vector<OutputFile>& files);

}  // namespace medial_vk::cli
