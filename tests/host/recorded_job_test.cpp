// A host with a device of its own, under the validation layer if it is installed: its recorded commands give the
// spheres of extract_medial_spheres(), mesh after mesh, and leave its device unchanged.
#include <gtest/gtest.h>
#include <medial_vk/extraction_job.h>
#include <medial_vk/scene.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <tuple>
#include <vector>

#include "deforming_torus.h"
#include "recording_test.h"
#include "support/indexed.h"
#include "support/recorded_job.h"

namespace medial_vk::test {
namespace {

using Voxel = std::array<std::uint32_t, 3>;

ExtractionOptions options_for(std::uint32_t resolution) {
  ExtractionOptions p;
  p.resolution = resolution;
  p.memory_budget = 256u << 20;
  return p;
}

/// A mesh with few triangles that is not a torus: its box has another shape.
class Box {
 public:
  explicit Box(double height)
      : vertices_{{0, 0, 0},      {3, 0, 0},      {3, 2, 0},      {0, 2, 0},
                  {0, 0, height}, {3, 0, height}, {3, 2, height}, {0, 2, height}} {}
  MeshView view() const { return {vertices_, triangles_, flags_, true}; }

 private:
  std::vector<Point> vertices_;
  std::vector<Triangle> triangles_ = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                      {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  std::vector<std::uint8_t> flags_ = std::vector<std::uint8_t>(12, kTrustedNormal);
};

/// The results of a recorded sequence, copied to the host behind it in the same command buffer.
struct Recorded {
  RecordedCounts counts;
  std::vector<RecordedSphere> spheres;  // by voxel
};

class RecordedJob : public RecordingTest {
 protected:
  /// Records, submits and waits, and compares the counts that the job reports.
  Recorded run(ExtractionJob& job) {
    const VkCommandBuffer commands = begin();
    const Status status = job.record(commands);
    EXPECT_TRUE(status.ok()) << status.error().message;
    const JobBuffers buffers = job.buffers();
    HostBuffer counts = copy_of(commands, buffers.counts, sizeof(RecordedCounts));
    HostBuffer spheres = copy_of(commands, buffers.spheres, buffers.sphere_bytes);
    end_and_submit(commands);
    EXPECT_EQ(vkQueueWaitIdle(vulkan_->queue), VK_SUCCESS);
    Recorded out;
    std::memcpy(&out.counts, counts.mapped, sizeof(out.counts));
    const RecordedCounts reported = job.counts();
    EXPECT_EQ(std::memcmp(&reported, &out.counts, sizeof(reported)), 0);
    const auto* first = static_cast<const RecordedSphere*>(spheres.mapped);
    out.spheres.assign(first, first + out.counts.spheres);
    std::ranges::sort(out.spheres, {},
                      [](const RecordedSphere& s) { return std::tuple(s.voxel[2], s.voxel[1], s.voxel[0]); });
    vulkan_->destroy(counts);
    vulkan_->destroy(spheres);
    return out;
  }

  /// The same spheres as those of a separate extraction, to the rounding of the change of units.
  void expect_same(Context& context, const MeshView& mesh, const ExtractionOptions& options, const Recorded& recorded,
                   const Placement& placement) {
    const Result<Extraction> direct = test::extract_spheres(context, mesh, options);
    ASSERT_TRUE(direct.ok()) << direct.error().message;
    EXPECT_EQ(recorded.counts.complete, 1u);
    EXPECT_EQ(recorded.counts.undecided, direct.value().undecided.size());
    ASSERT_EQ(recorded.spheres.size(), direct.value().spheres.size());
    ASSERT_GT(recorded.spheres.size(), 0u);
    for (std::size_t i = 0; i < recorded.spheres.size(); ++i) {
      const RecordedSphere& r = recorded.spheres[i];
      const MedialSphere& s = direct.value().spheres[i];
      EXPECT_EQ((Voxel{r.voxel[0], r.voxel[1], r.voxel[2]}), s.voxel);
      // One product and one sum in double, of the same floats.
      const double unit = 1e-15 * (placement.scale + std::abs(placement.origin[0]));
      EXPECT_NEAR(placement.origin[0] + placement.scale * double{r.centre[0]}, s.centre[0], unit);
      EXPECT_NEAR(placement.scale * double{r.radius}, s.radius, unit);
      EXPECT_EQ(r.object_angle, s.object_angle);
      EXPECT_EQ(r.flux, s.flux);
      EXPECT_EQ(r.spoke_b[2], s.spoke_b[2]);
    }
  }

  void expect_equal(const Recorded& a, const Recorded& b) {
    ASSERT_EQ(a.spheres.size(), b.spheres.size());
    // The slot, which is no part of the result, depends on the order of the device's threads.
    for (std::size_t i = 0; i < a.spheres.size(); ++i)
      EXPECT_EQ(std::memcmp(&a.spheres[i], &b.spheres[i], offsetof(RecordedSphere, reserved)), 0) << "sphere " << i;
  }

  template <class Meshes>
  void expect_followed(const Meshes& meshes, const ExtractionOptions& options);
};

TEST_F(RecordedJob, FindsTheSpheresOfADirectExtraction) {
  Context context = adopt();
  const DeformingTorus torus(24, 48);
  const ExtractionOptions options = options_for(48);
  auto job = test::make_job(context, torus.view(), options, {1, 6});
  ASSERT_TRUE(job.ok()) << job.error().message;
  const Recorded recorded = run(job.value());
  EXPECT_EQ(recorded.counts.vertices, 6u);
  EXPECT_EQ(recorded.counts.first_vertex, 0u);
  EXPECT_EQ(recorded.counts.first_instance, 0u);
  expect_same(context, torus.view(), options, recorded, job.value().placement());
}

/// Centres inside and radii that are distances, as measured by a scene of the mesh, which has a tree of its own: the
/// error of both is at most the bound of the device's rounding, 2e-6 of the longest side.
void expect_medial(Context& context, const MeshView& mesh, const Recorded& recorded, const Placement& placement) {
  EXPECT_EQ(recorded.counts.complete, 1u);
  ASSERT_GT(recorded.spheres.size(), 100u);
  Result<Scene> scene = test::make_scene(context, mesh);
  ASSERT_TRUE(scene.ok()) << scene.error().message;
  std::vector<Point> centres;
  for (const RecordedSphere& s : recorded.spheres) {
    Point& p = centres.emplace_back();
    for (int k = 0; k < 3; ++k) p[k] = placement.origin[k] + placement.scale * double{s.centre[k]};
  }
  const auto nearest = scene.value().closest_points(centres);
  const auto winding = scene.value().winding_numbers(centres);
  ASSERT_TRUE(nearest.ok() && winding.ok());
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const double radius = placement.scale * double{recorded.spheres[i].radius};
    EXPECT_NEAR(radius, nearest.value()[i].distance, 2 * 2e-6 * placement.scale);
    EXPECT_GT(winding.value()[i], 0.5);
  }
}

/// Earlier recordings make no difference: the last mesh of a sequence gives the same results as by itself. (A mesh that
/// was moved has the tree of the previous one, so its spheres are not those of a new one to the last bit.)
template <class Meshes>
void RecordedJob::expect_followed(const Meshes& meshes, const ExtractionOptions& options) {
  Context context = adopt();
  const IndexedMesh first = test::indexed(meshes.front().view());
  const auto create = [&] { return ExtractionJob::create(context, first, options).value(); };
  IndexedMesh indexed = first;
  ExtractionJob job = create();
  for (const auto& mesh : meshes) {
    const Status moved = test::move(job, indexed, mesh.view());
    ASSERT_TRUE(moved.ok()) << moved.error().message;
    const Recorded recorded = run(job);
    expect_medial(context, mesh.view(), recorded, job.placement());
    ExtractionJob alone = create();
    IndexedMesh own = first;
    ASSERT_TRUE(test::move(alone, own, mesh.view()).ok());
    expect_equal(recorded, run(alone));
  }
  // No move is recorded, so the mesh is unchanged.
  const Recorded last = run(job);
  expect_medial(context, meshes.back().view(), last, job.placement());
}

TEST_F(RecordedJob, FollowsAMeshThatMoves) {
  std::vector<DeformingTorus> meshes;
  for (const double phase : {0.2, 0.6, 0.6, 0.9}) meshes.emplace_back(24, 48).deform(phase);
  expect_followed(meshes, options_for(40));
}

TEST_F(RecordedJob, FollowsABoxOfAnotherShape) {
  std::vector<Box> meshes;
  for (const double height : {0.3, 1.0, 5.0, 0.5}) meshes.emplace_back(height);
  expect_followed(meshes, options_for(30));
}

TEST_F(RecordedJob, TwoFramesInFlightHaveTheirOwnMeshes) {
  Context context = adopt();
  const ExtractionOptions options = options_for(30);
  IndexedMesh indexed = test::indexed(Box(1).view());
  auto job = ExtractionJob::create(context, indexed, options, {2, 4});
  ASSERT_TRUE(job.ok()) << job.error().message;
  std::array<RecordedCounts, 2> expected;
  const std::array<double, 2> heights = {0.5, 2.0};
  for (int i = 0; i < 2; ++i) {
    const auto direct = test::extract_spheres(context, Box(heights[i]).view(), options);
    ASSERT_TRUE(direct.ok());
    expected[i].spheres = static_cast<std::uint32_t>(direct.value().spheres.size());
  }
  ASSERT_NE(expected[0].spheres, expected[1].spheres);
  for (const double height : heights) {
    ASSERT_TRUE(test::move(job.value(), indexed, Box(height).view()).ok());
    const VkCommandBuffer commands = begin();
    ASSERT_TRUE(job.value().record(commands).ok());
    end_and_submit(commands);
  }
  ASSERT_EQ(vkQueueWaitIdle(vulkan_->queue), VK_SUCCESS);
  EXPECT_EQ(job.value().counts().spheres, expected[0].spheres);  // of the older sequence
}

TEST_F(RecordedJob, SaysThatItsMemoryIsTooSmall) {
  Context context = adopt();
  ExtractionOptions options = options_for(160);
  options.memory_budget = 8u << 20;
  auto job = test::make_job(context, Box(1).view(), options);
  ASSERT_TRUE(job.ok()) << job.error().message;
  const Recorded recorded = run(job.value());
  EXPECT_EQ(recorded.counts.complete, 0u);
  EXPECT_EQ(recorded.counts.spheres, 0u);
}

// Lists exceed one round: the sequence reports that, and the next one has more rounds.
TEST_F(RecordedJob, TakesMoreRoundsForLongerLists) {
  Context context = adopt();
  const DeformingTorus torus(200, 300);
  const ExtractionOptions options = options_for(2);  // every voxel meets nearly all 120,000 triangles
  auto job = test::make_job(context, torus.view(), options);
  ASSERT_TRUE(job.ok()) << job.error().message;
  Recorded recorded = run(job.value());
  EXPECT_EQ(recorded.counts.complete, 0u);
  for (int tries = 0; tries < 3 && recorded.counts.complete == 0; ++tries) recorded = run(job.value());
  expect_same(context, torus.view(), options, recorded, job.value().placement());
}

TEST_F(RecordedJob, RefusesWhatCannotBeRecorded) {
  Context context = adopt();
  const Box box(1);
  ExtractionOptions options = options_for(20);
  options.mode = Mode::kThesis;
  EXPECT_EQ(test::make_job(context, box.view(), options).error().code, ErrorCode::kUsage);
  options.mode = Mode::kCertified;
  EXPECT_EQ(test::make_job(context, box.view(), options, {0, 4}).error().code, ErrorCode::kUsage);
  IndexedMesh indexed = test::indexed(box.view());
  auto job = ExtractionJob::create(context, indexed, options);
  ASSERT_TRUE(job.ok());
  // Flat in all directions.
  std::vector<Point> together(8, Point{1, 1, 1});
  MeshView collapsed = box.view();
  collapsed.vertices = together;
  EXPECT_EQ(test::move(job.value(), indexed, collapsed).error().code, ErrorCode::kInvalidMesh);
  EXPECT_EQ(job.value().record(begin()).error().code, ErrorCode::kInvalidMesh);
  ASSERT_TRUE(test::move(job.value(), indexed, box.view()).ok());
  EXPECT_EQ(test::move(job.value(), indexed, box.view()).error().code, ErrorCode::kUsage);
  const Recorded recorded = run(job.value());
  expect_same(context, box.view(), options, recorded, job.value().placement());
}

TEST_F(RecordedJob, TheDeviceOutlivesItsContexts) {
  const Box box(1);
  for (int i = 0; i < 3; ++i) {
    Context context = adopt();
    auto job = test::make_job(context, box.view(), options_for(20));
    ASSERT_TRUE(job.ok());
    EXPECT_EQ(run(job.value()).counts.complete, 1u);
    // And one of its own beside it.
    Result<Context> own = Context::create({.device = "", .validation = false, .cache_folder = "/dev/null"});
    ASSERT_TRUE(own.ok());
    EXPECT_TRUE(test::extract_spheres(own.value(), box.view(), options_for(20)).ok());
  }
}

TEST_F(RecordedJob, RefusesAnUnsuitableHostWithTheReason) {
  HostDevice host = lend(*vulkan_);
  EXPECT_TRUE(check_device(host).ok());
  host.queue_family = 99;
  EXPECT_NE(check_device(host).error().message.find("its queue family 99 does not compute"), std::string::npos);
  host = lend(*vulkan_);
  host.api_version = VK_API_VERSION_1_1;
  EXPECT_NE(Context::adopt(host).error().message.find("older than Vulkan 1.2"), std::string::npos);
  host = lend(*vulkan_);
  host.device = VK_NULL_HANDLE;
  EXPECT_EQ(Context::adopt(host).error().code, ErrorCode::kNoDevice);
  host = {};
  EXPECT_EQ(check_device(host).error().code, ErrorCode::kNoDevice);
}

}  // namespace
}  // namespace medial_vk::test
