#include "cli/shared/load.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/stopwatch.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/messages.h"
#include "input/read_mesh.h"
#include "medial_vk/prepare.h"

namespace medial_vk::cli {
Result<PreparedMesh> load_mesh(const std::string& path, const DeviceOpening& opening, const PrepareOptions& options,
                               std::vector<StageTime>& times) {
  const EndAtOnce guard;
  if (interrupted()) return stopped();
  Stopwatch stopwatch;
  Result<Mesh> mesh = read_mesh(path);
  if (!mesh) return mesh.error();
  times.push_back({"read", stopwatch.lap()});
  const unsigned threads = opening.threads_beside(mesh.value().triangles.size(), options.threads);
  Result<PreparedMesh> prepared = prepare_mesh(std::move(mesh).value(), {options.keep_inner_faces, threads});
  if (!prepared) return Error{prepared.error().code, fmt::format("{}: {}", path, prepared.error().message)};
  times.push_back({"prepare", stopwatch.lap()});
  return prepared;
}

Result<PreparedMesh> load_mesh(const Options& options, const DeviceOpening& opening, std::vector<StageTime>& times) {
  const PrepareOptions prepare = {options.keep_inner_faces, options.threads};
  Result<PreparedMesh> prepared = load_mesh(options.mesh, opening, prepare, times);
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
