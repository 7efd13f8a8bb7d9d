// Kernels of the extraction, each by itself (Google Benchmark), by timestamps of the device around every dispatch.
//   build/release/bin/bench_kernels [MESH ...] [--resolution=N] [--benchmark_filter=REGEX] [--benchmark_format=json]
// Without meshes: a flattened torus of 16,000 triangles, whose points are many and easy, and a torus with bumps of
// 100,000, whose contact lists are long. An iteration of all benchmarks of a mesh is one extraction, so their times add
// up, and a disturbance affects all of them. The time of a kernel is the sum over its dispatches on all levels.
// Counters: for each kernel its `share`; for the sum of all, the distances between points and triangles per second
// (`triangle_tests` of the report).
#include <benchmark/benchmark.h>
#include <optional>

#include <cstdio>
#include <cstdlib>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bumpy_torus.h"
#include "input/read_mesh.h"
#include "medial_vk/context.h"
#include "medial_vk/extraction.h"
#include "medial_vk/prepare.h"
#include "support/solids/solids.h"

namespace {

using namespace medial_vk;

constexpr int kRepeats = 5;
constexpr const char* kAll = "all";

/// The seconds of every kernel and of all, and the number of tests of the run.
struct Run {
  std::map<std::string, double> seconds;
  double distances = 0;
};

/// "mark_contacts/1@3": mark_contacts.
std::string kernel_of(const std::string& stage) { return stage.substr(0, stage.find_first_of("/@")); }

Mesh make_flat_torus() {
  Mesh mesh = test::make_torus(1.0, 0.4, 64, 125, 0.5);
  test::rotate(mesh, {1, 2, 3}, 0.7);
  return mesh;
}

[[noreturn]] void give_up(const std::string& message) {
  std::fprintf(stderr, "bench_kernels: %s\n", message.c_str());
  std::exit(1);
}

/// A mesh and its extractions so far, which all its benchmarks share. The first one, which compiled the programs, is
/// not included.
class Subject {
 public:
  Subject(Context& context, std::string name, Mesh mesh, std::uint32_t resolution)
      : context_(&context), name_(std::move(name)) {
    Result<PreparedMesh> prepared = prepare_mesh(std::move(mesh));
    if (!prepared.ok()) give_up(name_ + ": " + prepared.error().message);
    Result<IndexedMesh> indexed = IndexedMesh::build(std::move(prepared).value());
    if (!indexed.ok()) give_up(name_ + ": " + indexed.error().message);
    mesh_.emplace(std::move(indexed).value());
    options_.resolution = resolution;
    options_.measurements.kernel_times = true;
    first_ = extract();
  }

  const std::string& name() const { return name_; }
  const Run& first() const { return first_; }
  const Run& run(std::size_t index) {
    while (runs_.size() <= index) runs_.push_back(extract());
    return runs_[index];
  }

 private:
  Run extract() {
    const Result<Extraction> made = extract_medial_spheres(*mesh_, options_, *context_);
    if (!made.ok()) give_up(name_ + ": " + made.error().message);
    Run run;
    for (const StageTime& stage : made.value().measurements.device_times) {
      run.seconds[kernel_of(stage.stage)] += stage.seconds;
      run.seconds[kAll] += stage.seconds;
    }
    for (const auto& level : made.value().measurements.counters.levels) {
      run.distances += static_cast<double>(level.triangle_tests);
    }
    return run;
  }

  Context* context_;
  std::string name_;
  std::optional<IndexedMesh> mesh_;
  ExtractionOptions options_;
  Run first_;
  std::vector<Run> runs_;
};

/// `next`: the run after those that earlier repetitions have reported.
void time_kernel(benchmark::State& state, Subject* subject, const std::string& kernel, std::size_t& next) {
  double sum = 0, of_all = 0, distances = 0;
  for (auto _ : state) {
    const Run& run = subject->run(next++);
    const auto found = run.seconds.find(kernel);
    const double seconds = found != run.seconds.end() ? found->second : 0;
    state.SetIterationTime(seconds);
    sum += seconds;
    of_all += run.seconds.at(kAll);
    distances += run.distances;
  }
  if (kernel == kAll)
    state.counters["distances"] = benchmark::Counter(distances / sum);
  else
    state.counters["share"] = sum / of_all;
}

void register_kernels(Subject& subject) {
  for (const auto& [kernel, seconds] : subject.first().seconds) {
    const std::string name = subject.name() + "/" + kernel;
    const auto next = std::make_shared<std::size_t>(0);
    const auto time = [subject = &subject, kernel = kernel, next](benchmark::State& state) {
      time_kernel(state, subject, kernel, *next);
    };
    benchmark::RegisterBenchmark(name.c_str(), time)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond)
        ->Iterations(kRepeats);
  }
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  std::uint32_t resolution = 160;
  std::vector<std::string> files;
  for (int i = 1; i < argc; ++i) {
    constexpr std::string_view kResolution = "--resolution=";
    const std::string_view argument = argv[i];
    if (argument.starts_with(kResolution))
      resolution = static_cast<std::uint32_t>(std::strtoul(argv[i] + kResolution.size(), nullptr, 10));
    else if (argument.starts_with("-"))
      give_up("unknown option " + std::string(argument));
    else
      files.emplace_back(argument);
  }
  Result<Context> context = Context::create();
  if (!context.ok()) give_up(context.error().message);
  const DeviceDescription& device = context.value().device();
  benchmark::AddCustomContext("device", device.name);
  benchmark::AddCustomContext("driver", device.driver);
  benchmark::AddCustomContext("resolution", std::to_string(resolution));

  std::deque<Subject> subjects;  // benchmarks keep pointers to them
  for (const std::string& file : files) {
    Result<Mesh> mesh = read_mesh(file);
    if (!mesh.ok()) give_up(mesh.error().message);
    subjects.emplace_back(context.value(), file.substr(file.find_last_of('/') + 1), std::move(mesh).value(),
                          resolution);
  }
  if (files.empty()) {
    subjects.emplace_back(context.value(), "flat-torus-16k", make_flat_torus(), resolution);
    subjects.emplace_back(context.value(), "bumpy-torus-100k", bench::make_bumpy_torus(100'000), resolution);
  }
  for (Subject& subject : subjects) register_kernels(subject);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
