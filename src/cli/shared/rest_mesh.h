// The mesh at rest, prepared without new vertices, and the vertices of frames in its order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "medial_vk/mesh.h"
#include "medial_vk/result.h"

namespace medial_vk::cli {

/// Vertices of the file that are one vertex of the prepared mesh, but are apart in a frame.
struct PartedVertices {
  std::uint64_t count = 0;  ///< In the frame that has most of them.
  double distance = 0;      ///< The greatest, in mesh units.
};

/// From vertices of the file to vertices of the prepared mesh. Each of these moves as the first of those that it stands
/// for.
class VertexMap {
 public:
  /// The mesh was prepared with `keep_inner_faces`, so that each of its vertices is one of the file.
  explicit VertexMap(const PreparedMesh& mesh);

  /// The vertices of the prepared mesh, of the positions of a frame.
  void map(std::span<const Point> positions, std::vector<Point>& vertices);
  const PartedVertices& parted() const { return parted_; }

 private:
  std::vector<std::uint32_t> vertex_of_input_, first_input_;
  PartedVertices parted_;
};

/// The mesh files that the frames of a command line stand for, patterns among them. Errors: those of
/// files_of_pattern().
Result<std::vector<std::string>> files_of_frames(std::span<const std::string> frames);

/// Proofs and floats of files have room for coordinates up to 1e18. Error: kInvalidMesh, with the name of the mesh.
Status check_size(std::span<const Point> vertices, const std::string& name);

/// Whether the signed volume of a mesh is the volume of its solid: it is closed, and no faces cross or lie inside.
bool encloses_volume(const MeshReport& report);

/// The same of a frame, whose signed volume may be negative: its faces do not cross, none lies inside, and none is
/// turned over beside others. Error: kOutOfMemory.
Result<bool> encloses_volume(const PreparedMesh& rest, std::span<const Point> vertices, unsigned threads);

/// Whether the signed volume of a closed mesh is negative in a frame.
bool is_mirrored(const PreparedMesh& rest, std::span<const Point> vertices);

/// The mesh of a frame, for checks. A mirrored frame (its signed volume is negative, and it is closed) is turned inside
/// out, so that its inside has positive winding numbers.
PreparedMesh moved(const PreparedMesh& rest, std::span<const Point> vertices);

}  // namespace medial_vk::cli
