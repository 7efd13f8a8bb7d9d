#include "robots/read_collada.h"

#include "input/text_scanner.h"

#if defined(MEDIAL_VK_HAS_ASSIMP)
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <cmath>
#endif

namespace medial_vk {

#if defined(MEDIAL_VK_HAS_ASSIMP)
namespace {

bool is_finite(const Mesh& mesh) {
  for (const Point& p : mesh.vertices) {
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) return false;
  }
  return true;
}

void append(const aiMesh& from, Mesh& to) {
  const auto first = static_cast<std::uint32_t>(to.vertices.size());
  for (unsigned i = 0; i < from.mNumVertices; ++i) {
    const aiVector3D& v = from.mVertices[i];
    to.vertices.push_back({v.x, v.y, v.z});
  }
  for (unsigned i = 0; i < from.mNumFaces; ++i) {
    const aiFace& face = from.mFaces[i];
    if (face.mNumIndices != 3) continue;  // points and lines, which remain after triangulation
    to.triangles.push_back({first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
  }
}

}  // namespace

Result<Mesh> read_collada(const std::string& path) {
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, 1);  // as ROS displays them
  const aiScene* scene = importer.ReadFile(path, aiProcess_Triangulate | aiProcess_PreTransformVertices);
  if (scene == nullptr) return file_error(path, "this is no COLLADA that assimp reads");
  Mesh mesh;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) append(*scene->mMeshes[i], mesh);
  if (!is_finite(mesh)) return file_error(path, "a coordinate is not finite");
  return mesh;
}
#else
Result<Mesh> read_collada(const std::string& path) {
  return file_error(path,
                    "this build reads no COLLADA; build with assimp (-DMEDIAL_VK_COLLADA=ON), or convert it: assimp "
                    "export mesh.dae mesh.obj");
}
#endif

}  // namespace medial_vk
