// The picture and the page of `medial-vk clearance`.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "cli/clearance/robot_and_scene.h"
#include "cli/options/clearance_options.h"
#include "medial_vk/body_group.h"
#include "medial_vk/pose.h"
#include "medial_vk/result.h"
#include "output/atomic_files/atomic_file.h"
#include "output/distance_files/clearances_csv.h"

namespace medial_vk::cli {

/// A run, as its views see it.
struct ClearanceView {
  const RobotAndScene& all;
  /// Those of the upper ends, where balls or triangles have answered; parts are in the order of the solids.
  const std::optional<BodyGroup>& of_balls;
  const std::optional<BodyGroup>& of_triangles;
  std::span<const Clearance> clearances;
  const std::vector<bool>& by_triangles;  ///< The origin of each clearance.
  /// Places all links in a configuration, by its index.
  std::function<Status(std::size_t, std::span<Pose>)> place;
};

/// Appends the files that the options name: robot and scene in the configuration of the options' row, without one in
/// that whose upper end is least, the first of several, with the two links that have the least distance there. Errors:
/// those of `place`, kOutOfMemory.
Status append_clearance_views(const ClearanceOptions& options, const ClearanceView& view,
                              std::vector<OutputFile>& files);

}  // namespace medial_vk::cli
