// The counts of tests that walks of the tree report, where the true counts are known.
#include <gtest/gtest.h>

#include <cstring>
#include <optional>
#include <vector>

#include "device/context_impl.h"
#include "device_commands/commands.h"
#include "device_commands/uploads.h"
#include "device_mesh/device_tree.h"
#include "queries/packet_queries.h"
#include "queries/tree_queries.h"
#include "support/device/device_test.h"
#include "support/device/uploaded_mesh.h"
#include "support/solids/solids.h"
#include "tree_types.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kQueries = 51;
constexpr float kFar = 3.4e38f;
constexpr VkDeviceSize kTexelsPerNode = 12;  // shaders/shared/tree/tree.glsl

struct Tests {
  std::uint64_t nodes = 0, triangles = 0;
};

class TreeCounts : public test::DeviceTest {
 protected:
  void SetUp() override {
    test::DeviceTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    ContextImpl& context = Internals::of(*context_);
    mesh_ = test::make_sphere(1.0, 2000);
    device_.emplace(test::upload_mesh(context, test::view_of(mesh_)).value());
    arena_.emplace(context);
    at_ = arena_->create_buffer(kQueries * 16, MemoryKind::kDevice, "a test").value();
    out_ = arena_->create_buffer(kQueries * 16, MemoryKind::kDevice, "a test").value();
    hits_ = arena_->create_buffer(kQueries * 4, MemoryKind::kDevice, "a test").value();
    counts_ = arena_->create_buffer(16, MemoryKind::kReadback, "a test").value();
  }
  // Members before the context that they belong to.
  void TearDown() override {
    arena_.reset();
    device_.reset();
    test::DeviceTest::TearDown();
  }

  /// All queries at the same point of the unit box, with the same w. `queries` count their tests.
  template <class Queries, class Record>
  Tests tests_of(const Queries& queries, const Texel& query, const Record& record) {
    const std::vector<Texel> all(kQueries, query);
    EXPECT_TRUE(upload(Internals::of(*context_), at_, std::as_bytes(std::span(all))).ok());
    const auto done = run_commands(Internals::of(*context_), [&](Recorder& r) {
      queries.clear_tests(r);
      record(r);
      queries.copy_tests(r, counts_, 0);
      r.barrier_to_host();
      return r.status();
    });
    EXPECT_TRUE(done.ok());
    std::uint32_t words[4];
    std::memcpy(words, counts_.mapped, sizeof(words));
    return {words[0] + (std::uint64_t{words[1]} << 32), words[2] + (std::uint64_t{words[3]} << 32)};
  }

  std::uint64_t inner_nodes() const { return device_->tree.size / (kTexelsPerNode * sizeof(Texel)); }
  std::uint64_t triangles() const { return mesh_.triangles.size(); }

  Mesh mesh_;
  std::optional<DeviceMesh> device_;
  std::optional<Arena> arena_;
  Buffer at_, out_, hits_, counts_;
};

TEST_F(TreeCounts, WithoutToleranceAWindingNumberOpensEveryNode) {
  const TreeQueries queries = TreeQueries::create(Internals::of(*context_), *device_, kQueries, {}, true).value();
  const Tests tests = tests_of(queries, {0.5f, 0.5f, 0.5f, kFar}, [&](Recorder& r) {
    queries.winding(r, QueryCount::of(kQueries), at_.range(), out_.range(), 0.0f);
  });
  EXPECT_EQ(tests.nodes, kQueries * 2 * inner_nodes());
  EXPECT_EQ(tests.triangles, kQueries * triangles());
}

TEST_F(TreeCounts, WhoSeeksNothingTestsTheRoot) {
  const Texel outside = {2, 2, 2, 0};
  const TreeQueries single = TreeQueries::create(Internals::of(*context_), *device_, kQueries, {}, true).value();
  for (const bool empty : {false, true}) {
    const Tests tests = tests_of(single, outside, [&](Recorder& r) {
      if (empty) return single.empty(r, QueryCount::of(kQueries), at_.range(), out_.range());
      single.closest(r, QueryCount::of(kQueries), at_.range(), out_.range(), hits_.range());
    });
    EXPECT_EQ(tests.nodes, 2 * kQueries);
    EXPECT_EQ(tests.triangles, 0u);
  }
}

TEST_F(TreeCounts, APacketTestsABoxOnceForAllItsPoints) {
  for (const PacketShape& shape : {PacketShape::best_for(Internals::of(*context_)), PacketShape::of(16, true)}) {
    ASSERT_EQ(shape.packets(kQueries), 1u);
    const PacketQueries packets =
        PacketQueries::create(Internals::of(*context_), *device_, kQueries, shape, true).value();
    const std::vector<std::uint32_t> slots = make_slots(shape, kQueries);
    const Buffer table = arena_->create_buffer(slots.size() * 4, MemoryKind::kDevice, "a test").value();
    ASSERT_TRUE(upload(Internals::of(*context_), table, std::as_bytes(std::span(slots))).ok());
    const auto query = [&](Recorder& r) {
      packets.closest(r, {.groups = 1, .group_size = kQueries}, table.range(0, slots.size() * 4), at_.range(),
                      out_.range(), hits_.range());
    };
    const Tests nothing = tests_of(packets, {2, 2, 2, 0}, query);
    EXPECT_EQ(nothing.nodes, shape.arity());
    EXPECT_EQ(nothing.triangles, 0u);
    // Next to the boundary all points examine only a part; from the centre much of it is nearly equally far.
    const Tests near = tests_of(packets, {0.5f, 0.5f, 0.02f, kFar}, query);
    EXPECT_GT(near.nodes, shape.arity());
    EXPECT_GE(near.triangles, kQueries);
    EXPECT_LT(near.triangles, kQueries * triangles() / 4);
    const Tests centre = tests_of(packets, {0.5f, 0.5f, 0.5f, kFar}, query);
    EXPECT_GT(centre.triangles, near.triangles);
    EXPECT_GT(centre.nodes, near.nodes);
  }
}

TEST_F(TreeCounts, TheHighWordTakesWhatTheLowOneCannot) {
  const TreeQueries queries = TreeQueries::create(Internals::of(*context_), *device_, kQueries, {}, true).value();
  const BufferRange list = queries.unresolved();
  const Buffer words{list.buffer, list.size};
  const Tests tests = tests_of(queries, {2, 2, 2, 0}, [&](Recorder& r) {
    r.fill(words, gpu::kNodeTests * 4, 4, 0xffffffffu);
    r.barrier();
    queries.closest(r, QueryCount::of(kQueries), at_.range(), out_.range(), hits_.range());
  });
  EXPECT_EQ(tests.nodes, 0xffffffffull + 2 * kQueries);
}

TEST_F(TreeCounts, CountsOnlyOnRequest) {
  const TreeQueries queries = TreeQueries::create(Internals::of(*context_), *device_, kQueries).value();
  const Tests tests = tests_of(queries, {0.5f, 0.5f, 0.02f, kFar}, [&](Recorder& r) {
    queries.closest(r, QueryCount::of(kQueries), at_.range(), out_.range(), hits_.range());
  });
  EXPECT_EQ(tests.nodes, 0u);
  EXPECT_EQ(tests.triangles, 0u);
}

}  // namespace
}  // namespace medial_vk
