// Balls in the place of a solid by other methods, and the measures of any balls by the library's own:
//   bench_sphere_peers fit METHOD MESH --count N -o BALLS.csv [--threads N] [--seed N]
//   bench_sphere_peers measure MESH BALLS.csv [--threads N]
// bench/run_spheres --peers runs both. The first prints what its balls are by construction, inside, cover or none, the
// second the measures; both as JSON.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "../helpers.h"
#include "../unions/ball_files.h"
#include "input/read_mesh.h"
#include "medial_vk/prepare.h"
#include "peers.h"
#include "solid/solid.h"

namespace {

using namespace medial_vk;
using namespace medial_vk::bench;

Solid read_solid(const std::string& file) {
  const IndexedMesh mesh = or_exit(IndexedMesh::build(or_exit(prepare_mesh(or_exit(read_mesh(file))))));
  Solid solid = or_exit(Solid::build(mesh));
  if (solid.has_volume()) return solid;
  std::fprintf(stderr, "%s: the mesh does not enclose a volume cleanly, which these methods need\n", file.c_str());
  std::exit(1);
}

const char* word_for(PeerPromise promise) {
  if (promise == PeerPromise::kInside) return "\"inside\"";
  return promise == PeerPromise::kCover ? "\"cover\"" : "null";
}

void fit(const std::string& name, const std::string& mesh, const std::string& output, const PeerOptions& options) {
  for (const PeerMethod& method : peer_methods()) {
    if (method.name != name) continue;
    const std::vector<Ball> balls = method.fit(read_solid(mesh), options);
    std::FILE* file = std::fopen(output.c_str(), "w");
    if (file == nullptr) {
      std::perror(output.c_str());
      std::exit(1);
    }
    fmt::print(file, "x,y,z,radius\n");
    for (const auto& [c, r] : balls) fmt::print(file, "{},{},{},{}\n", c[0], c[1], c[2], r);
    std::fclose(file);
    fmt::print(R"({{"spheres": {}, "promise": {}}})", balls.size(), word_for(method.promise));
    fmt::print("\n");
  }
}

void measure(const std::string& mesh, const std::string& file, unsigned threads) {
  const PeerMeasures found = measure_peer(read_solid(mesh), read_balls(file), threads);
  fmt::print(R"({{"spheres": {}, "inside": {}, "cover": {}, "uncovered_percent": {}, "added_percent": {}, )",
             found.spheres, found.is_inside, found.is_cover, found.uncovered, found.added);
  fmt::print(R"("error_standard_error_percent": {}, "protrusion_percent": {}, "hausdorff_percent": {}}})",
             found.standard_error, found.protrusion, found.hausdorff);
  fmt::print("\n");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Balls in the place of a solid by other methods, and their measures"};
  PeerOptions options;
  std::string name, mesh, balls;
  std::vector<std::string> names;
  for (const PeerMethod& method : peer_methods()) names.emplace_back(method.name);
  CLI::App* fitting = app.add_subcommand("fit", "write balls by one of the methods");
  fitting->add_option("METHOD", name)->required()->check(CLI::IsMember(names));
  fitting->add_option("MESH", mesh)->required();
  fitting->add_option("--count", options.count, "at most so many balls")->check(CLI::Range(1, 1'000'000));
  fitting->add_option("--seed", options.seed);
  fitting->add_option("--threads", options.threads, "0: one per core");
  fitting->add_option("--offset", options.set_cover.offset, "of set-cover, as a share of the longest side");
  fitting->add_option("--uniformity", options.set_cover.uniformity, "of set-cover: weight of distances");
  fitting->add_option("--samples", options.set_cover.samples, "of set-cover: points to be covered");
  fitting->add_option("--candidates", options.set_cover.candidates, "of set-cover: points that make candidates");
  fitting->add_option("--steps", options.descent.steps, "of gradient-*");
  fitting->add_option("--step", options.descent.step, "of gradient-*: the first, as a share of a mean radius");
  fitting->add_option("-o", balls, "a file, x,y,z,radius")->required();
  CLI::App* measuring = app.add_subcommand("measure", "print the measures of balls as JSON");
  measuring->add_option("MESH", mesh)->required();
  measuring->add_option("BALLS", balls)->required();
  measuring->add_option("--threads", options.threads, "0: one per core");
  app.require_subcommand(1);
  CLI11_PARSE(app, argc, argv);
  if (fitting->parsed()) fit(name, mesh, balls, options);
  if (measuring->parsed()) measure(mesh, balls, options.threads);
}
