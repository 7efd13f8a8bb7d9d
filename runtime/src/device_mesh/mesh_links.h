// Where spokes can end on a mesh, and which way they point there (docs/theory.md, Lemma D; I where it is not trusted):
// what the dismissal of cells by pairs asks about edges and vertices.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu_types.h"
#include "medial_vk/mesh_view.h"

namespace medial_vk {

struct MeshLinks {
  std::vector<gpu::TriangleLinks> links;  // by position in `order`
  // By vertex: axis and half-angle of a cap that holds all spokes to it; then of arcs, to edges of untrusted triangles.
  std::vector<gpu::vec4> corners;
  // By position: sine of an angle that no spoke to a point of the triangle is farther from its normal (Lemma L), not
  // above 1; 1 also where nothing is known.
  std::vector<float> spreads;
};

/// `order` lists the triangles as the device does: links name positions in it. Linear in the size of the mesh, up to
/// one sort of its edges. `threads` 0: as many as the machine has.
MeshLinks make_mesh_links(const MeshView& mesh, std::span<const std::uint32_t> order, unsigned threads = 0);

}  // namespace medial_vk
