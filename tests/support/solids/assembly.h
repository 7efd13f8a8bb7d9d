// A figure as artists make them: limbs, head, eyes, clothes and hair, in parts that overlap and touch, some of them
// open.
#pragma once

#include <cstdint>

#include "medial_vk/mesh.h"

namespace medial_vk::test {

struct AssemblyOptions {
  double fineness = 1;  ///< Of the division of all parts: about 170,000 triangles at 1, in proportion to the square.
  /// A cape of one sheet, and hair as cards of one sheet: many open edges, with little or nothing inside.
  bool has_sheets = false;
};

/// 44 parts; 70 with sheets. Two sleeves are open at both ends: four rims of `50 * fineness` edges, those of the right
/// sleeve inside other parts, those of the left one partly outside. Spheres are inside out, the belt is there twice,
/// the jacket crosses the torso along curves and shares its axis and meridians, the skirt is a thin shell, the eyes lie
/// in the head, and the head touches the torso in one vertex.
Mesh make_assembly(const AssemblyOptions& options);

}  // namespace medial_vk::test
