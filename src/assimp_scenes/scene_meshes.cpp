#if defined(MEDIAL_VK_HAS_ASSIMP)  // else nothing of assimp may be needed to build
#include "assimp_scenes/scene_meshes.h"

#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include "assimp_scenes/assimp_values.h"
#include "input/polygon_soup.h"
#include "input/text_scanner.h"
#include "mesh/clean_mesh.h"

namespace medial_vk {
namespace {

std::string_view text_of(const aiString& text) { return {text.data, std::min<std::size_t>(text.length, MAXLEN - 1)}; }

/// A node that shows meshes, and its place in the scene.
struct Shown {
  const aiNode* node;
  AffineMap place;
};

class SceneWalk {
 public:
  SceneWalk(const aiScene& scene, const std::string& name) : scene_(scene), name_(name) {}

  /// Finds all nodes, parents first and children in their order, without recursion: no file determines its depth.
  Status find_nodes() {
    std::vector<Shown> open;
    if (scene_.mRootNode != nullptr) open.push_back({scene_.mRootNode, AffineMap()});
    while (!open.empty()) {
      const auto [node, above] = open.back();
      open.pop_back();
      const AffineMap place = above * affine_map_of(node->mTransformation);
      if (node->mNumMeshes > 0) shown_.push_back({node, place});
      places_.emplace(text_of(node->mName), place);
      for (unsigned i = node->mNumChildren; i-- > 0;) open.push_back({node->mChildren[i], place});
      for (unsigned i = 0; i < node->mNumMeshes; ++i) {
        if (node->mMeshes[i] >= scene_.mNumMeshes) return file_error(name_, "a node shows a mesh that is not there");
      }
    }
    return {};
  }

  Status count_corners(std::uint64_t most) const {
    std::vector<std::uint64_t> corners(scene_.mNumMeshes);
    for (unsigned i = 0; i < scene_.mNumMeshes; ++i) corners[i] = corners_of(*scene_.mMeshes[i]);
    std::uint64_t all = 0;
    for (const Shown& shown : shown_) {
      for (unsigned i = 0; i < shown.node->mNumMeshes; ++i) {
        all += corners[shown.node->mMeshes[i]];
        if (all > most) {
          return file_error(name_, fmt::format("the faces of all meshes and their instances have more than {} corners, "
                                               "the most that are read",
                                               most));
        }
      }
    }
    return {};
  }

  Result<std::vector<ScenePart>> make_parts() const {
    std::vector<ScenePart> parts;
    for (const Shown& shown : shown_) {
      Result<ScenePart> part = make_part(shown);
      if (!part) return part.error();
      if (part.value().mesh.triangles.empty()) continue;  // lines and points only
      parts.push_back(std::move(part).value());
    }
    if (parts.empty()) return file_error(name_, fmt::format("no faces ({} meshes)", scene_.mNumMeshes));
    return parts;
  }

 private:
  static std::uint64_t corners_of(const aiMesh& mesh) {
    std::uint64_t corners = 0;
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      if (mesh.mFaces[i].mNumIndices >= 3) corners += mesh.mFaces[i].mNumIndices;
    }
    return corners;
  }

  /// All meshes of a node are one part: formats divide a surface by its materials.
  Result<ScenePart> make_part(const Shown& shown) const {
    ScenePart part;
    part.name = text_of(shown.node->mName);
    PolygonSoup soup;
    for (unsigned i = 0; i < shown.node->mNumMeshes; ++i) {
      const aiMesh& mesh = *scene_.mMeshes[shown.node->mMeshes[i]];
      if (part.name.empty()) part.name = text_of(mesh.mName);
      if (corners_of(mesh) == 0) continue;
      const bool is_reflected = add_vertices(mesh, shown.place, soup);
      if (!add_faces(mesh, is_reflected, soup)) {
        return file_error(
            name_, fmt::format("a face of the mesh {} uses a vertex that is not there", medial_vk::quoted(part.name)));
      }
    }
    const auto is_finite = [](const Point& p) {
      return std::ranges::all_of(p, [](double x) { return std::isfinite(x); });
    };
    if (!std::ranges::all_of(soup.vertices, is_finite)) {
      return file_error(name_, fmt::format("a coordinate of the mesh {} is not finite", medial_vk::quoted(part.name)));
    }
    part.mesh = triangulate(std::move(soup));
    merge_equal_vertices(part.mesh);  // assimp has one vertex for each corner
    return part;
  }

  /// True if the mesh is reflected.
  bool add_vertices(const aiMesh& mesh, const AffineMap& place, PolygonSoup& soup) const {
    const std::size_t first = soup.vertices.size();
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) soup.vertices.push_back(place(point_of(mesh.mVertices[i])));
    const bool is_reflected = place.determinant() < 0;
    return mesh.mNumBones == 0 ? is_reflected : move_by_bones(mesh, is_reflected, soup.vertices.data() + first);
  }

  /// Moves the vertices that follow bones to where the nodes of the bones hold them, the pose at rest: the weighted
  /// mean of the places that the bones give them.
  bool move_by_bones(const aiMesh& mesh, bool is_reflected, Point* vertices) const {
    std::vector<Point> sums(mesh.mNumVertices, Point{0, 0, 0});
    std::vector<double> weights(mesh.mNumVertices, 0.0);
    double turned = 0;  // weights of bones that reflect, less those of others
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
      const aiBone& bone = *mesh.mBones[b];
      const auto found = places_.find(text_of(bone.mName));
      if (found == places_.end()) continue;
      const AffineMap map = found->second * affine_map_of(bone.mOffsetMatrix);
      const double sign = map.determinant() < 0 ? 1 : -1;
      for (unsigned w = 0; w < bone.mNumWeights; ++w) {
        const unsigned vertex = bone.mWeights[w].mVertexId;
        const double weight = static_cast<double>(bone.mWeights[w].mWeight);
        if (vertex >= mesh.mNumVertices || !(weight > 0)) continue;
        const Point p = map(point_of(mesh.mVertices[vertex]));
        for (int k = 0; k < 3; ++k) sums[vertex][k] += weight * p[k];
        weights[vertex] += weight;
        turned += sign * weight;
      }
    }
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      if (!(weights[i] > 0)) continue;
      for (int k = 0; k < 3; ++k) vertices[i][k] = sums[i][k] / weights[i];
    }
    return turned == 0 ? is_reflected : turned > 0;
  }

  /// False: an index is out of range. The vertices of the mesh are the last ones of the soup.
  static bool add_faces(const aiMesh& mesh, bool is_reflected, PolygonSoup& soup) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size() - mesh.mNumVertices);
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& face = mesh.mFaces[i];
      if (face.mNumIndices < 3) continue;
      for (unsigned k = 0; k < face.mNumIndices; ++k) {
        const unsigned index = face.mIndices[is_reflected ? face.mNumIndices - 1 - k : k];
        if (index >= mesh.mNumVertices) return false;
        soup.corners.push_back(first + index);
      }
      soup.sizes.push_back(face.mNumIndices);
    }
    return true;
  }

  const aiScene& scene_;
  const std::string& name_;
  std::vector<Shown> shown_;
  std::map<std::string_view, AffineMap> places_;  // of nodes by name, for bones
};

}  // namespace

Result<std::vector<ScenePart>> meshes_of(const aiScene& scene, const std::string& name, std::uint64_t most_corners) {
  SceneWalk walk(scene, name);
  if (Status status = walk.find_nodes(); !status) return status.error();
  if (Status status = walk.count_corners(most_corners); !status) return status.error();
  return walk.make_parts();
}

}  // namespace medial_vk
#endif
