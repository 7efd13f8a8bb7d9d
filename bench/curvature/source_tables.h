// Table 5-1 and Figure 5-6 of the source, made again.
#pragma once

#include "solid_runs.h"

namespace medial_vk::bench {

/// Means and standard deviations of the curvatures of the wall of a cup, at vertices.
void print_cup_wall(const Settings& settings, Context& context);

/// Mean absolute errors on an oblate spheroid, at the tips of medial points.
void print_spheroid(const Settings& settings, Context& context);

}  // namespace medial_vk::bench
