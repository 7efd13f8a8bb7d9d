// A plane through a mesh: the rings along which it meets the surface.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "medial_vk/mesh.h"
#include "medial_vk/plane_shape.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// The plane across an axis: z=0.3, or z=50% of the box of the mesh.
struct SlicePlane {
  std::uint32_t axis = 2;  ///< 0: x, 1: y, 2: z.
  double height = 0;       ///< A coordinate, or a share of the box.
  bool is_share = false;
};

/// Of "z=0.3", "x=-2e3" or "y=50%", 100 % at most. Error: kUsage, with what is wrong.
Result<SlicePlane> parse_slice_plane(std::string_view text);

struct MeshSlice {
  std::vector<PlaneRing> rings;          ///< The solid is on the left; inside by FillRule::kNonZero.
  double height = 0;                     ///< The coordinate of the plane.
  std::uint64_t closed_lines = 0;        ///< Open lines, of a mesh with holes, that were closed by a straight segment.
  std::vector<std::string> assumptions;  ///< Full sentences for people.
};

/// Coordinates in the plane are (y, z), (z, x) or (x, y) for the axes x, y and z: as seen from its positive end. A
/// vertex on the plane counts as above it, so a plane within a face has a defined answer: it is that of a plane just
/// below. Vertices at the same place are one. Errors: kInvalidMesh (a coordinate that is not finite or beyond 1e150, an
/// index out of range, a plane that does not meet the mesh), kOutOfMemory.
Result<MeshSlice> slice_mesh(const Mesh& mesh, const SlicePlane& plane);

}  // namespace medial_vk
