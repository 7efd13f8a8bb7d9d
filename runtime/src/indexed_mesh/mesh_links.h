// The edges and vertices of a mesh at which spokes can end, and the possible directions of these spokes
// (docs/theory.md, Lemma D; Lemma I for untrusted triangles): data for the dismissal of cells by pairs.
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
  // By position: sine of a bound of the angle between the triangle's normal and spokes to its points (Lemma L), at most
  // 1; 1 also where nothing is known.
  std::vector<float> spreads;
};

/// `order` lists the triangles in the order of the device: links name positions in it. The time is linear in the size
/// of the mesh, except for one sort of its edges. `threads` 0: one per core.
MeshLinks make_mesh_links(const MeshView& mesh, std::span<const std::uint32_t> order, unsigned threads = 0);

}  // namespace medial_vk
