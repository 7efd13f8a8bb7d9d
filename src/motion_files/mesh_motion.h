// A mesh that moves: a mesh at rest, and frames with the positions of the same vertices. It comes from a list of mesh
// files, or from an animation in a glTF file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "medial_vk/mesh.h"
#include "medial_vk/result.h"
#include "scene_files/affine_map.h"
#include "scene_files/scene_parts.h"

namespace medial_vk {

/// A motion has no more frames.
inline constexpr std::uint64_t kMostFrames = 1'000'000;

/// How deep the JSON of a glTF may be nested that is kept to be copied: many times what glTF itself needs, and
/// little for the stack of what writes it by recursion.
inline constexpr std::uint64_t kMostSourceLevels = 512;

/// What moves vertices of an animation: a node of the file, as the joint of a skin or as the node that shows a mesh.
struct RigJoint {
  static constexpr std::uint32_t kNone = 0xffffffffu;

  std::string name;              ///< As in the file: any bytes; may be empty, and need not differ from others.
  std::uint32_t node = 0;        ///< Its index in the file.
  std::uint32_t parent = kNone;  ///< The joint above it, among those of the rig; kNone: none. It may come later.
  AffineMap inverse_bind;        ///< From the frame of the mesh to that of the joint. Of a node: the identity.
  AffineMap rest;                ///< From the frame of the joint to that of the scene, at rest.
};

struct RigInfluence {
  std::uint32_t joint = 0;
  double weight = 0;

  bool operator==(const RigInfluence&) const = default;
};

/// The linear blend skinning of an animation. Where G are the joints of a frame, the place of vertex v is the sum of
/// weight * G[joint] * inverse_bind(bind_positions[v] + what its shapes add) over its influences.
struct MotionRig {
  std::vector<RigJoint> joints;
  std::vector<Point> bind_positions;  ///< By vertex, in the frame of its mesh.
  std::vector<RigInfluence> influences;
  std::vector<std::size_t>
      first_influence;      ///< By vertex, and their number: those of v end where those of v + 1 begin.
  bool has_shapes = false;  ///< Shapes (morph targets) move vertices, too.

  /// Of one vertex: at least one. Their weights are positive, and their sum is 1.
  std::span<const RigInfluence> influences_of(std::size_t vertex) const {
    return std::span(influences)
        .subspan(first_influence[vertex], first_influence[vertex + 1] - first_influence[vertex]);
  }
};

/// The glTF file of an animation, as it was read: its JSON, and the binary chunk of a GLB.
struct GltfSource {
  std::string json, binary;
};

struct MotionFrame {
  std::string name;               ///< The path of its file; of an animation its name, any bytes, and the time.
  std::optional<double> time;     ///< In seconds, of an animation.
  std::vector<Point> positions;   ///< By vertex of the mesh at rest; finite.
  std::vector<AffineMap> joints;  ///< By joint of the rig: from its frame to that of the scene. Empty without a rig.
};

/// A mesh at rest and its frames, which are read or computed one by one.
class MeshMotion {
 public:
  virtual ~MeshMotion() = default;

  /// In the triangles and the order of vertices of the file. Vertices of a scene at the same place are one vertex.
  virtual const Mesh& rest() const = 0;
  virtual std::uint64_t frame_count() const = 0;
  /// Frame `index`, which is below frame_count(), in any order. The memory of `frame` is used again. Errors, with the
  /// name of the file: kInvalidMesh (it cannot be read; other vertices or triangles than at rest, where the first
  /// difference is named; a position that is not finite), kOutOfMemory.
  virtual Status read_frame(std::uint64_t index, MotionFrame& frame) const = 0;
  /// Of an animation; null for mesh files.
  virtual const MotionRig* rig() const { return nullptr; }
  /// Of an animation, with AnimationOptions::keep_source; otherwise null.
  virtual const GltfSource* source() const { return nullptr; }
  /// How many vertices at rest stand for several of the file that other joints, weights or shapes move, so that they
  /// may separate in a frame; such a vertex moves with the first of them.
  virtual std::uint64_t separable_vertices() const { return 0; }
};

/// The frames in `frames`, mesh files of any format, each with as many vertices and the same triangles as `rest`.
/// Polygons may be cut into triangles otherwise: the triangles are those of `rest`. Only `rest` is read at once.
/// Errors: those of read_mesh_file(); kInvalidMesh (a frame is no file; names it), kUsage (no frame, or too many).
Result<std::unique_ptr<MeshMotion>> open_mesh_files(const std::string& rest, std::vector<std::string> frames);

struct AnimationOptions {
  std::string animation = {};        ///< Its name, or its number from 1. Empty: the only one.
  double frames_per_second = 30;     ///< The first frame is at the start.
  std::uint64_t frames = 0;          ///< If not 0: so many, evenly from the start to the end, at any rate.
  std::optional<double> start = {};  ///< In seconds. Without it: the time of the first key.
  std::optional<double> end = {};    ///< Without it: the time of the last key.
  /// The most corners and vertices, and weights of joints, that all instances of all meshes have together.
  std::uint64_t most_values = 2 * kMostSceneCorners;
  bool keep_source = false;  ///< For MeshMotion::source(). Its JSON must not be deeper than kMostSourceLevels.
};

/// The frames of an animation in a glTF or GLB file; "-" is standard input. At rest the mesh is that of
/// read_mesh_file(): joints stand where the nodes of the file put them, and shapes are left out. Errors: kInvalidMesh
/// (the file cannot be read, has no animation, uses what is not supported, or the animation moves no vertex), kUsage
/// (no animation of this name or number, or several without a choice, which are listed; numbers out of range),
/// kOutOfMemory.
Result<std::unique_ptr<MeshMotion>> open_animation(const std::string& path, const AnimationOptions& options = {});

/// The same of the bytes of a file. `path` is that of the file, whose folder may hold other files of it; empty: it
/// stands alone. `name` is used in messages.
Result<std::unique_ptr<MeshMotion>> parse_animation(std::string bytes, const std::string& name, const std::string& path,
                                                    const AnimationOptions& options = {});

}  // namespace medial_vk
