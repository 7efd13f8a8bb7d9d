// Sidedness: the side of each triangle on which the inside lies, and the correction of inside-out components.
#pragma once

#include <vector>

#include "medial_vk/mesh.h"
#include "mesh/crossings/self_intersections.h"
#include "mesh/crossings/triangle_tree.h"
#include "mesh/mesh_topology.h"
#include "mesh/surface_parts.h"

namespace medial_vk {

/// The bound of the error of WindingTree on open meshes; a number within it of 0 or 1 decides nothing about a normal.
constexpr float kSideError = 0.03f;
/// A number above this encloses something: well above the mean error; a flat sheet has 0.
constexpr float kEncloses = 0.01f;

struct Sidedness {
  /// By triangle: the winding number at its centroid without itself; the inside lies behind and the outside in front
  /// if it is in [0, 1), since the triangle adds 1/2 behind and subtracts 1/2 in front. NaN: not evaluated.
  std::vector<float> beside;
  bool known = true;               ///< False if some were not evaluated, because that would have taken too long.
  std::uint64_t turned_faces = 0;  ///< Faces turned over with their whole component.
  std::uint64_t turned_components = 0;
};

/// Turns inside-out components over (mesh, topology and tree follow), then determines the winding number beside each
/// triangle.
///
/// Closed mesh: winding numbers are integers that change only across triangles, so one evaluation holds for a whole
/// patch without crossings. A patch between the levels -k and -k - 1 is inside out: turning all of these makes the
/// field |w|, which has the same shape. Other meshes are evaluated triangle by triangle, and a component is turned over
/// if most of it faces an inside that has a negative winding number, both by itself and together with the others. In a
/// tangle of large triangles only some are evaluated, spread evenly, and decide for their component.
Sidedness decide_sides(Mesh& mesh, MeshTopology& topology, TriangleTree& tree, const SurfaceParts& parts, bool closed,
                       const SelfIntersections& intersections, unsigned threads);

}  // namespace medial_vk
