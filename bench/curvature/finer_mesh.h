// The same solid with four times as many triangles: how much the curvature at the same points changes.
#pragma once

#include "solid_runs.h"

namespace medial_vk::bench {

void print_head_of_finer_mesh();

/// Each tip is compared with the nearest one of the finer mesh, at most a spacing of balls away. What the curvature of
/// the solid itself changes between both places is left out.
void print_finer_mesh(const std::string& name, const Settings& settings, Context& context);

}  // namespace medial_vk::bench
