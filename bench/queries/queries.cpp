// Closest points: the centre and 50 samples of each voxel sphere, l = 1/160, and the same points shuffled; by the
// public calls (host to host), by the kernels alone (queries and results stay on the device), and by Embree with as
// many threads. Also few points scattered over the mesh's box, around the number at which the choice of kernel changes.
// Time is process CPU time, including the threads of the driver and of Embree, and wall time.
//   bench_queries [--queries N] [--meshes torus16k,blob100k,blob1m,FILE,...] [--benchmark_* ...]
#include <benchmark/benchmark.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <sstream>
#include <string>
#include <thread>

#include "../helpers.h"
#include "device/context_impl.h"
#include "device_run.h"
#include "embree_peer.h"
#include "input/read_mesh.h"
#include "medial_vk/scene.h"
#include "medial_vk/version.h"
#include "query_table.h"
#include "query_workload.h"
#include "support/solids/solids.h"

namespace medial_vk::bench {
namespace {

constexpr std::array<std::size_t, 4> kFew = {256, 1024, 4096, 16384};
constexpr std::size_t kFewInAll = 65536;  // queries per pass
#ifdef NDEBUG
constexpr const char* kBuild = "optimised";
#else
constexpr const char* kBuild = "with assertions: no figure of this run counts";
#endif

/// The data of all benchmarks of one mesh.
struct Subject {
  explicit Subject(Workload w) : workload(std::move(w)) {}
  Workload workload;
  std::unique_ptr<Scene> scene;
  std::unique_ptr<DeviceRun> device;
  std::unique_ptr<EmbreePeer> peer;
  std::vector<std::unique_ptr<DeviceRun>> few;  // kFew points each
  std::vector<std::array<float, 3>> float_spheres, float_shuffled;
  std::vector<float> distances;
  std::vector<ClosestPoint> closest;
};

std::vector<std::array<float, 3>> to_float(const std::vector<Point>& points) {
  std::vector<std::array<float, 3>> out;
  out.reserve(points.size());
  for (const Point& p : points) {
    out.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
  }
  return out;
}

Mesh mesh_named(const std::string& name) {
  if (name == "blob100k") return make_blob(100'000);
  if (name == "blob1m") return make_blob(1'000'000);
  if (name != "torus16k") return or_exit(read_mesh(name));
  Mesh mesh = test::make_torus(1, 0.4, 64, 125);
  test::rotate(mesh, {1, 2, 3}, 0.7);
  return mesh;
}

std::unique_ptr<Subject> make_subject(Context& context, const std::string& name, std::uint64_t queries,
                                      unsigned threads) {
  const std::string stem = std::filesystem::path(name).stem().string();
  auto s = std::make_unique<Subject>(or_exit(make_workload(context, stem, mesh_named(name), queries)));
  const Workload& w = s->workload;
  const MeshView view{w.mesh.vertices, w.mesh.triangles, {}, true};
  s->scene = std::make_unique<Scene>(or_exit(Scene::create(context, or_exit(IndexedMesh::build(view)))));
  s->device = or_exit(DeviceRun::create(Internals::of(context), view, w.spheres, kGroup, w.shuffled));
  for (const std::size_t count : kFew) {
    const std::vector<Point> points = scattered_points(w, count);
    s->few.push_back(or_exit(DeviceRun::create(Internals::of(context), view, points, 1, points)));
  }
  if (!EmbreePeer::version().empty()) s->peer = std::make_unique<EmbreePeer>(w.mesh, threads);
  s->float_spheres = to_float(w.spheres);
  s->float_shuffled = to_float(w.shuffled);
  s->distances.resize(w.spheres.size());
  s->closest.resize(w.spheres.size());
  return s;
}

/// `pass` answers all queries once and returns the seconds on the device, or 0 if unknown.
void add_benchmark(const Subject& subject, const std::string& name, std::size_t count,
                   const std::function<double()>& pass) {
  const auto queries = static_cast<double>(count);
  const auto warm = std::make_shared<bool>(false);
  benchmark::RegisterBenchmark((subject.workload.name + "/" + name).c_str(),
                               [=](benchmark::State& state) {
                                 if (!*warm) pass();  // pipelines are created, pages are touched
                                 *warm = true;
                                 double device = 0;
                                 for (auto _ : state) device += pass();
                                 state.counters["queries"] = queries;
                                 if (device > 0)
                                   state.counters["device_s"] = device / static_cast<double>(state.iterations());
                               })
      ->MeasureProcessCPUTime()
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond)
      ->Iterations(1);
}

double require(const Status& status) {
  if (!status.ok()) or_exit(Result<int>(status.error()));
  return 0;
}

void add_benchmarks(Subject& s) {
  const Workload& w = s.workload;
  const std::size_t n = w.spheres.size();
  // Both write into existing memory, as the peer does.
  add_benchmark(s, "spheres/call", n,
                [&] { return require(s.scene->closest_points_of_groups(w.spheres, kGroup, s.closest)); });
  add_benchmark(s, "spheres/packets", n, [&] { return s.device->spheres_by_packets(); });
  add_benchmark(s, "shuffled/call", n, [&] { return require(s.scene->closest_points(w.shuffled, s.closest)); });
  add_benchmark(s, "shuffled/packets_sorted", n, [&] { return s.device->scattered_by_packets(); });
  add_benchmark(s, "shuffled/one_by_one_sorted", n, [&] { return s.device->sorted_one_by_one(); });
  add_benchmark(s, "shuffled/one_by_one", n, [&] { return s.device->scattered_one_by_one(); });
  for (std::size_t i = 0; i < kFew.size(); ++i) {
    const std::string name = "few" + std::to_string(kFew[i]);
    const auto repeated = [&run = *s.few[i], times = kFewInAll / kFew[i]](double (DeviceRun::*pass)()) {
      double seconds = 0;
      for (std::size_t k = 0; k < times; ++k) seconds += (run.*pass)();
      return seconds;
    };
    add_benchmark(s, name + "/packets_sorted", kFewInAll, [=] { return repeated(&DeviceRun::scattered_by_packets); });
    add_benchmark(s, name + "/one_by_one", kFewInAll, [=] { return repeated(&DeviceRun::scattered_one_by_one); });
  }
  if (!s.peer) return;
  const auto embree = [&s](const std::vector<std::array<float, 3>>& queries) {
    s.peer->distances(queries, s.distances);
    return 0.0;
  };
  add_benchmark(s, "spheres/embree", n, [&s, embree] { return embree(s.float_spheres); });
  add_benchmark(s, "shuffled/embree", n, [&s, embree] { return embree(s.float_shuffled); });
}

unsigned driver_threads() {
  const char* threads = std::getenv("LP_NUM_THREADS");
  const int count = threads != nullptr ? std::atoi(threads) : 0;
  return count > 0 ? static_cast<unsigned>(count) : std::max(1u, std::thread::hardware_concurrency());
}

int run(int argc, char** argv) {
  std::uint64_t queries = 300'000;
  std::string meshes = "torus16k,blob100k,blob1m";
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::string(argv[i]) == "--queries") queries = std::strtoull(argv[i + 1], nullptr, 10);
    if (std::string(argv[i]) == "--meshes") meshes = argv[i + 1];
  }
  Context context = or_exit(Context::create({}));
  const unsigned threads = driver_threads();
  const std::string peer = EmbreePeer::version().empty() ? "not built in (libembree-dev)" : EmbreePeer::version();
  const std::string about = context.device().name + "; " + context.device().driver + "; " + std::to_string(threads) +
                            " threads; Embree: " + peer + "; medial_vk " + version() + ", " + kBuild + ", compiler " +
                            __VERSION__ + "; at least " + std::to_string(queries) + " queries a mesh";
  benchmark::AddCustomContext("device", about);
  std::vector<std::unique_ptr<Subject>> subjects;
  std::istringstream names(meshes);
  for (std::string name; std::getline(names, name, ',');) {
    subjects.push_back(make_subject(context, name, queries, threads));
    add_benchmarks(*subjects.back());
  }
  QueryTable table;
  benchmark::RunSpecifiedBenchmarks(&table);
  std::printf("\n%s.\n\n%s", about.c_str(), table.markdown().c_str());
  return 0;
}

}  // namespace
}  // namespace medial_vk::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  return medial_vk::bench::run(argc, argv);
}
