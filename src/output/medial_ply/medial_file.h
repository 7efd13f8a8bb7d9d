// Medial points as bytes of a file. The layout of the PLY is a fixed contract (docs/formats.md).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "medial_vk/medial_spheres.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// The contents of the header of a medial PLY, all lengths in the units of the input mesh.
struct MedialHeader {
  std::string version;
  Point grid_origin = {0, 0, 0};
  double voxel_size = 0;
  double epsilon = 0;           ///< Length.
  double object_angle = 0;      ///< Radians.
  double radius_threshold = 0;  ///< Length; 0: off.
  /// Points have a property for their side of the boundary: the first so many are inside, the others outside. None:
  /// there is no property, as all are inside.
  std::optional<std::size_t> inside_count = {};

  MeshSide side_of(std::size_t point) const {
    return inside_count && point >= *inside_count ? MeshSide::kOutside : MeshSide::kInside;
  }
};

/// The header of an extraction: fractions become lengths. `longest_side` is that of the box of the search.
MedialHeader make_header(const VoxelGrid& grid, const ExtractionOptions& options, double longest_side);

struct MedialFile {
  MedialHeader header;
  std::vector<MedialSphere> spheres;
};

enum class MedialFormat { kPly, kCsv, kNpz, kJson, kGlb };

/// Determines the format by extension, in upper or lower case. Error: kUsage, which names the known extensions.
Result<MedialFormat> medial_format_of(const std::string& path);

/// Balls as triangles: the number of subdivisions of the icosahedron (output/medial_formats/icosphere.h).
inline constexpr std::uint32_t kUsualSphereDetail = 2;
inline constexpr std::uint32_t kGreatestSphereDetail = 5;

/// The lines of the file header for `header`: "comment medial-vk VERSION" and so on.
std::string ply_comments(const MedialHeader& header);

/// `ascii`: doubles have 17 significant digits and floats 9; both read back exactly.
std::string encode_ply(const MedialHeader& header, std::span<const MedialSphere> spheres, bool ascii);
/// One header line and one line per point; the grid is not included.
std::string encode_csv(const MedialHeader& header, std::span<const MedialSphere> spheres);

/// "inside" or "outside".
const char* side_name(MeshSide side);

/// Reads the output of encode_ply(), binary or text; the voxels are computed as the contract specifies. `name` is for
/// messages. Errors: kInvalidMesh for anything that is not a medial PLY.
Result<MedialFile> decode_ply(std::string_view bytes, const std::string& name);

}  // namespace medial_vk
