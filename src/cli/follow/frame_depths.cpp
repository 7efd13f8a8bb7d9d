#include "cli/follow/frame_depths.h"

#include "cli/shared/rest_mesh.h"
#include "medial_vk/sphere_proofs.h"

namespace medial_vk::cli {

Status depths_in_frame(std::span<const Point> vertices, std::span<const Point> points, unsigned threads,
                       IndexedMesh& mesh, std::span<double> depths) {
  if (is_mirrored(mesh.prepared(), vertices)) {
    const Result<IndexedMesh> turned = IndexedMesh::build(moved(mesh.prepared(), vertices), {.threads = threads});
    if (!turned) return turned.error();
    return measure_depths(turned.value(), points, depths, {threads});
  }
  if (Status status = mesh.move_vertices(vertices, {.flags = {}, .threads = threads}); !status) return status;
  return measure_depths(mesh, points, depths, {threads});
}

}  // namespace medial_vk::cli
