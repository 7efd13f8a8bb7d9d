// The two modes behind extract().
#pragma once

#include <Eigen/Core>
#include <functional>

#include "cpu_reference/extract.h"
#include "cpu_reference/queries.h"
#include "geometry/grid.h"
#include "search/watch.h"

namespace medial_vk::reference {

/// Runs a function for every top-level cell, until the watch stops.
using CellLoop = std::function<void(const std::function<void(const Eigen::Vector3i&)>&)>;

/// `on_estimate` may be empty.
void extract_certified(const Mesh& mesh, const Tree& tree, const Grid& grid, const Options& options,
                       const CellLoop& loop, Watch& watch, const std::function<void(const TimeEstimate&)>& on_estimate,
                       Result& result);
void extract_thesis(const Mesh& mesh, const Tree& tree, const Grid& grid, const Options& options, const CellLoop& loop,
                    Result& result);

}  // namespace medial_vk::reference
