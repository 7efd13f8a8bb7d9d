// The work on a mesh before its extraction, by triangles (Google Benchmark): the hierarchy built and refitted, and all
// other steps on the host.
//   build/release/bin/bench_build [--benchmark_filter=REGEX] [--benchmark_format=json]
// The counter `sah` is the cost of the tree by the surface area heuristic: the expected number of boxes and triangles
// that a random line through the mesh's box tests.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <thread>

#include "bumpy_torus.h"
#include "device_mesh/device_tree.h"
#include "indexed_mesh/mesh_links.h"
#include "input/read_mesh.h"
#include "medial_vk/bvh.h"
#include "medial_vk/prepare.h"

namespace {

using namespace medial_vk;

const Mesh& mesh_of(std::int64_t triangles) {
  static std::map<std::int64_t, Mesh> meshes;
  const auto [entry, is_new] = meshes.try_emplace(triangles);
  if (is_new) entry->second = bench::make_bumpy_torus(static_cast<std::uint32_t>(triangles));
  return entry->second;
}

MeshView view_of(const Mesh& mesh) { return {mesh.vertices, mesh.triangles, {}, true}; }

double half_area(const BvhBox& box) {
  const double x = box.upper[0] - box.lower[0], y = box.upper[1] - box.lower[1], z = box.upper[2] - box.lower[2];
  return x * y + y * z + z * x;
}

double sah_cost(const Bvh& bvh) {
  double cost = 0;
  for (const BvhNode& node : bvh.nodes()) cost += half_area(node.box) * (node.count == 0 ? 2 : node.count);
  return cost / half_area(bvh.nodes().front().box);
}

void build(benchmark::State& state) {
  const Mesh& mesh = mesh_of(state.range(0));
  const auto leaf_size = static_cast<std::uint32_t>(state.range(1));
  const auto threads = static_cast<unsigned>(state.range(2));
  double sah = 0;
  for (auto _ : state) {
    const Result<Bvh> bvh = Bvh::build(view_of(mesh), {.leaf_size = leaf_size, .threads = threads});
    state.PauseTiming();
    if (!bvh.ok()) state.SkipWithError(bvh.error().message.c_str());
    sah = sah_cost(bvh.value());
    state.ResumeTiming();
  }
  state.counters["sah"] = sah;
  state.counters["triangles"] = static_cast<double>(mesh.triangles.size());
}

void by_size_and_threads(benchmark::internal::Benchmark* benchmark) {
  const int all = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  benchmark->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
  benchmark->ArgNames({"triangles", "leaf", "threads"});
  for (const int triangles : {10'000, 100'000, 1'000'000}) {
    for (const int leaf : {4, 8}) {
      benchmark->Args({triangles, leaf, 1});
      if (all > 1) benchmark->Args({triangles, leaf, all});
    }
  }
}

/// Alternates between two shapes, so that every run moves all vertices.
void refit(benchmark::State& state) {
  const Mesh& mesh = mesh_of(state.range(0));
  Mesh bent = mesh;
  for (Point& p : bent.vertices) p[2] += 0.3 * std::sin(2 * p[0]);
  const auto threads = static_cast<unsigned>(state.range(2));
  Bvh bvh = Bvh::build(view_of(mesh), {.leaf_size = static_cast<std::uint32_t>(state.range(1))}).value();
  bool is_bent = false;
  for (auto _ : state) {
    is_bent = !is_bent;
    if (!bvh.refit(view_of(is_bent ? bent : mesh), {.threads = threads}).ok()) state.SkipWithError("refit failed");
  }
  if (!is_bent && !bvh.refit(view_of(bent)).ok()) state.SkipWithError("refit failed");
  state.counters["sah"] = sah_cost(bvh);
  state.counters["triangles"] = static_cast<double>(mesh.triangles.size());
}

/// Times body(mesh) on all threads.
template <class Body>
void run_on_mesh(benchmark::State& state, Body body) {
  const Mesh& mesh = mesh_of(state.range(0));
  for (auto _ : state) body(mesh);
  state.counters["triangles"] = static_cast<double>(mesh.triangles.size());
}

void parse_obj(benchmark::State& state) {
  std::string text;
  char line[100];
  for (const Point& p : mesh_of(state.range(0)).vertices) {
    text.append(line, std::snprintf(line, sizeof(line), "v %.9g %.9g %.9g\n", p[0], p[1], p[2]));
  }
  for (const Triangle& t : mesh_of(state.range(0)).triangles) {
    text.append(line, std::snprintf(line, sizeof(line), "f %u %u %u\n", t[0] + 1, t[1] + 1, t[2] + 1));
  }
  run_on_mesh(state, [&](const Mesh&) { benchmark::DoNotOptimize(parse_mesh(text, "torus.obj")); });
}

void prepare(benchmark::State& state) {
  run_on_mesh(state, [](const Mesh& mesh) { benchmark::DoNotOptimize(prepare_mesh(mesh)); });
}

const UnitTransform kUnit = {{-2, -2, -2}, 4};

void triangle_texels(benchmark::State& state) {
  const Bvh bvh = Bvh::build(view_of(mesh_of(state.range(0))), {.leaf_size = 8}).value();
  run_on_mesh(state, [&](const Mesh&) { benchmark::DoNotOptimize(make_triangle_texels(bvh, kUnit, {})); });
}

void tree_texels(benchmark::State& state) {
  const Bvh bvh = Bvh::build(view_of(mesh_of(state.range(0))), {.leaf_size = 8}).value();
  run_on_mesh(state, [&](const Mesh&) { benchmark::DoNotOptimize(make_tree_texels(bvh, kUnit)); });
}

void mesh_links(benchmark::State& state) {
  const Mesh& mesh = mesh_of(state.range(0));
  const Bvh bvh = Bvh::build(view_of(mesh), {.leaf_size = 8}).value();
  const std::vector<std::uint8_t> flags(mesh.triangles.size(), kTrustedNormal);
  const MeshView view = {mesh.vertices, mesh.triangles, flags, true};
  run_on_mesh(state, [&](const Mesh&) { benchmark::DoNotOptimize(make_mesh_links(view, bvh.order())); });
}

void by_size(benchmark::internal::Benchmark* benchmark) {
  benchmark->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime()->ArgName("triangles");
  for (const int triangles : {10'000, 100'000, 1'000'000}) benchmark->Arg(triangles);
}

BENCHMARK(build)->Apply(by_size_and_threads);
BENCHMARK(refit)->Apply(by_size_and_threads);
BENCHMARK(parse_obj)->Apply(by_size);
BENCHMARK(prepare)->Apply(by_size);
BENCHMARK(triangle_texels)->Apply(by_size);
BENCHMARK(tree_texels)->Apply(by_size);
BENCHMARK(mesh_links)->Apply(by_size);

}  // namespace

BENCHMARK_MAIN();
