// A mesh on the device that follows moving vertices: the same results as from a newly created mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "base/spiral.h"
#include "device/context_impl.h"
#include "device_commands/commands.h"
#include "device_commands/uploads.h"
#include "device_mesh/device_mesh.h"
#include "device_mesh/device_tree.h"
#include "medial_vk/scene.h"
#include "queries/tree_queries.h"
#include "support/device/device_test.h"
#include "support/device/uploaded_mesh.h"
#include "support/indexed.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

class SceneUpdate : public test::DeviceTest {
 protected:
  DeviceMesh upload(const IndexedMesh& mesh) {
    DeviceMesh device = DeviceMesh::create(Internals::of(*context_), mesh, false).value();
    EXPECT_TRUE(device.finish_uploads().ok());
    return device;
  }

  struct Nearest {
    Texel point;
    std::uint32_t triangle, feature;
    bool operator==(const Nearest&) const = default;
  };

  /// Answers of `queries`, created for `mesh` before or after it was updated; ties go to the smallest index.
  std::vector<Nearest> closest(const TreeQueries& queries, const DeviceMesh& mesh, const std::vector<Point>& points) {
    ContextImpl& context = Internals::of(*context_);
    const auto count = static_cast<std::uint32_t>(points.size());
    std::vector<Texel> texels;
    for (const Point& p : points) {
      const Point u = mesh.to_unit(p);
      texels.push_back({static_cast<float>(u[0]), static_cast<float>(u[1]), static_cast<float>(u[2]), 3.4e38f});
    }
    Arena arena(context);
    const Buffer positions = arena.create_buffer(count * 16, MemoryKind::kDevice, "a test").value();
    const Buffer nearest = arena.create_buffer(count * 16, MemoryKind::kDevice, "a test").value();
    const Buffer hits = arena.create_buffer(count * 4, MemoryKind::kDevice, "a test").value();
    const Buffer readback = arena.create_buffer(count * 20, MemoryKind::kReadback, "a test").value();
    EXPECT_TRUE(medial_vk::upload(context, positions, std::as_bytes(std::span<const Texel>(texels))).ok());
    EXPECT_TRUE(run_commands(context, [&](Recorder& r) {
                  queries.closest(r, QueryCount::of(count), positions.range(), nearest.range(), hits.range(),
                                  TreeQueries::Ties::kIndex);
                  r.copy(nearest, 0, readback, 0, count * 16);
                  r.copy(hits, 0, readback, count * 16, count * 4);
                  r.barrier_to_host();
                  return r.status();
                }).ok());
    std::vector<Nearest> out(count);
    const auto* bytes = static_cast<const std::byte*>(readback.mapped);
    for (std::uint32_t i = 0; i < count; ++i) {
      std::uint32_t hit = 0;
      std::memcpy(&out[i].point, bytes + 16 * i, 16);
      std::memcpy(&hit, bytes + 16 * count + 4 * i, 4);
      out[i].triangle = mesh.order[hit & 0xffffffu];
      out[i].feature = hit >> 24;
    }
    return out;
  }
};

std::vector<Point> points_around(const Point& centre) {
  std::vector<Point> points;
  for (const double radius : {0.3, 1.0, 2.5}) {
    for (const Point& d : spiral_points(200)) {
      points.push_back({centre[0] + radius * d[0], centre[1] + radius * d[1], centre[2] + radius * d[2]});
    }
  }
  return points;
}

TEST_F(SceneUpdate, AnswersAsIfCreatedAnew) {
  use_own_context();
  ContextImpl& context = Internals::of(*context_);
  const Mesh before = test::make_turned_torus(), after = test::bent(before);
  for (const bool texels : {true, false}) {
    SCOPED_TRACE(texels);
    if (!texels) context.limits.maxTexelBufferElements = 1000;
    IndexedMesh mesh = test::indexed(test::view_of(before));
    DeviceMesh moved = upload(mesh);
    const TreeQueries queries = TreeQueries::create(context, moved, 1024).value();
    const auto first = closest(queries, moved, points_around({0, 0, 0}));
    ASSERT_TRUE(mesh.move_vertices(after.vertices).ok());
    ASSERT_TRUE(moved.update(mesh).ok());

    const DeviceMesh fresh = test::upload_mesh(context, test::view_of(after)).value();
    const TreeQueries fresh_queries = TreeQueries::create(context, fresh, 1024).value();
    EXPECT_EQ(moved.lower, fresh.lower);
    EXPECT_EQ(moved.upper, fresh.upper);
    EXPECT_EQ(moved.longest, fresh.longest);
    const std::vector<Point> points = points_around({7, 0, 0});
    EXPECT_TRUE(closest(queries, moved, points) == closest(fresh_queries, fresh, points));

    ASSERT_TRUE(mesh.move_vertices(before.vertices).ok());
    ASSERT_TRUE(moved.update(mesh).ok());
    EXPECT_TRUE(closest(queries, moved, points_around({0, 0, 0})) == first);
  }
}

TEST_F(SceneUpdate, RefusesWhatDoesNotFit) {
  ContextImpl& context = Internals::of(*context_);
  const Mesh mesh = test::make_turned_torus();
  IndexedMesh indexed = test::indexed(test::view_of(mesh));
  DeviceMesh device = upload(indexed);
  const TreeQueries queries = TreeQueries::create(context, device, 1024).value();
  const std::vector<Point> points = points_around({0, 0, 0});
  const auto before = closest(queries, device, points);
  Mesh wrong = test::bent(mesh);
  wrong.triangles.pop_back();
  EXPECT_EQ(device.update(test::indexed(test::view_of(wrong))).error().code, ErrorCode::kUsage);
  EXPECT_TRUE(closest(queries, device, points) == before);

  ASSERT_TRUE(device.add_links().ok());
  wrong = mesh;
  wrong.vertices.push_back({0, 0, 0});
  EXPECT_EQ(device.update(test::indexed(test::view_of(wrong))).error().message,
            "the mesh is not a moved copy of the one on the device");
  ASSERT_TRUE(indexed.move_vertices(test::bent(mesh).vertices).ok());
  ASSERT_TRUE(device.update(indexed).ok());

  const std::vector<Point> together(mesh.vertices.size(), Point{1, 1, 1});
  ASSERT_TRUE(indexed.move_vertices(together).ok());
  EXPECT_EQ(device.update(indexed).error().message, "the mesh has no extent, or one too large for a double");
}

// The public call: points that are processed one by one, and thousands that are processed by packets.
TEST_F(SceneUpdate, ScenesAnswerAsNewOnes) {
  const Mesh mesh = test::make_turned_torus(), moved = test::bent(mesh);
  IndexedMesh indexed = test::indexed(test::view_of(mesh));
  Scene scene = Scene::create(*context_, indexed).value();
  ASSERT_TRUE(indexed.move_vertices(moved.vertices).ok());
  ASSERT_TRUE(scene.update(indexed).ok());
  Scene fresh = test::make_scene(*context_, test::view_of(moved)).value();
  for (const std::size_t count : {100u, 6000u}) {
    std::vector<Point> points;
    for (std::size_t i = 0; i < count; ++i) {
      const double t = 0.37 * static_cast<double>(i);
      points.push_back({7 + 2 * std::sin(t), 1.3 * std::cos(1.7 * t), 0.9 * std::sin(2.3 * t)});
    }
    const auto updated = scene.closest_points(points), expected = fresh.closest_points(points);
    ASSERT_TRUE(updated.ok() && expected.ok());
    for (std::size_t i = 0; i < count; ++i)
      EXPECT_NEAR(updated.value()[i].distance, expected.value()[i].distance, 4 * 2e-6 * 7) << i;
  }
  Mesh smaller = mesh;
  smaller.triangles.pop_back();
  EXPECT_EQ(scene.update(test::indexed(test::view_of(smaller))).error().code, ErrorCode::kUsage);
}

}  // namespace
}  // namespace medial_vk
