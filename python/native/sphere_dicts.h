// Options of fits of spheres, and their results as dictionaries, by the names of the package.
#pragma once

#include <pybind11/pybind11.h>

#include <vector>

#include "medial_vk/sphere_fits.h"
#include "native/options.h"

namespace medial_vk::python {

inline pybind11::tuple bounds_tuple(const Bounds& bounds) { return pybind11::make_tuple(bounds.lower, bounds.upper); }

SphereFitOptions read_fit_options(Options& options);

/// With `balls_only` there is the proof of the contract alone.
pybind11::dict measures_dict(const SphereMeasures& measures, bool balls_only);

/// The aim that a fit had: "volume" or "distance".
const char* aim_name(SphereAim aim);

/// Adds `levels`, a list of balls for each, and `reach`, three numbers for each.
void add_levels(const std::vector<std::vector<Ball>>& levels, const std::vector<ReachOut>& reach, pybind11::dict& out);

}  // namespace medial_vk::python
