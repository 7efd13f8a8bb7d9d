// A mesh on the device: runs of its leaf order, units, the tree's fallbacks.
#include "device_mesh/device_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>

#include "base/spiral.h"
#include "device/context_impl.h"
#include "device_commands/commands.h"
#include "device_commands/stop_word.h"
#include "device_commands/uploads.h"
#include "device_mesh/device_tree.h"
#include "medial_vk/scene.h"
#include "queries/scene_impl.h"
#include "queries/tree_queries.h"
#include "support/device/device_test.h"
#include "support/device/uploaded_mesh.h"
#include "support/indexed.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

Mesh rotated_torus() {
  Mesh mesh = test::make_turned_torus();
  test::translate(mesh, {7, -3, 2});
  return mesh;
}

class SceneTest : public test::DeviceTest {};

TEST_F(SceneTest, MeshesTooLargeForTheDeviceAreRefusedBeforeAnythingIsBuilt) {
  const VkPhysicalDeviceLimits& limits = Internals::of(*context_).limits;
  const std::uint64_t seen = std::max(limits.maxStorageBufferRange / 64, limits.maxTexelBufferElements / 4);
  const auto most = std::min<std::uint64_t>(seen, DeviceMesh::kMostTriangles);
  Mesh mesh = test::make_box({1, 1, 1});
  mesh.triangles.resize(most + 1, mesh.triangles[0]);
  const Result<DeviceMesh> device = test::upload_mesh(Internals::of(*context_), test::view_of(mesh));
  ASSERT_FALSE(device.ok());
  EXPECT_EQ(device.error().code, ErrorCode::kOutOfMemory);
  EXPECT_NE(device.error().message.find("the mesh has " + std::to_string(most + 1) + " triangles"), std::string::npos);
  EXPECT_NE(device.error().message.find(' ' + std::to_string(most)), std::string::npos) << device.error().message;
}

TEST_F(SceneTest, UnitBox) {
  const Mesh mesh = rotated_torus();
  const DeviceMesh device = test::upload_mesh(Internals::of(*context_), test::view_of(mesh)).value();
  double largest = 0;
  for (const Point& p : mesh.vertices) {
    const Point unit = device.to_unit(p);
    for (int k = 0; k < 3; ++k) {
      EXPECT_GE(unit[k], 0.0);
      EXPECT_LE(unit[k], 1.0);
      largest = std::max(largest, unit[k]);
    }
  }
  EXPECT_EQ(largest, 1.0);
  const Point back = device.to_input({0.25f, 0.5f, 0.75f});
  EXPECT_NEAR(device.to_unit(back)[1], 0.5, 1e-15);
}

// If a mesh has more texels than the device allows in a view, kernels read storage buffers: the same results.
TEST_F(SceneTest, StorageBuffersInPlaceOfTexels) {
  use_own_context();
  const Mesh mesh = rotated_torus();
  std::vector<Point> points;
  for (const Point& d : spiral_points(300)) points.push_back({7 + 0.8 * d[0], -3 + 0.9 * d[1], 2 + d[2]});
  Scene with_texels = test::make_scene(*context_, test::view_of(mesh)).value();
  const auto expected = with_texels.closest_points(points).value();
  const auto expected_numbers = with_texels.winding_numbers(points).value();
  Internals::of(*context_).limits.maxTexelBufferElements = 1000;
  Scene without = test::make_scene(*context_, test::view_of(mesh)).value();
  const auto found = without.closest_points(points).value();
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(found[i].triangle, expected[i].triangle);
    EXPECT_EQ(found[i].point, expected[i].point);
  }
  EXPECT_EQ(without.winding_numbers(points).value(), expected_numbers);
}

// Queries pass through memory that the host cannot use, as on a GPU: the results are the same, in the caller's memory.
TEST_F(SceneTest, CopiesPointsToTheDeviceAndBack) {
  const Mesh mesh = rotated_torus();
  std::vector<Point> points;
  for (const Point& d : spiral_points(5100)) points.push_back({7 + 0.8 * d[0], -3 + 0.9 * d[1], 2 + d[2]});
  Scene scene = test::make_scene(*context_, test::view_of(mesh)).value();
  Scene copying = test::make_scene(*context_, test::view_of(mesh)).value();
  EXPECT_EQ(Internals::of(scene).shares_memory, Internals::of(*context_).description.type == "cpu");
  Internals::of(copying).shares_memory = false;
  const auto same = [](const std::vector<ClosestPoint>& a, const std::vector<ClosestPoint>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const ClosestPoint& p, const ClosestPoint& q) {
      return p.point == q.point && p.distance == q.distance && p.triangle == q.triangle && p.feature == q.feature;
    });
  };
  std::vector<ClosestPoint> out(points.size());
  ASSERT_TRUE(copying.closest_points(points, out).ok());
  EXPECT_TRUE(same(out, scene.closest_points(points).value()));
  ASSERT_TRUE(copying.closest_points_of_groups(points, 51, out).ok());
  EXPECT_TRUE(same(out, scene.closest_points_of_groups(points, 51).value()));
  EXPECT_EQ(scene.closest_points(points, std::span(out).first(7)).error().message,
            "`out` must have an element for each of 5100 points; it has 7");
  EXPECT_EQ(scene.closest_points_of_groups(points, 51, std::span(out).first(7)).error().code, ErrorCode::kUsage);
}

// At the centre of a sphere every walk gives up, slightly off it none does.
TEST_F(SceneTest, CountsTheQueriesThatNeedAllTriangles) {
  ContextImpl& context = Internals::of(*context_);
  const Mesh mesh = test::make_sphere(1.0, 100000);
  const DeviceMesh device = test::upload_mesh(context, test::view_of(mesh)).value();
  TreeQueries queries = TreeQueries::create(context, device, 64).value();
  Arena arena(context);
  const Buffer positions = arena.create_buffer(64 * 16, MemoryKind::kDevice, "a test").value();
  const Buffer nearest = arena.create_buffer(64 * 16, MemoryKind::kDevice, "a test").value();
  const Buffer hits = arena.create_buffer(64 * 4, MemoryKind::kDevice, "a test").value();
  const auto query = [&](const Point& p) {
    const Point unit = device.to_unit(p);
    const std::vector<Texel> texels(
        64, {static_cast<float>(unit[0]), static_cast<float>(unit[1]), static_cast<float>(unit[2]), 3.4e38f});
    ASSERT_TRUE(upload(context, positions, std::as_bytes(std::span<const Texel>(texels))).ok());
    ASSERT_TRUE(run_commands(context, [&](Recorder& r) {
                  queries.closest(r, QueryCount::of(10), positions.range(), nearest.range(), hits.range());
                  return r.status();
                }).ok());
  };
  query({0.5, 0.1, 0.2});
  EXPECT_EQ(queries.read_unresolved_total().value(), 0u);
  query({0, 0, 0});
  EXPECT_EQ(queries.read_unresolved_total().value(), 10u);
  query({0, 0, 0});
  EXPECT_EQ(queries.read_unresolved_total().value(), 20u);
}

// The time that a stop saves is measured by bench/stops.cpp; here, that nothing further is written. Without a tolerance
// every walk reaches all triangles and gives up.
TEST_F(SceneTest, WindingNumbersAreLeftAloneAfterAStop) {
  ContextImpl& context = Internals::of(*context_);
  const Mesh mesh = test::make_sphere(1.0, 20000);
  const DeviceMesh device = test::upload_mesh(context, test::view_of(mesh)).value();
  StopWord stop = StopWord::create(context).value();
  TreeQueries queries = TreeQueries::create(context, device, 64, stop.range()).value();
  Arena arena(context);
  const Buffer positions = arena.create_buffer(64 * 16, MemoryKind::kDevice, "a test").value();
  const Buffer numbers = arena.create_buffer(64 * 8, MemoryKind::kDevice, "a test").value();
  const Buffer readback = arena.create_buffer(64 * 8, MemoryKind::kReadback, "a test").value();
  const std::vector<Texel> middles(64, {0.5f, 0.5f, 0.5f, 3.4e38f});
  ASSERT_TRUE(upload(context, positions, std::as_bytes(std::span<const Texel>(middles))).ok());
  const auto query = [&] {
    EXPECT_TRUE(run_commands(context, [&](Recorder& r) {
                  r.fill(numbers, 0, 64 * 8, 0);
                  r.barrier();
                  queries.winding(r, QueryCount::of(64), positions.range(), numbers.range(), 0.0f);
                  r.copy(numbers, 0, readback, 0, 64 * 8);
                  r.barrier_to_host();
                  return r.status();
                }).ok());
    std::array<float, 2> last;  // the number, and the bound of its error
    std::memcpy(last.data(), static_cast<const std::byte*>(readback.mapped) + 63 * 8, sizeof(last));
    return last[0];
  };
  EXPECT_NEAR(query(), 1.0f, 1e-4f);
  EXPECT_EQ(queries.read_unresolved_total().value(), 64u);
  stop.raise();
  EXPECT_EQ(query(), 0.0f);
  EXPECT_EQ(queries.read_unresolved_total().value(), 64u);
}

// One invocation adds up all samples of a sphere; lavapipe would end its loop silently after 65,535 of them.
TEST_F(SceneTest, TakesAsManyFluxSamplesAsItCanAddUp) {
  const Mesh mesh = test::make_box({1.0, 0.7, 0.45});
  Scene scene = test::make_scene(*context_, test::view_of(mesh)).value();
  const std::vector<Ball> spheres = {{{0.5, 0.35, 0.2}, 0.1}};
  const double expected = scene.fluxes(spheres, 4000).value()[0].flux;
  EXPECT_NEAR(scene.fluxes(spheres, 60000).value()[0].flux, expected, 1e-3);
  EXPECT_EQ(scene.fluxes(spheres, 60001).error().code, ErrorCode::kUsage);
}

TEST(Spiral, SpreadsPointsEvenly) {
  for (const std::uint32_t count : {1u, 2u, 50u, 400u}) {
    const std::vector<Point> points = spiral_points(count);
    ASSERT_EQ(points.size(), count);
    Point sum = {0, 0, 0};
    for (const Point& p : points) {
      EXPECT_NEAR(p[0] * p[0] + p[1] * p[1] + p[2] * p[2], 1.0, 1e-14);
      for (int k = 0; k < 3; ++k) sum[k] += p[k] / count;
    }
    if (count >= 50) {
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(sum[k], 0.0, 0.02);
    }
  }
}

}  // namespace
}  // namespace medial_vk
