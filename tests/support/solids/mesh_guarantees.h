// Guarantees about the medial surface of a smooth solid, by a mesh that stays within d of its boundary. Let m be a
// smooth medial point of radius r whose spokes make an angle alpha with the tangent of its sheet or curve.
//
// Position. Across the sheet or curve the smooth distance at h from m is at most r - h sin(alpha) + h^2 / (2 r), the
// mesh's at most d more, and at m it is at least r - d. So the mesh is deepest, or its contacts change sides, within s
// = (8/3) d / sin(alpha) of m as long as s <= r sin(alpha) / 2.
//
// Contacts. All contacts of a point x there are within r + d of x and r + d + s of m: a list of triangles that the tree
// names. Spokes lie between the normals of the triangles that they end on (docs/theory.md, Lemma B).
//
// Sheets. Normals within w_a of one spoke or w_b of the other leave an object angle of alpha - (w_a + w_b) / 2.
//
// Curves. Every direction across the curve has contacts; only few facets tie. At the deepest point of the section the
// spokes, projected to it, surround it, so that two of them are 120 degrees apart or more. If all normals are within w
// of the cone, the object angle is at least asin(sqrt(3)/2 sin(alpha - w)): pi/3 for a fine round tube, where the
// smooth solid has pi/2. Whether a mesh has more than that depends on the facets that tie, so it is evaluated on the
// mesh itself.
//
// The converse. Let x be a point of radius D and object angle alpha that was found in the mesh, and F the nearest point
// of the smooth boundary. One of the two contacts, P, is seen from x at an angle of alpha or more from F, and is at
// most D + w away, where w stands for 2 d and the 2 epsilon of a spoke's tip. Moved by s away from F, x is D + s from F
// and, by the law of cosines, no farther from P once 2 s (D - (D + w) cos(alpha)) >= (D + w)^2 - D^2: a smooth medial
// point lies within s of x. If s exceeds the required distance, facets are so coarse that they have salient sheets of
// their own.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "medial_vk/medial_spheres.h"
#include "medial_vk/mesh.h"
#include "support/solids/smooth_solids.h"

namespace medial_vk::test {

/// A smooth medial point, and an object angle that the mesh is known to have within `reach` of it.
struct Guarantee {
  Eigen::Vector3d point;
  double reach, object_angle;
};

/// For the solid's medial points, `spacing` apart. `deviation`: d above.
std::vector<Guarantee> guarantees_of(const SmoothSolid& solid, const Mesh& mesh, double deviation, double spacing);

/// Bound of the distance from the smooth medial surface of a point of the mesh like `s`; infinite if nothing is known.
double farthest_off(const MedialSphere& s, double deviation, double epsilon);

}  // namespace medial_vk::test
