// The distance of two meshes and of the solids that they enclose, by all pairs of triangles: simple, slow, and shared
// with nothing. Whether triangles cross and on which side of a surface a corner lies is exact, for the corners as they
// are placed; distances are in double: up to rounding, which next to slivers of an aspect of 1e5 is some 1e-11 of
// lengths. Lengths are in the units of the meshes.
#pragma once

#include <Eigen/Core>
#include <array>

#include "cpu_reference/mesh.h"
#include "cpu_reference/queries.h"

namespace medial_vk::reference {

using Corners = std::array<Eigen::Vector3d, 3>;

/// Two points, one of each triangle or mesh, and their distance.
struct NearestPair {
  Eigen::Vector3d on_a, on_b;
  double distance;
};

/// The nearest points of two triangles. They are one of: points of two edges, a corner and a point of the other face,
/// and a common point of an edge and a face, of which the triangles have one if they cross.
NearestPair nearest_of_triangles(const Corners& a, const Corners& b);

/// p -> rotation p + shift, from the frame of b to the frame of a.
struct Motion {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d shift;
};

/// The nearest points of two meshes, in the frame of a. Precondition: each has a triangle.
NearestPair nearest_of_meshes(const Mesh& a, const Mesh& b, const Motion& motion);

/// True if some component of one mesh lies in the solid of the other one (winding number at least 1/2); an open mesh
/// encloses nothing. Precondition: the meshes do not meet, so that one corner of a component tells. A closed mesh has
/// no open edge, and its orientation cancels on every edge.
bool one_holds_the_other(const Mesh& a, const Mesh& b, const Motion& motion);

}  // namespace medial_vk::reference
