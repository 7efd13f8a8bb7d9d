// How often the costly steps run: indices (Bvh::build()), uploads of a mesh, threads of the host. (The refined copy of
// the tree that a fit makes per Solid searches for no splits of large nodes and is not counted. A Solid of an open mesh
// also builds a tree over the triangles that close it, which are another mesh.) The linker sends
// calls of these functions through the counters below (tests/CMakeLists.txt, --wrap).
#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#include "device_mesh/device_mesh.h"
#include "medial_vk/extraction_job.h"
#include "medial_vk/medial_vk.h"
#include "support/device/device.h"
#include "support/indexed.h"
#include "support/solids/solids.h"

namespace {

std::atomic<int> trees = 0, uploads = 0, threads = 0;

}  // namespace

// The names that --wrap gives: Bvh::build(), DeviceMesh::create() and the start of a std::thread.
extern "C" {
medial_vk::Result<medial_vk::Bvh> __real__ZN9medial_vk3Bvh5buildERKNS_8MeshViewERKNS_10BvhOptionsE(
    const medial_vk::MeshView& mesh, const medial_vk::BvhOptions& options);
medial_vk::Result<medial_vk::Bvh> __wrap__ZN9medial_vk3Bvh5buildERKNS_8MeshViewERKNS_10BvhOptionsE(
    const medial_vk::MeshView& mesh, const medial_vk::BvhOptions& options) {
  ++trees;
  return __real__ZN9medial_vk3Bvh5buildERKNS_8MeshViewERKNS_10BvhOptionsE(mesh, options);
}

medial_vk::Result<medial_vk::DeviceMesh> __real__ZN9medial_vk10DeviceMesh6createERNS_7Context4ImplERKNS_11IndexedMeshEb(
    medial_vk::ContextImpl& context, const medial_vk::IndexedMesh& mesh, bool with_links);
medial_vk::Result<medial_vk::DeviceMesh> __wrap__ZN9medial_vk10DeviceMesh6createERNS_7Context4ImplERKNS_11IndexedMeshEb(
    medial_vk::ContextImpl& context, const medial_vk::IndexedMesh& mesh, bool with_links) {
  ++uploads;
  return __real__ZN9medial_vk10DeviceMesh6createERNS_7Context4ImplERKNS_11IndexedMeshEb(context, mesh, with_links);
}

void __real__ZNSt6thread15_M_start_threadESt10unique_ptrINS_6_StateESt14default_deleteIS1_EEPFvvE(
    std::thread* started, std::unique_ptr<std::thread::_State> state, void (*depend)());
void __wrap__ZNSt6thread15_M_start_threadESt10unique_ptrINS_6_StateESt14default_deleteIS1_EEPFvvE(
    std::thread* started, std::unique_ptr<std::thread::_State> state, void (*depend)()) {
  ++threads;
  __real__ZNSt6thread15_M_start_threadESt10unique_ptrINS_6_StateESt14default_deleteIS1_EEPFvvE(
      started, std::move(state), depend);
}
}

namespace medial_vk {
namespace {

/// More triangles than a block of any loop, so that every loop has work for several threads.
Mesh large_mesh() { return test::make_torus(1.0, 0.4, 260, 140, 0.5); }

std::vector<Part> two_boxes(unsigned threads) {
  std::vector<Part> parts(2);
  parts[0].link = parts[0].name = "upper";
  parts[0].mesh = test::indexed(prepare_mesh(test::make_box({1, 0.7, 0.45}), {.threads = threads}).value(), threads);
  parts[1].link = parts[1].name = "lower";
  parts[1].mesh = test::indexed(prepare_mesh(test::make_box({0.6, 0.5, 0.3}), {.threads = threads}).value(), threads);
  parts[1].pose = make_pose({0, 0, -1}, {0.1, 0, 0});
  return parts;
}

class WorkCounts : public testing::Test {
 protected:
  void SetUp() override {
    MEDIAL_VK_SKIP_WITHOUT_DEVICE();
    ContextOptions options;
    options.threads = context_threads();
    options.cache_folder = "/dev/null";
    context_.emplace(Context::create(options).value());
    trees = uploads = threads = 0;
  }

  virtual unsigned context_threads() const { return 1; }

  std::optional<Context> context_;
};

TEST_F(WorkCounts, AnAnalysisBuildsOneTreeAndUploadsOnce) {
  const IndexedMesh mesh = IndexedMesh::build(prepare_mesh(large_mesh()).value()).value();
  AnalysisOptions options;
  options.extraction.resolution = 40;
  options.sheets.emplace();
  options.volumes = options.medial_mesh = true;
  ASSERT_TRUE(analyse(mesh, options, *context_).ok());
  EXPECT_EQ(trees, 1);
  EXPECT_EQ(uploads, 1);
}

// The method best extracts medial points on grid after grid, the method source searches for a grid.
TEST_F(WorkCounts, AFitOfSpheresBuildsOneTreeAndUploadsOnce) {
  for (const SphereMethod method : {SphereMethod::kBest, SphereMethod::kSource}) {
    for (const SphereContract contract : {SphereContract::kInside, SphereContract::kCover}) {
      trees = uploads = 0;
      int extractions = 0;
      const IndexedMesh mesh = IndexedMesh::build(prepare_mesh(test::make_box({1, 0.7, 0.45})).value()).value();
      SphereFitOptions options;
      options.method = method;
      options.contract = contract;
      options.count = 80;
      const Extractor on_device = device_extractor(*context_);
      const Extractor counted = [&](const auto&... arguments) {
        ++extractions;
        return on_device(arguments...);
      };
      ASSERT_TRUE(fit_spheres(mesh, options, counted).ok());
      EXPECT_GT(extractions, 1);
      EXPECT_EQ(trees, 1);
      EXPECT_EQ(uploads, 1);
    }
  }
}

// Balls that are distributed by need take two passes over the parts; the method source searches for other grids in
// each.
TEST_F(WorkCounts, AFitOfPartsBuildsOneTreeAndUploadsOncePerPart) {
  for (const SphereMethod method : {SphereMethod::kBest, SphereMethod::kSource}) {
    for (const SphereContract contract : {SphereContract::kInside, SphereContract::kCover}) {
      trees = uploads = 0;
      const std::vector<Part> parts = two_boxes(1);
      PartFitOptions options;
      options.spheres.method = method;
      options.spheres.contract = contract;
      options.total = 40;
      ASSERT_TRUE(fit_parts(parts, options, *context_).ok());
      EXPECT_EQ(trees, 2);
      EXPECT_EQ(uploads, 2);
    }
  }
}

// Vertices that move refit the tree.
TEST_F(WorkCounts, AMeshThatMovesBuildsNoTree) {
  IndexedMesh mesh = IndexedMesh::build(prepare_mesh(large_mesh()).value()).value();
  Scene scene = Scene::create(*context_, mesh).value();
  std::vector<Point> vertices = mesh.prepared().mesh.vertices;
  for (Point& p : vertices) p[0] *= 1.5;
  ASSERT_TRUE(mesh.move_vertices(vertices).ok());
  ASSERT_TRUE(scene.update(mesh).ok());
  EXPECT_EQ(trees, 1);
  EXPECT_EQ(uploads, 1);
}

TEST_F(WorkCounts, OneThreadIsOneThread) {
  const IndexedMesh mesh =
      IndexedMesh::build(prepare_mesh(large_mesh(), {.threads = 1}).value(), {.threads = 1}).value();
  AnalysisOptions options;
  options.extraction.resolution = 60;
  options.sheets.emplace();
  options.volumes = options.removal_orders = options.medial_mesh = true;
  options.threads = 1;
  ASSERT_TRUE(analyse(mesh, options, *context_).ok());
  IndexedMesh moved = mesh;
  Scene scene = Scene::create(*context_, moved).value();
  ASSERT_TRUE(moved.move_vertices(mesh.prepared().mesh.vertices, {.threads = 1}).ok());
  ASSERT_TRUE(scene.update(moved).ok());
  SphereFitOptions spheres;
  spheres.count = 20;
  spheres.resolution = 16;
  spheres.threads = 1;
  ASSERT_TRUE(fit_spheres(mesh, spheres, *context_).ok());
  PartFitOptions of_parts;
  of_parts.spheres.resolution = 16;
  of_parts.total = 20;
  of_parts.threads = 1;
  ASSERT_TRUE(fit_parts(two_boxes(1), of_parts, *context_).ok());
  EXPECT_EQ(threads, 0);
}

class ThreadCounts : public WorkCounts {
  unsigned context_threads() const override { return 4; }
};

// The number of a call goes before that of its context, also for programs and for arrays of the device.
TEST_F(ThreadCounts, OneThreadOfACallIsOneThread) {
  const IndexedMesh mesh =
      IndexedMesh::build(prepare_mesh(large_mesh(), {.threads = 1}).value(), {.threads = 1}).value();
  AnalysisOptions options;
  options.extraction.resolution = 20;
  options.threads = 1;
  ASSERT_TRUE(analyse(mesh, options, *context_).ok());
  EXPECT_EQ(threads, 0);
  Scene scene = Scene::create(*context_, mesh).value();  // has no number of its own
  EXPECT_GT(threads, 0);
  threads = 0;
  ExtractionOptions alone = options.extraction;
  alone.threads = 1;
  ASSERT_TRUE(extract_medial_spheres(scene, alone).ok());
  ASSERT_TRUE(ExtractionJob::create(*context_, mesh, alone, {}).ok());
  EXPECT_EQ(threads, 0);
}

// Without this, the tests above could not fail.
TEST_F(WorkCounts, MoreThreadsAreStarted) {
  ASSERT_TRUE(prepare_mesh(large_mesh(), {.threads = 4}).ok());
  EXPECT_GT(threads, 0);
}

}  // namespace
}  // namespace medial_vk
