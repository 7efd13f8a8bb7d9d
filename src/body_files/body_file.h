// A body as a file: a mesh with balls inside it and balls that cover it, and what was measured of both
// (docs/formats.md, "Body files").
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/mesh.h"
#include "medial_vk/result.h"
#include "medial_vk/sphere_measures.h"

namespace medial_vk {

/// The number of the layout, raised when an array changes its meaning.
constexpr std::uint32_t kBodyFileFormat = 1;

/// What the fits of both sets have measured. A reader proves the balls again and believes none of it.
struct BodyMeasures {
  double inside_excess = 0;             ///< The greatest radius less distance to the surface; not above 0.
  Bounds inside_gap;                    ///< The greatest distance from the surface to the balls inside.
  Bounds cover_reach_out;               ///< The greatest distance from the balls of the cover to the solid.
  std::uint64_t covered_triangles = 0;  ///< Of which each was covered part by part.
  std::uint64_t envelope_vertices = 0;  ///< Of the cover, of which none is in the solid.
  double solid_volume = 0, inside_volume = 0, cover_volume = 0;
};

struct BodyFile {
  std::string version;  ///< Of the program that wrote it; ASCII.
  Mesh mesh;            ///< Prepared: what IndexedMesh::build() was given.
  std::vector<Ball> inside, cover;
  BodyMeasures measures;
};

/// ".npz" at the end of a name.
bool is_body_file(const std::string& path);

/// The bytes of the file. Error: kOutOfMemory.
Result<std::string> encode_body_file(const BodyFile& file);

/// The content of a file, which may be anything: coordinates and radii are finite, radii are not negative, and indices
/// are in range. Whether balls are inside and cover is not tested. `name` is that of the file in messages. Errors:
/// kInvalidMesh, with the name and the array at fault; kOutOfMemory.
Result<BodyFile> decode_body_file(std::string_view bytes, const std::string& name);

/// The same of a file on disk. Errors: also kInvalidMesh (it cannot be read).
Result<BodyFile> read_body_file(const std::string& path);

}  // namespace medial_vk
