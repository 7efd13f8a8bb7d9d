#include "cli/batch/mesh_digest.h"

#include "common/digest.h"

namespace medial_vk::cli {

std::string mesh_digest(const Mesh& mesh) {
  Digest digest;
  digest.add(mesh);
  digest.add(mesh.short_polygons);
  digest.add(mesh.fallback_polygons);
  return digest.text();
}

}  // namespace medial_vk::cli
