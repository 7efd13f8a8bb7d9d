// How long an extraction takes to stop (docs/reliability.md): stops are requested at moments spread evenly over a run.
//   bench_stops [--stops N] [--resolution N] MESH ...
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "medial_vk/context.h"
#include "medial_vk/extraction.h"
#include "mesh/load_mesh.h"

namespace {

using namespace medial_vk;
using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

template <typename T>
T or_exit(Result<T> result) {
  if (result.ok()) return std::move(result).value();
  std::fprintf(stderr, "bench_stops: %s\n", result.error().message.c_str());
  std::exit(1);
}

struct Latencies {
  double run = 0;             // seconds of a run that nobody stops
  std::vector<double> stops;  // seconds from each request to the return, sorted
};

Latencies measure(Context& context, const MeshView& mesh, const ExtractionParameters& parameters, int count) {
  Latencies out;
  for (int i = 0; i < 2; ++i) {  // the first one compiles
    const Clock::time_point begin = Clock::now();
    or_exit(extract_medial_spheres(context, mesh, parameters));
    out.run = Seconds(Clock::now() - begin).count();
  }
  for (int i = 0; i < count; ++i) {
    std::stop_source source;
    Clock::time_point requested;
    std::jthread other([&] {
      std::this_thread::sleep_for(Seconds(out.run * i / count));
      requested = Clock::now();
      source.request_stop();
    });
    const Result<Extraction> stopped = extract_medial_spheres(context, mesh, parameters, {}, source.get_token());
    const Clock::time_point returned = Clock::now();
    other.join();
    if (stopped.ok()) continue;  // it was done before
    if (stopped.error().code != ErrorCode::kInterrupted) or_exit(stopped);
    out.stops.push_back(Seconds(returned - requested).count());
  }
  std::ranges::sort(out.stops);
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  int count = 50;
  ExtractionParameters parameters;
  std::vector<std::string> meshes;
  CLI::App app("How long an extraction takes to stop");
  app.add_option("--stops", count, "stops for each mesh");
  app.add_option("--resolution", parameters.resolution, "voxels along the longest side");
  app.add_option("mesh", meshes, "OBJ, PLY, STL or OFF")->required();
  CLI11_PARSE(app, argc, argv);
  Context context = or_exit(Context::create());
  fmt::print("{}, {}\n\n| mesh | triangles | run, s | stops | median, ms | worst, ms |\n|---|---|---|---|---|---|\n",
             context.device().name, context.device().driver);
  for (const std::string& path : meshes) {
    const PreparedMesh mesh = or_exit(prepare_mesh(or_exit(read_mesh(path))));
    const Latencies l = measure(context, mesh.view(), parameters, count);
    if (l.stops.empty()) continue;
    fmt::print("| {} | {} | {:.2f} | {} | {:.0f} | {:.0f} |\n", path.substr(path.find_last_of('/') + 1),
               mesh.mesh.triangles.size(), l.run, l.stops.size(), 1e3 * l.stops[l.stops.size() / 2],
               1e3 * l.stops.back());
    std::fflush(stdout);
  }
}
