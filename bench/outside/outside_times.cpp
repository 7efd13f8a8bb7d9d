// bench_outside: the time of the outside of meshes, for each point, beside that of the inside (docs/benchmarks.md).
#include <fmt/core.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "input/read_mesh.h"
#include "medial_vk/certify.h"
#include "medial_vk/context.h"
#include "medial_vk/prepare.h"
#include "support/solids/arrangements.h"

namespace {

using namespace medial_vk;

struct Options {
  std::vector<std::string> meshes;
  bool arrangements = false;
  std::uint32_t resolution = 160;
  double margin = 0.5;
  std::uint32_t runs = 3;
  unsigned threads = 0;
};

/// Of the processor, of all threads of this process: other work on the machine changes it little.
double processor_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

struct Measured {
  double seconds = 0;  // the least of the runs
  std::size_t points = 0, undecided = 0, rejected = 0;

  double per_point() const { return points > 0 ? 1e6 * seconds / static_cast<double>(points) : 0; }
};

Result<Measured> measure(const IndexedMesh& mesh, const Options& options, Context& context) {
  ExtractionOptions how;
  how.resolution = options.resolution;
  how.threads = options.threads;
  Measured out;
  // The first run translates kernels, and does not count.
  for (std::uint32_t run = 0; run <= options.runs; ++run) {
    const double start = processor_seconds();
    const Result<CertifiedExtraction> found = extract_and_certify(mesh, how, context);
    if (!found.ok()) return found.error();
    const double seconds = processor_seconds() - start;
    if (run > 0) out.seconds = run == 1 ? seconds : std::min(out.seconds, seconds);
    out.points = found.value().extraction.spheres.size();
    out.undecided = found.value().extraction.undecided.size();
    out.rejected = found.value().certificate.rejected;
  }
  return out;
}

Status measure_both(const std::string& name, Mesh given, const Options& options, Context& context) {
  Result<PreparedMesh> prepared = prepare_mesh(std::move(given));
  if (!prepared.ok()) return prepared.error();
  const std::size_t triangles = prepared.value().mesh.triangles.size();
  const double margin = options.margin * prepared.value().report.longest_side();
  const Result<IndexedMesh> mesh = IndexedMesh::build(std::move(prepared).value());
  if (!mesh.ok()) return mesh.error();
  const Result<IndexedMesh> outside = mesh.value().on_side({MeshSide::kOutside, margin});
  if (!outside.ok()) return outside.error();
  const Result<IndexedMesh> same_grid = mesh.value().on_side({MeshSide::kInside, margin});
  if (!same_grid.ok()) return same_grid.error();
  fmt::print("| {} | {} |", name, triangles);
  double inside = 0;
  for (const IndexedMesh* searched : {&mesh.value(), &same_grid.value(), &outside.value()}) {
    const Result<Measured> found = measure(*searched, options, context);
    if (!found.ok()) return found.error();
    const Measured& m = found.value();
    if (searched == &mesh.value()) inside = m.per_point();
    fmt::print(" {} | {} | {:.2f} | {:.1f} |", m.points, m.undecided + m.rejected, m.seconds, m.per_point());
    if (searched == &outside.value()) fmt::print(" {:.2f} |\n", inside > 0 ? m.per_point() / inside : 0);
  }
  std::fflush(stdout);
  return {};
}

Status run(const Options& options) {
  Result<Context> context = Context::create();
  if (!context.ok()) return context.error();
  fmt::print("{}, resolution {}, margin {}\n\n", context.value().device().name, options.resolution, options.margin);
  fmt::print("| mesh | triangles |");
  for (const char* side : {"inside", "inside, grid of the outside", "outside"}) {
    fmt::print(" {}: points | undecided | s | us a point |", side);
  }
  fmt::print(" outside / inside, a point |\n|");
  for (int column = 0; column < 15; ++column) fmt::print("---|");
  fmt::print("\n");
  for (const std::string& file : options.meshes) {
    Result<Mesh> mesh = read_mesh(file);
    if (!mesh.ok()) return mesh.error();
    const std::string name = std::filesystem::path(file).stem().string();
    if (Status status = measure_both(name, std::move(mesh).value(), options, context.value()); !status) return status;
  }
  if (!options.arrangements) return {};
  for (const test::Arrangement& parts : test::arrangements()) {
    if (Status status = measure_both(parts.name, parts.make(), options, context.value()); !status) return status;
  }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("The time of the outside of meshes beside that of the inside");
  app.add_option("mesh", options.meshes, "OBJ, PLY, STL or OFF");
  app.add_flag("--arrangements", options.arrangements, "the ten arrangements of parts of the tests, too");
  app.add_option("--resolution", options.resolution, "voxels along the longest side")->check(CLI::Range(1, 4096));
  app.add_option("--margin", options.margin, "as a share of the longest side")->check(CLI::Range(0.01, 10.0));
  app.add_option("--runs", options.runs, "of which the least time counts")->check(CLI::Range(1, 100));
  app.add_option("--threads", options.threads, "0: all");
  CLI11_PARSE(app, argc, argv);
  const Status done = run(options);
  if (!done) fmt::print(stderr, "bench_outside: {}\n", done.error().message);
  return done ? 0 : 1;
}
