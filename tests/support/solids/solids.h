// Closed triangle meshes of known solids, generated for every test and benchmark. All are counter-clockwise from
// outside, watertight, in a generic position only after rotate().
#pragma once

#include <array>
#include <cstdint>

#include "medial_vk/mesh.h"

namespace medial_vk::test {

/// 12 triangles, [0, size] along each axis.
Mesh make_box(Point size);
/// A geodesic sphere about the origin: 20 n^2 triangles, the smallest n that gives at least `triangles`; corners on the
/// sphere, areas within a factor of two of each other.
Mesh make_sphere(double radius, std::uint32_t triangles);
/// Axis z, centred at the origin. `length` is the distance of the two cap centres; 0 gives a sphere with poles.
Mesh make_capsule(double radius, double length, std::uint32_t segments);
/// A geodesic sphere stretched along the axes, about `segments` edges around: oblate, prolate, triaxial.
Mesh make_ellipsoid(Point semi_axes, std::uint32_t segments);
/// L in x-y with its outer corner at the origin and arms along +x and +y, extruded along z from 0 to `height`.
Mesh make_l_shape(double arm, double thickness, double height);
/// A thick cylindrical cup on the plane z = 0, open at the top, its floor as thick as its wall.
Mesh make_cup(double radius, double wall, double height, std::uint32_t segments);
/// Axis z: 2 * around * along triangles, `around` the tube and `along` its circle; the tube's z is scaled by `flatten`.
Mesh make_torus(double major, double minor, std::uint32_t around, std::uint32_t along, double flatten = 1.0);
/// [0, side]^2 x [0, thickness] with a square hole of side `hole` in the middle.
Mesh make_plate_with_hole(double side, double thickness, double hole);
/// [0, 5 a] x [0, 3 a] x [0, thickness] with two square holes of side a in a row: where x / a is from 1 to 2 and from 3
/// to 4.
Mesh make_plate_with_two_holes(double a, double thickness);

/// Seen from the fourth corner, the first three run counter-clockwise.
Mesh make_tetrahedron(const std::array<Point, 4>& corners);
/// A tetrahedron that is 2 long and nowhere thicker than 1e-6.
Mesh make_sliver();
/// A sphere of radius 1, of `triangles` triangles, with a cavity of radius 0.7, of `of_cavity` triangles.
Mesh make_shell(std::uint32_t triangles, std::uint32_t of_cavity);
/// A sphere of `triangles` triangles and, apart from it, a box.
Mesh make_two_parts(std::uint32_t triangles);

/// A torus of radii 1 and 0.4 in a generic position.
Mesh make_turned_torus(std::uint32_t around = 60, std::uint32_t along = 30);

/// The mesh in the form that the library takes, without a trusted normal.
MeshView view_of(const Mesh& mesh, bool closed = true);

/// Bent about x, stretched and moved away: another box, another unit, and every part in another position.
Mesh bent(Mesh mesh);
/// Rigid motions and scalings, in place.
void rotate(Mesh& mesh, Point axis, double angle);
void translate(Mesh& mesh, Point offset);
Mesh moved(Mesh mesh, const Point& offset);
void scale(Mesh& mesh, double factor);

/// Both meshes in one, vertices of `other` after those of `mesh`.
void append(Mesh& mesh, const Mesh& other);
/// Turns every triangle over: the solid becomes a cavity.
void turn_over(Mesh& mesh);
/// The volume by the divergence theorem, in input units cubed.
double signed_volume(const Mesh& mesh);

}  // namespace medial_vk::test
