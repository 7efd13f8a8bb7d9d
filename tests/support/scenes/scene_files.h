// Files of scenes in memory, for the tests of what reads them.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "medial_vk/mesh.h"

namespace medial_vk::test {

/// A node of a glTF. Its children are those that follow it and name it as their parent.
struct SceneNode {
  std::string name;
  int mesh = -1;    ///< Index of a mesh; -1: none.
  int parent = -1;  ///< Index of an earlier node; -1: none.
  std::array<double, 3> translation = {0, 0, 0};
  std::array<double, 4> rotation = {0, 0, 0, 1};
  std::array<double, 3> scale = {1, 1, 1};
  int skin = -1;                  ///< Index of the only joint of a skin that moves all of the mesh; -1: none.
  bool has_bind_matrices = true;  ///< Of the skin, at the identity. glTF does not require them.
};

/// The meshes of a glTF, each a list of primitives.
struct SceneMesh {
  std::vector<Mesh> primitives;
  int mode = 4;  ///< Of glTF: 4 triangles, 1 lines, 0 points.
};

/// Where a glTF has its buffer.
enum class GltfBuffer { kInside, kBeside, kGlb };

struct GltfFile {
  std::string text;    ///< The glTF, or the GLB.
  std::string buffer;  ///< The file that it names `uri`, if the buffer lies beside it.
};

GltfFile to_gltf(const std::vector<SceneMesh>& meshes, const std::vector<SceneNode>& nodes,
                 GltfBuffer where = GltfBuffer::kInside, const std::string& uri = "scene.bin");

/// COLLADA with one geometry of polygons, shown by one node.
std::string to_collada(const std::vector<Point>& vertices, const std::vector<std::vector<int>>& polygons,
                       const std::string& metres = "1", const std::string& up = "Y_UP");

/// Binary FBX with one mesh of triangles, moved by `translation` and scaled by `scale`.
std::string to_fbx(const Mesh& mesh, const std::string& name, const Point& translation = {0, 0, 0},
                   const Point& scale = {1, 1, 1});

/// A zip of files by name, and a 3MF of meshes, each moved by the 12 numbers of its transform.
std::string to_zip(const std::vector<std::pair<std::string, std::string>>& files);
std::string to_3mf(const std::vector<std::pair<Mesh, std::string>>& items, const std::string& unit = "millimeter");

}  // namespace medial_vk::test
