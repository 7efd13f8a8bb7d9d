// Parts that share a number of balls, and what is required of parts and of the number.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "medial_vk/part_fits.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// Those of a link, or all; or one part alone.
struct PartGroup {
  std::vector<std::size_t> parts;
  std::size_t balls = 0;    ///< That they share; 0: other goals give the numbers.
  std::size_t exact = 0;    ///< Parts that are balls.
  bool is_settled = false;  ///< The balls are distributed.

  /// Of the parts that are no balls, in the numbers that a group passes check_group() with.
  std::size_t equal_share() const {
    const std::size_t others = parts.size() - exact;
    return others == 0 ? 1 : std::max<std::size_t>(1, (balls - exact) / others);
  }
};

/// In the order of their first parts.
std::vector<PartGroup> groups_of(std::span<const Part> parts, const PartFitOptions& options);

/// Errors: kUsage.
Status check_part(const Part& part);
/// Error: kUsage if there are fewer balls than parts.
Status check_group(const PartGroup& group, std::span<const Part> parts, const PartFitOptions& options);

/// With SphereFitOptions::max_reach, parts have as many balls as they need. Error: kUsage if these are more than the
/// group may have together.
Status check_needed(const PartGroup& group, std::span<const PartFit> fits, std::span<const Part> parts,
                    const PartFitOptions& options);

/// Bounds the loss or gain of radii where balls are moved to the frame of the link. Earlier measurements then remain
/// true to the digits that are shown. Error: kInvalidMesh.
Status check_position(const Part& part);

}  // namespace medial_vk
