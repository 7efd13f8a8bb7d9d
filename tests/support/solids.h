// Closed triangle meshes of known solids, made in place, for every test and benchmark.
// All are counter-clockwise from outside, watertight, in a generic position only after rotate().
#pragma once

#include <cstdint>

#include "mesh/mesh.h"

namespace medial_vk::test {

Mesh make_box(Point size);                                  // 12 triangles, corner at the origin
Mesh make_sphere(double radius, std::uint32_t triangles);   // at least this many, evenly spread
Mesh make_capsule(double radius, double length, std::uint32_t segments);  // axis z, centred
Mesh make_ellipsoid(Point semi_axes, std::uint32_t segments);             // oblate, triaxial
Mesh make_l_shape(double arm, double thickness, double height);  // L in x-y, extruded along z
Mesh make_cup(double radius, double wall, double height, std::uint32_t segments);  // thick cylindrical cup
Mesh make_torus(double major, double minor, std::uint32_t around, std::uint32_t along, double flatten = 1.0);
Mesh make_plate_with_hole(double side, double thickness, double hole);    // square hole

/// Rigid motions and scalings, in place.
void rotate(Mesh& mesh, Point axis, double angle);
void translate(Mesh& mesh, Point offset);
void scale(Mesh& mesh, double factor);

}  // namespace medial_vk::test
