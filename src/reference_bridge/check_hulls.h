// `--check` of `medial-vk fit`: hulls of balls against the CPU reference, which uses no planes.
#pragma once

#include <functional>
#include <span>

#include "check_reports/check_report.h"
#include "medial_vk/ball_hull.h"
#include "medial_vk/mesh.h"

namespace medial_vk {

/// Tests that every hull lies inside the solid: balls of random weights, and all edges of the axes against all
/// triangles. `progress` gets the share that is done.
CheckReport check_hulls_inside(const PreparedMesh& mesh, std::span<const BallHull> hulls,
                               const std::function<void(double)>& progress = {});

}  // namespace medial_vk
