#include "cli/extract/load.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/stopwatch.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/messages.h"
#include "input/read_mesh.h"
#include "medial_vk/prepare.h"

namespace medial_vk::cli {
namespace {

/// What was done to the mesh before it was perturbed, and is not seen in it any more.
void carry_over(const MeshReport& before, MeshReport& after) {
  after.merged_vertices += before.merged_vertices;
  after.unused_vertices += before.unused_vertices;
  after.fallback_polygons += before.fallback_polygons;
  after.degenerate_dropped += before.degenerate_dropped;
  after.caps_repaired += before.caps_repaired;
  after.duplicates_dropped += before.duplicates_dropped;
  after.inner_walls_dropped += before.inner_walls_dropped;
  after.reoriented_faces += before.reoriented_faces;
  after.minority_faces += before.minority_faces;
  after.reoriented_components += before.reoriented_components;
  after.inside_out = after.inside_out || before.inside_out;
  std::vector<std::string> assumptions = before.assumptions;
  for (std::string& assumption : after.assumptions) {
    const bool known = std::find(assumptions.begin(), assumptions.end(), assumption) != assumptions.end();
    if (!known) assumptions.push_back(std::move(assumption));
  }
  after.assumptions = std::move(assumptions);
}

/// The mesh is prepared before, so that corners at the same place move together, and after, as the flags depend on the
/// places: moved faces may cross.
Result<PreparedMesh> perturb(PreparedMesh prepared, const Options& options) {
  const MeshReport before = std::move(prepared.report);
  Mesh mesh = std::move(prepared.mesh);
  perturb_mesh(mesh, options.perturb, options.seed);
  Result<PreparedMesh> perturbed = prepare_mesh(std::move(mesh));
  if (!perturbed) return perturbed;
  carry_over(before, perturbed.value().report);
  perturbed.value().report.assumptions.push_back(fmt::format(
      "Every vertex was moved by up to {} of the longest side (--perturb, seed {}); the points are those of "
      "the moved mesh.",
      options.perturb, options.seed));
  return perturbed;
}

}  // namespace

Result<PreparedMesh> load_mesh(const std::string& path, std::vector<StageTime>& times) {
  const EndAtOnce guard;
  if (interrupted()) return stopped();
  Stopwatch stopwatch;
  Result<Mesh> mesh = read_mesh(path);
  if (!mesh) return mesh.error();
  times.push_back({"read", stopwatch.lap()});
  Result<PreparedMesh> prepared = prepare_mesh(std::move(mesh).value());
  if (!prepared) return Error{prepared.error().code, fmt::format("{}: {}", path, prepared.error().message)};
  times.push_back({"prepare", stopwatch.lap()});
  return prepared;
}

Result<PreparedMesh> load_mesh(const Options& options, std::vector<StageTime>& times) {
  Result<PreparedMesh> prepared = load_mesh(options.mesh, times);
  if (!prepared || options.perturb == 0) return prepared;
  const EndAtOnce guard;
  if (interrupted()) return stopped();
  Stopwatch stopwatch;
  prepared = perturb(std::move(prepared).value(), options);
  times.push_back({"perturb", stopwatch.lap()});
  return prepared;
}

}  // namespace medial_vk::cli
