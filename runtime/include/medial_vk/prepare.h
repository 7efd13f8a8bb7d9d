// Preparation: any triangles become a mesh that can be searched, with a report of the assumptions that were made.
#pragma once

#include <cstdint>

#include "medial_vk/mesh.h"
#include "medial_vk/result.h"

namespace medial_vk {

struct PrepareOptions {
  /// Keep the faces that do not bound the solid as a part of its boundary, and do not cut faces along their crossings.
  /// The prepared mesh then has no other vertices than the given one.
  bool keep_inner_faces = false;
  unsigned threads = 0;  ///< Of the host, 0: one per core. The result does not depend on it.
  /// Keep those parts of membranes (open, flat surfaces that cross others and enclose nothing) that lie outside the
  /// solid. They do not bound it, but a cover of spheres should hold them.
  bool keep_outer_faces = false;

  bool operator==(const PrepareOptions&) const = default;
};

/// Merges equal vertices, drops degenerate and duplicate faces and unused vertices, makes the orientation of each
/// component consistent (and outward, if the whole mesh is inside out), and determines which normals can be trusted.
/// Faces that cross are cut along their crossings, and faces inside the solid are left out. Beside such a face the
/// winding number, of all components or of all but its own, is at least 1/2 on both sides. Membranes do not count, and
/// are left out inside and outside (docs/theory.md, "The boundary of overlapping parts"). The vertices on crossings
/// follow the others. Does not throw. Errors: kInvalidMesh (an index out of range, a coordinate that is not finite;
/// nothing is left, or nothing is enclosed), kOutOfMemory.
Result<PreparedMesh> prepare_mesh(Mesh mesh, const PrepareOptions& options = {});

/// Moves every vertex by a seeded random vector of length up to `amplitude` times the longest side (2.4.4), and
/// prepares the mesh again, as moved faces may cross. Corners that coincide move together. The report covers both
/// preparations. Errors: those of prepare_mesh().
Result<PreparedMesh> perturb_mesh(PreparedMesh mesh, double amplitude, std::uint64_t seed,
                                  const PrepareOptions& options = {});

}  // namespace medial_vk
