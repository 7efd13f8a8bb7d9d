// From bytes of any format, distinguished by content, to a prepared mesh.
#include <sched.h>

#include "fuzz/require.h"
#include "input/read_mesh.h"
#include "medial_vk/prepare.h"

namespace medial_vk::fuzz {
namespace {

void require_prepared(const PreparedMesh& prepared, std::size_t vertices_given, std::size_t triangles_given) {
  const Mesh& mesh = prepared.mesh;
  const MeshReport& report = prepared.report;
  require(!mesh.triangles.empty(), "a prepared mesh has triangles");
  require(report.vertices == mesh.vertices.size() && report.triangles == mesh.triangles.size(), "counts are right");
  require(prepared.flags.size() == mesh.triangles.size(), "every triangle has flags");
  require(prepared.vertex_of_input.size() == vertices_given, "every input vertex is accounted for");
  require(prepared.input_of_triangle.size() == mesh.triangles.size(), "every triangle comes from one of the input");
  for (const std::uint32_t v : prepared.vertex_of_input) {
    require(v == PreparedMesh::kDropped || v < mesh.vertices.size(), "input vertices become vertices or are dropped");
  }
  for (const std::uint32_t t : prepared.input_of_triangle)
    require(t < triangles_given, "triangles come from the input");
  std::vector<bool> used(mesh.vertices.size(), false);
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) {
      require(v < mesh.vertices.size(), "faces use existing vertices");
      used[v] = true;
      for (int k = 0; k < 3; ++k) {
        const double x = mesh.vertices[v][k];
        require(x >= report.lower[k] && x <= report.upper[k], "the box holds the mesh");
      }
    }
    require(t[0] != t[1] && t[1] != t[2] && t[2] != t[0], "a triangle has three corners");
  }
  for (const bool is_used : used) require(is_used, "every vertex is of a triangle");
  require(!report.closed || report.open_edges == 0, "a closed mesh has no open edge");
  require(report.signed_volume == report.signed_volume, "the volume is a number");
  for (const std::string& sentence : report.assumptions) require(sentence.ends_with("."), "assumptions are sentences");
}

}  // namespace
}  // namespace medial_vk::fuzz

/// One core: loops over a handful of triangles are then not spread over threads, which would take most of the time.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(sched_getcpu(), &one);
  sched_setaffinity(0, sizeof(one), &one);
  return 0;
}

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace medial_vk;
  const std::string_view bytes = fuzz::as_text(data, size);
  Result<Mesh> mesh = parse_mesh(bytes, fuzz::kName);
  fuzz::require_mesh_or_message(mesh, bytes);
  if (!mesh.ok()) return 0;
  fuzz::require(!mesh.value().triangles.empty(), "a mesh that was read has triangles");
  const std::size_t vertices = mesh.value().vertices.size(), triangles = mesh.value().triangles.size();
  const Result<PreparedMesh> prepared = prepare_mesh(std::move(mesh).value());
  if (prepared.ok()) {
    fuzz::require_prepared(prepared.value(), vertices, triangles);
  } else {
    fuzz::require_clear(prepared.error(), ErrorCode::kInvalidMesh);
  }
  return 0;
}
