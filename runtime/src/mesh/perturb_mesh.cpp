// Seeded noise on the vertices, against degenerate positions (Stolpner 2011, 2.4.4).
#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "base/format_text.h"
#include "base/host_memory.h"
#include "base/split_mix.h"
#include "medial_vk/prepare.h"

namespace medial_vk {
namespace {

/// Adds the counts of repairs made before the vertices were moved, which the moved mesh no longer shows.
void carry_over(const MeshReport& before, MeshReport& after) {
  after.merged_vertices += before.merged_vertices;
  after.unused_vertices += before.unused_vertices;
  after.fallback_polygons += before.fallback_polygons;
  after.degenerates_dropped += before.degenerates_dropped;
  after.caps_repaired += before.caps_repaired;
  after.duplicates_dropped += before.duplicates_dropped;
  after.inner_walls_dropped += before.inner_walls_dropped;
  after.reoriented_faces += before.reoriented_faces;
  after.minority_faces += before.minority_faces;
  after.reoriented_components += before.reoriented_components;
  after.cut_faces += before.cut_faces;
  after.inner_faces += before.inner_faces;
  after.outer_faces += before.outer_faces;
  after.hidden_open_edges += before.hidden_open_edges;
  after.inside_out = after.inside_out || before.inside_out;
  std::vector<std::string> assumptions = before.assumptions;
  for (std::string& assumption : after.assumptions) {
    if (std::ranges::find(assumptions, assumption) == assumptions.end()) assumptions.push_back(std::move(assumption));
  }
  after.assumptions = std::move(assumptions);
}

void perturb_vertices(Mesh& mesh, double amplitude, std::uint64_t seed) {
  if (mesh.vertices.empty()) return;
  Point lower = mesh.vertices[0], upper = mesh.vertices[0];
  for (const Point& p : mesh.vertices) {
    for (int k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], p[k]);
      upper[k] = std::max(upper[k], p[k]);
    }
  }
  double longest = 0;
  for (int k = 0; k < 3; ++k) longest = std::max(longest, upper[k] - lower[k]);
  SplitMix random(seed);
  for (Point& p : mesh.vertices) {
    Point offset;  // uniform in the unit ball, by rejection
    do {
      for (double& x : offset) x = random.symmetric();
    } while (offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2] > 1);
    for (int k = 0; k < 3; ++k) p[k] += amplitude * longest * offset[k];
  }
}

}  // namespace

Result<PreparedMesh> perturb_mesh(PreparedMesh mesh, double amplitude, std::uint64_t seed,
                                  const PrepareOptions& options) try {
  const MeshReport before = std::move(mesh.report);
  perturb_vertices(mesh.mesh, amplitude, seed);
  Result<PreparedMesh> perturbed = prepare_mesh(std::move(mesh.mesh), options);
  if (!perturbed) return perturbed;
  MeshReport& report = perturbed.value().report;
  carry_over(before, report);
  report.assumptions.push_back(format_text(
      "Every vertex was moved by up to {} of the longest side (`amplitude`, seed {}); the points are those of "
      "the moved mesh.",
      amplitude, seed));
  return perturbed;
} catch (const std::bad_alloc&) {
  return out_of_memory("moving the vertices of the mesh");
}

}  // namespace medial_vk
