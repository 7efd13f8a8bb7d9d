// The bound of the distance between the boundary and the surface of balanced balls (SphereFitOptions::max_distance).
#pragma once

#include <algorithm>

#include "medial_vk/sphere_fits.h"
#include "solid/solid.h"

namespace medial_vk {

/// What balls may reach out, and the boundary may be in them, so that a proof to distance_tolerance() succeeds.
inline double near_limit(const SphereFitOptions& options) { return 15.0 / 16 * options.max_distance; }

/// Of the bounds of the measured distance, as a share of the diagonal.
inline double distance_tolerance(const Solid& solid, const SphereFitOptions& options) {
  return std::min(2e-4, options.max_distance / (32 * solid.diagonal()));
}

}  // namespace medial_vk
