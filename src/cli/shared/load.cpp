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
namespace {

Result<PreparedMesh> prepare_read(Mesh mesh, const std::string& path, const DeviceOpening& opening, unsigned threads,
                                  std::vector<StageTime>& times) {
  Stopwatch stopwatch;
  threads = opening.threads_beside(mesh.triangles.size(), threads);
  Result<PreparedMesh> prepared = prepare_mesh(std::move(mesh), threads);
  if (!prepared) return Error{prepared.error().code, fmt::format("{}: {}", path, prepared.error().message)};
  times.push_back({"prepare", stopwatch.lap()});
  return prepared;
}

}  // namespace

Result<PreparedMesh> load_mesh(const std::string& path, const DeviceOpening& opening, unsigned threads,
                               std::vector<StageTime>& times) {
  const EndAtOnce guard;
  if (interrupted()) return stopped();
  Stopwatch stopwatch;
  Result<Mesh> mesh = read_mesh_file(path);
  if (!mesh) return mesh.error();
  times.push_back({"read", stopwatch.lap()});
  return prepare_read(std::move(mesh).value(), path, opening, threads, times);
}

Result<std::vector<ScenePart>> read_meshes(const Options& options, std::vector<StageTime>& times) {
  const EndAtOnce guard;
  if (interrupted()) return stopped();
  Stopwatch stopwatch;
  std::vector<ScenePart> parts(1);
  if (options.each) {
    Result<std::vector<ScenePart>> read = read_mesh_parts(options.mesh);
    if (!read) return read.error();
    parts = std::move(read).value();
  } else {
    Result<Mesh> mesh = read_mesh_file(options.mesh);
    if (!mesh) return mesh.error();
    parts.front().mesh = std::move(mesh).value();
  }
  times.push_back({"read", stopwatch.lap()});
  return parts;
}

Result<PreparedMesh> prepare_loaded(Mesh mesh, const Options& options, const DeviceOpening& opening,
                                    std::vector<StageTime>& times) {
  const EndAtOnce guard;
  if (interrupted()) return stopped();
  Result<PreparedMesh> prepared = prepare_read(std::move(mesh), options.mesh, opening, options.threads, times);
  if (!prepared || options.perturb == 0) return prepared;
  Stopwatch stopwatch;
  prepared = perturb_mesh(std::move(prepared).value(), options.perturb, options.seed, options.threads);
  if (prepared) {
    for (std::string& assumption : prepared.value().report.assumptions) {
      assumption = in_words_of_options(std::move(assumption), Command::kExtract);
    }
  }
  times.push_back({"perturb", stopwatch.lap()});
  return prepared;
}

}  // namespace medial_vk::cli
