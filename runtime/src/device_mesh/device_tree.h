// The arrays of a mesh that kernels read: triangles and tree as texels.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "device_mesh/unit_transform.h"
#include "gpu_types.h"
#include "medial_vk/bvh.h"
#include "medial_vk/mesh_view.h"

namespace medial_vk {

using Texel = std::array<float, 4>;

/// Rounded to float.
inline gpu::vec4 to_vec4(const Point& p, double w) {
  return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]), static_cast<float>(w)};
}

/// A box in the unit box, rounded outwards so far that it holds the float triangles too.
struct FloatBox {
  std::array<float, 3> lower;
  std::array<float, 3> upper;
};
FloatBox float_box(const BvhBox& box, const UnitTransform& to_unit);

/// Four texels per triangle in leaf order; `flags` as MeshView::flags, `spreads` as MeshLinks::spreads or none.
std::vector<Texel> make_triangle_texels(const Bvh& bvh, const UnitTransform& to_unit,
                                        std::span<const std::uint8_t> flags, std::span<const float> spreads = {},
                                        unsigned threads = 0);

/// Inner nodes: 4 texels each with the boxes of both children, and after all of those 8 texels each with the moments
/// of both children. At least one inner node, even if the mesh fits a leaf.
std::vector<Texel> make_tree_texels(const Bvh& bvh, const UnitTransform& to_unit, unsigned threads = 0);

constexpr std::uint32_t kTexelsPerTriangle = 4;
constexpr std::uint32_t kTexelsPerNode = 12;

}  // namespace medial_vk
