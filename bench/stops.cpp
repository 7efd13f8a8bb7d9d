// The time that an extraction takes to stop (docs/reliability.md): stops are requested at moments spread evenly over a
// run.
//   bench_stops [--mode thesis|certified] [--stops N] [--resolution N] [--seconds S] MESH ...
// Processor time is that of all threads during the wait for a stop, which is independent of the load of the machine. Of
// a run that takes longer than S seconds, only the first S seconds are used for stops.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <ctime>
#include <map>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "helpers.h"
#include "input/read_mesh.h"
#include "medial_vk/context.h"
#include "medial_vk/extraction.h"
#include "medial_vk/prepare.h"

namespace {

using namespace medial_vk;
using bench::or_exit;
using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

struct Latencies {
  double run = 0;             // seconds of a run without a stop
  std::vector<double> stops;  // seconds from each request to the return, sorted
  double most_work = 0;       // seconds of processors in between, at most
};

/// Seconds of a run, `most` at most.
double time_run(Context& context, const IndexedMesh& mesh, const ExtractionOptions& options, double most) {
  const Clock::time_point begin = Clock::now();
  const auto seconds = [&] { return Seconds(Clock::now() - begin).count(); };
  std::stop_source stop;
  const auto on_progress = [&](double) {
    if (seconds() >= most) stop.request_stop();
  };
  const Result<Extraction> ran = extract_medial_spheres(mesh, options, context, on_progress, stop.get_token());
  if (!ran.ok() && ran.error().code != ErrorCode::kInterrupted) or_exit(ran);
  return std::min(seconds(), most);
}

Latencies measure(Context& context, const IndexedMesh& mesh, const ExtractionOptions& options, int count, double most) {
  Latencies out;
  for (int i = 0; i < 2; ++i) out.run = time_run(context, mesh, options, most);  // the first run compiles
  for (int i = 0; i < count; ++i) {
    std::stop_source source;
    Clock::time_point requested;
    std::clock_t before = 0;
    std::jthread other([&] {
      std::this_thread::sleep_for(Seconds(out.run * i / count));
      requested = Clock::now();
      before = std::clock();
      source.request_stop();
    });
    const Result<Extraction> stopped = extract_medial_spheres(mesh, options, context, {}, source.get_token());
    const Clock::time_point returned = Clock::now();
    const std::clock_t after = std::clock();
    other.join();
    if (stopped.ok()) continue;  // the run had already finished
    if (stopped.error().code != ErrorCode::kInterrupted) or_exit(stopped);
    out.stops.push_back(Seconds(returned - requested).count());
    out.most_work = std::max(out.most_work, static_cast<double>(after - before) / CLOCKS_PER_SEC);
  }
  std::ranges::sort(out.stops);
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  int count = 50;
  double seconds = 60;
  ExtractionOptions options;
  std::vector<std::string> meshes;
  CLI::App app("How long an extraction takes to stop");
  app.add_option("--stops", count, "stops for each mesh");
  app.add_option("--resolution", options.resolution, "voxels along the longest side");
  const std::map<std::string, Mode> modes = {{"thesis", Mode::kThesis}, {"certified", Mode::kCertified}};
  app.add_option("--mode", options.mode, "thesis or certified")->transform(CLI::CheckedTransformer(modes));
  app.add_option("--seconds", seconds, "of a run, at most");
  app.add_option("mesh", meshes, "OBJ, PLY, STL or OFF")->required();
  CLI11_PARSE(app, argc, argv);
  Context context = or_exit(Context::create());
  fmt::print(
      "{}, {}\n\n| mesh | triangles | run, s | stops | median, ms | worst, ms | most processor time, ms |\n"
      "|---|---|---|---|---|---|---|\n",
      context.device().name, context.device().driver);
  for (const std::string& path : meshes) {
    const IndexedMesh mesh = or_exit(IndexedMesh::build(or_exit(prepare_mesh(or_exit(read_mesh(path))))));
    const Latencies l = measure(context, mesh, options, count, seconds);
    if (l.stops.empty()) continue;
    fmt::print("| {} | {} | {:.2f} | {} | {:.0f} | {:.0f} | {:.0f} |\n", path.substr(path.find_last_of('/') + 1),
               mesh.view().triangles.size(), l.run, l.stops.size(), 1e3 * l.stops[l.stops.size() / 2],
               1e3 * l.stops.back(), 1e3 * l.most_work);
    std::fflush(stdout);
  }
}
