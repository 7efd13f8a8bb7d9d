// Collapses of the dual complex of a union of balls to a surface, which preserve the homotopy type. docs/theory.md,
// "The medial mesh".
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "medial_vk/ball_union.h"

namespace medial_vk {

struct CollapseRule {
  /// The square of the length of an edge.
  std::function<double(std::uint32_t, std::uint32_t)> squared_length;
  /// True if two vertices are so close that an edge between them may end a sheet.
  std::function<bool(std::uint32_t, std::uint32_t)> close;
};

/// The rest of a complex after the collapse of all tetrahedra, of triangles at the border with an edge that is not
/// close, and of fins; it has no tetrahedra, all the vertices, and the homotopy type of the complex. The result depends
/// only on the complex and the rule. Precondition: the complex lies in space, as those of measure_ball_union() do.
DualComplex collapse_to_surface(const DualComplex& complex, const CollapseRule& rule);

}  // namespace medial_vk
