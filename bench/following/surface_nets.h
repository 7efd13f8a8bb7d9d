// A closed mesh of the points where a function is zero.
#pragma once

#include <Eigen/Core>
#include <functional>

#include "medial_vk/mesh.h"

namespace medial_vk::bench {

/// The function is negative inside, and positive on the border of the box. One vertex for each cube of a grid of that
/// spacing that the surface crosses, at the mean of the crossings of the cube's edges, and two triangles for each edge
/// that it crosses (Gibson 1998).
Mesh surface_nets(const std::function<double(const Eigen::Vector3d&)>& function, const Eigen::Vector3d& low,
                  const Eigen::Vector3d& high, double spacing);

}  // namespace medial_vk::bench
