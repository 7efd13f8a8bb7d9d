// The dual complex of a union of balls, and the vertices of its envelope.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "medial_vk/mesh_view.h"

namespace medial_vk {

/// The dual complex of a union of balls: the nerve of the balls, each restricted to its power cell (zero alpha complex;
/// H. Edelsbrunner, "The union of balls and its dual shape", 1995). Simplices consist of indices of balls, which ascend
/// within a simplex and from one simplex to the next. The complex contains every face of its simplices, and has the
/// homotopy type of the union.
struct DualComplex {
  std::vector<std::uint32_t> vertices;  ///< Balls that are not hidden: those with a share of the union.
  std::vector<std::array<std::uint32_t, 2>> edges;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::array<std::uint32_t, 4>> tetrahedra;
};

/// A point of the envelope at which three spheres meet.
struct EnvelopeVertex {
  Point at;
  std::array<std::uint32_t, 3> balls;  ///< Ascending.
};

}  // namespace medial_vk
