#include "cli/shared/load.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/stopwatch.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/messages.h"
#include "medial_vk/prepare.h"
#include "scene_files/read_mesh_file.h"

namespace medial_vk::cli {
Result<std::vector<ScenePart>> read_meshes(const std::string& path, bool each, std::vector<StageTime>& times) {
  const EndAtOnce guard;
  if (interrupted()) return stopped();
  Stopwatch stopwatch;
  std::vector<ScenePart> parts(1);
  if (each) {
    Result<std::vector<ScenePart>> read = read_mesh_parts(path);
    if (!read) return read.error();
    parts = std::move(read).value();
  } else {
    Result<Mesh> mesh = read_mesh_file(path);
    if (!mesh) return mesh.error();
    parts.front().mesh = std::move(mesh).value();
  }
  times.push_back({"read", stopwatch.lap()});
  return parts;
}

Result<PreparedMesh> prepare_loaded(Mesh mesh, const std::string& path, const DeviceOpening& opening,
                                    const PrepareOptions& options, std::vector<StageTime>& times) {
  const EndAtOnce guard;
  if (interrupted()) return stopped();
  Stopwatch stopwatch;
  const unsigned threads = opening.threads_beside(mesh.triangles.size(), options.threads);
  Result<PreparedMesh> prepared = prepare_mesh(
      std::move(mesh),
      {.keep_inner_faces = options.keep_inner_faces, .threads = threads, .keep_outer_faces = options.keep_outer_faces});
  if (!prepared) return Error{prepared.error().code, fmt::format("{}: {}", path, prepared.error().message)};
  times.push_back({"prepare", stopwatch.lap()});
  return prepared;
}

Result<PreparedMesh> prepare_loaded(Mesh mesh, const Options& options, const DeviceOpening& opening,
                                    std::vector<StageTime>& times) {
  const PrepareOptions prepare = {.keep_inner_faces = options.keep_inner_faces, .threads = options.threads};
  Result<PreparedMesh> prepared = prepare_loaded(std::move(mesh), options.mesh, opening, prepare, times);
  if (!prepared || options.perturb == 0) return prepared;
  const EndAtOnce guard;
  if (interrupted()) return stopped();
  Stopwatch stopwatch;
  prepared = perturb_mesh(std::move(prepared).value(), options.perturb, options.seed, prepare);
  if (prepared) {
    for (std::string& assumption : prepared.value().report.assumptions) {
      assumption = in_words_of_options(std::move(assumption), Command::kExtract);
    }
  }
  times.push_back({"perturb", stopwatch.lap()});
  return prepared;
}

}  // namespace medial_vk::cli
