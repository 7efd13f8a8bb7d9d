// Many contexts in one process, from many threads: nothing is shared, and results are those of one thread. The
// ThreadSanitizer runs these tests (scripts/test --tsan).
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "medial_vk/context.h"
#include "medial_vk/extraction.h"
#include "medial_vk/scene.h"
#include "recording_host.h"
#include "support/device/device.h"
#include "support/indexed.h"
#include "support/recorded_job.h"

namespace medial_vk::test {
namespace {

constexpr std::size_t kThreads = 4;

/// A box in a turned position; borrowed arrays with their owner.
struct Solid {
  std::vector<Point> vertices;
  std::vector<Triangle> triangles;
  std::vector<std::uint8_t> flags;
  MeshView view() const { return {vertices, triangles, flags, true}; }
};

Solid solid(std::size_t i) {
  const Point size = {1.0, 0.6 + 0.1 * static_cast<double>(i), 0.45};
  Solid box;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const double x = (corner & 1u) != 0 ? size[0] : 0, y = (corner & 2u) != 0 ? size[1] : 0;
    box.vertices.push_back({0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y, (corner & 4u) != 0 ? size[2] : 0});
  }
  box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  box.flags.assign(box.triangles.size(), kTrustedNormal);
  return box;
}

/// A context that does not use the user's pipeline cache.
Context make_context() {
  Result<Context> context = Context::create({.device = "", .validation = false, .cache_folder = "/dev/null"});
  if (!context.ok()) throw std::runtime_error(context.error().message);
  return std::move(context).value();
}

ExtractionOptions small_job() {
  ExtractionOptions options;
  options.resolution = 8;
  options.extra_levels = 1;
  options.memory_budget = 32u << 20;
  return options;
}

template <class T>
void append_bytes(std::string& out, const T& value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

/// Spheres and closest points as bytes; otherwise the error.
std::string work(Context& context, const Solid& mesh) {
  std::string out;
  const auto extraction = test::extract_spheres(context, mesh.view(), small_job());
  if (!extraction.ok()) return extraction.error().message;
  for (const MedialSphere& s : extraction.value().spheres) {
    append_bytes(out, s.centre);
    append_bytes(out, s.radius);
  }
  Result<Scene> scene = test::make_scene(context, mesh.view());
  if (!scene.ok()) return scene.error().message;
  std::vector<Point> points;
  for (int i = 0; i < 5000; ++i) points.push_back({std::sin(0.37 * i), std::cos(0.61 * i), std::sin(0.83 * i)});
  for (const std::size_t count : {std::size_t{100}, points.size()}) {
    const auto closest = scene.value().closest_points(std::span(points).first(count));
    if (!closest.ok()) return closest.error().message;
    for (const ClosestPoint& c : closest.value()) append_bytes(out, c.distance);
  }
  return out;
}

class Threads : public testing::Test {
 protected:
  void SetUp() override { MEDIAL_VK_SKIP_WITHOUT_DEVICE(); }
  static std::vector<std::string> one_after_the_other(const std::vector<Solid>& meshes) {
    Context context = make_context();
    std::vector<std::string> out;
    for (const Solid& mesh : meshes) out.push_back(work(context, mesh));
    return out;
  }
  static std::vector<Solid> solids() {
    std::vector<Solid> out;
    for (std::size_t i = 0; i < kThreads; ++i) out.push_back(solid(i));
    return out;
  }
};

TEST_F(Threads, WithAContextEachAnswerLikeOne) {
  const std::vector<Solid> meshes = solids();
  const std::vector<std::string> expected = one_after_the_other(meshes);
  std::vector<std::string> found(kThreads);
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < kThreads; ++i) {
      threads.emplace_back([&, i] {
        for (int round = 0; round < 2; ++round) {  // contexts are created and destroyed while others are at work
          Context context = make_context();
          found[i] = work(context, meshes[i]);
        }
      });
    }
  }
  for (std::size_t i = 0; i < kThreads; ++i) {
    EXPECT_GT(expected[i].size(), 1000u) << expected[i];
    EXPECT_TRUE(found[i] == expected[i]) << "thread " << i;
  }
}

// Created by one thread, used by others in turn, destroyed by another.
TEST_F(Threads, PassAContextOn) {
  const std::vector<Solid> meshes = solids();
  const std::vector<std::string> expected = one_after_the_other(meshes);
  std::optional<Context> context;
  std::thread([&] { context.emplace(make_context()); }).join();
  for (std::size_t i = 0; i < kThreads; ++i) {
    std::string found;
    std::thread([&] { found = work(*context, meshes[i]); }).join();
    EXPECT_TRUE(found == expected[i]) << "thread " << i;
  }
  std::thread([&] { context.reset(); }).join();
}

TEST_F(Threads, ListAndOpenDevicesAtOnce) {
  std::vector<std::jthread> threads;
  for (std::size_t i = 0; i < kThreads; ++i) {
    threads.emplace_back([i] {
      for (int round = 0; round < 5; ++round) {
        if (i % 2 == 0) {
          EXPECT_TRUE(Context::list_devices().ok());
        } else {
          const Context context = make_context();
          EXPECT_TRUE(context.device().usable);
        }
      }
    });
  }
}

/// Counts and results of jobs on a device of the thread's own, frame after frame, with the mesh moved in between.
std::string record_and_move(const Solid& mesh) {
  RecordingHost host(make_context());
  Result<Context> context = Context::adopt(host.lend());
  if (!context.ok()) return context.error().message;
  Result<IndexedMesh> indexed = IndexedMesh::build(mesh.view());
  if (!indexed.ok()) return indexed.error().message;
  Result<ExtractionJob> job = ExtractionJob::create(context.value(), indexed.value(), small_job());
  if (!job.ok()) return job.error().message;
  std::string out;
  Solid moved = mesh;
  for (int frame = 0; frame < 3; ++frame) {
    for (Point& p : moved.vertices) p[0] *= 1.1;
    if (const Status status = move(job.value(), indexed.value(), moved.view()); !status.ok())
      return status.error().message;
    if (const Status status = host.run(job.value()); !status.ok()) return status.error().message;
    const RecordedCounts counts = job.value().counts();
    if (counts.complete != 1 || counts.spheres == 0) return "a frame without spheres";
    append_bytes(out, counts);
    append_bytes(out, job.value().placement().scale);
  }
  return out;
}

// As in a program with several windows, each thread has a device, a context that has adopted it, and a job.
TEST_F(Threads, RecordJobsAtOnce) {
  const std::vector<Solid> meshes = solids();
  std::vector<std::string> expected, found(kThreads);
  for (const Solid& mesh : meshes) expected.push_back(record_and_move(mesh));
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < kThreads; ++i) {
      threads.emplace_back([&, i] { found[i] = record_and_move(meshes[i]); });
    }
  }
  for (std::size_t i = 0; i < kThreads; ++i) {
    EXPECT_EQ(expected[i].size(), 3 * (sizeof(RecordedCounts) + sizeof(double))) << expected[i];
    EXPECT_TRUE(found[i] == expected[i]) << "thread " << i;
  }
}

// One device, one context, one job: created by one thread, with each frame recorded by another.
TEST_F(Threads, PassAJobOn) {
  const Solid mesh = solid(1);
  RecordingHost host(make_context());
  Context context = Context::adopt(host.lend()).value();
  IndexedMesh indexed = IndexedMesh::build(mesh.view()).value();
  ExtractionJob job = ExtractionJob::create(context, indexed, small_job()).value();
  for (std::size_t i = 0; i < kThreads; ++i) {
    std::thread([&] {
      EXPECT_TRUE(move(job, indexed, mesh.view()).ok());
      EXPECT_TRUE(host.run(job).ok());
      EXPECT_EQ(job.counts().complete, 1u);
      EXPECT_GT(job.counts().spheres, 0u);
    }).join();
  }
}

}  // namespace
}  // namespace medial_vk::test
