// Medial points in the requested format.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "output/medial_ply/medial_file.h"

namespace medial_vk {

struct PointsEncoding {
  MedialFormat format = MedialFormat::kPly;
  bool ascii = false;           ///< PLY: text.
  bool mesh_spheres = false;    ///< PLY and GLB: the balls as one mesh.
  bool gpu_instancing = false;  ///< GLB: by EXT_mesh_gpu_instancing.
  std::optional<std::uint32_t> sphere_detail;
};

/// Options that a format does not support have no effect. `marks`: PointMark by sphere, for NPZ and JSON. Errors:
/// kCannotWrite for files that would be too large, kOutOfMemory.
Result<std::string> encode_points(const PointsEncoding& encoding, const MedialHeader& header,
                                  std::span<const MedialSphere> spheres, std::span<const std::uint8_t> marks);

}  // namespace medial_vk
