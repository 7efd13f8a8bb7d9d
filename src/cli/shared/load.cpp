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
Result<PreparedMesh> load_mesh(const std::string& path, const DeviceOpening& opening, unsigned threads,
                               std::vector<StageTime>& times) {
  const EndAtOnce guard;
  if (interrupted()) return stopped();
  Stopwatch stopwatch;
  Result<Mesh> mesh = read_mesh_file(path);
  if (!mesh) return mesh.error();
  times.push_back({"read", stopwatch.lap()});
  threads = opening.threads_beside(mesh.value().triangles.size(), threads);
  Result<PreparedMesh> prepared = prepare_mesh(std::move(mesh).value(), threads);
  if (!prepared) return Error{prepared.error().code, fmt::format("{}: {}", path, prepared.error().message)};
  times.push_back({"prepare", stopwatch.lap()});
  return prepared;
}

Result<PreparedMesh> load_mesh(const Options& options, const DeviceOpening& opening, std::vector<StageTime>& times) {
  Result<PreparedMesh> prepared = load_mesh(options.mesh, opening, options.threads, times);
  if (!prepared || options.perturb == 0) return prepared;
  const EndAtOnce guard;
  if (interrupted()) return stopped();
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
