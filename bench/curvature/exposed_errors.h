// Spokes from exposed regions of balls against the true ones, and the curvatures at their tips.
#pragma once

#include "solid_runs.h"

namespace medial_vk::bench {

void print_head_of_exposed();

/// Of all balls, and of those without a sheet; then the curvatures at the tips of the latter, in the columns of Errors.
void print_exposed(const SmoothBoundary& solid, const std::vector<MedialSphere>& spheres, const Settings& settings);

}  // namespace medial_vk::bench
