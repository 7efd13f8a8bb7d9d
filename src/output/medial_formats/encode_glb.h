// Balls as a scene of glTF 2.0, in one file (GLB).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "output/medial_ply/medial_file.h"

namespace medial_vk {

enum class GlbLayout {
  kNodes,         ///< A node per ball; balls of a colour share a mesh. Plain glTF, supported by all readers.
  kGpuInstances,  ///< A node per colour with arrays of positions and sizes: EXT_mesh_gpu_instancing, required.
  kOneMesh,       ///< All balls in one mesh with vertex colours. Plain glTF, large.
};

/// Numbers are in single precision, relative to the middle of all centres, which the root node holds; every ball is
/// inside the exact one. docs/formats.md describes the layout. Error: kCannotWrite if the file is too large.
Result<std::string> encode_glb(const MedialHeader& header, std::span<const MedialSphere> spheres, GlbLayout layout,
                               std::optional<std::uint32_t> detail);

}  // namespace medial_vk
