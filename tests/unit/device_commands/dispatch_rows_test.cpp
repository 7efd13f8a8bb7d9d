// Dispatches that a processor with several threads runs (prepare.glsl, workgroup_index.glsl): each workgroup runs once,
// neighbours run on different threads, and results do not depend on the number of threads.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <optional>
#include <vector>

#include "count_workgroups_spirv.h"
#include "device/context_impl.h"
#include "device_commands/commands.h"
#include "device_commands/memory.h"
#include "device_commands/recorder.h"
#include "device_commands/stop_word.h"
#include "gpu_types.h"
#include "support/device/device.h"
#include "support/extraction.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

constexpr EmbeddedShader kCountingShaders[] = {{"count_workgroups", kCountWorkgroupsSpirv}};

struct Dispatched {
  VkDispatchIndirectCommand command = {};
  std::vector<std::uint32_t> runs;  // of each workgroup; the last entry counts all beyond
};

class DispatchRowsTest : public testing::Test {
 protected:
  static constexpr std::uint32_t kGroupSize = 8, kSpareGroups = 1024;

  void SetUp() override {
    MEDIAL_VK_SKIP_WITHOUT_DEVICE();
    context_.emplace(test::make_context(test::no_validation_reason().empty()));
    Internals::of(*context_).extra_shaders = kCountingShaders;
  }
  void TearDown() override {
    if (context_) {
      EXPECT_EQ(context_->validation_messages(), 0u);
    }
  }

  /// A dispatch of `items` items from `first` on, at most `limit`.
  Dispatched dispatch(std::uint32_t items, std::uint32_t threads, std::uint32_t first = 0,
                      std::uint32_t limit = 0xffffffffu) {
    gpu::DispatchConstants d{};
    d.items_counter = gpu::kParents;
    d.items_multiplier = d.items_divisor = 1;
    d.group_size = kGroupSize;
    d.first_item = first;
    d.item_limit = limit;
    d.list_counter = gpu::kNoCounter;
    d.threads = threads;

    ContextImpl& impl = Internals::of(*context_);
    Arena arena(impl);
    const auto create = [&arena](VkDeviceSize bytes, MemoryKind kind) {
      return arena.create_buffer(bytes, kind, "a test").value();
    };
    const std::uint32_t words = (items + kGroupSize - 1) / kGroupSize + kSpareGroups;
    const Buffer counters = create(gpu::kCounterCount * 4, MemoryKind::kDevice);
    const Buffer arguments = create(sizeof(VkDispatchIndirectCommand), MemoryKind::kDevice);
    const Buffer runs = create(VkDeviceSize{words} * 4, MemoryKind::kDevice);
    const Buffer back = create(runs.size + arguments.size, MemoryKind::kReadback);
    const StopWord stop = StopWord::create(impl).value();
    const auto ran = run_commands(impl, [&](Recorder& r) {
      r.fill(counters, 0, counters.size, 0);
      r.fill(runs, 0, runs.size, 0);
      r.barrier();
      r.fill(counters, VkDeviceSize{gpu::kParents} * 4, 4, items);
      r.barrier();
      const BufferRange prepared[] = {counters.range(), arguments.range(), stop.range()};
      r.dispatch({"prepare_dispatch", 3, 0, sizeof(d), 1, {}}, prepared, {}, bytes_of(d), 1);
      r.barrier();
      const BufferRange counted[] = {runs.range()};
      r.dispatch_indirect({"count_workgroups", 1, 0, 0, 1, {}}, counted, {}, {}, arguments, 0);
      r.barrier();
      r.copy(runs, 0, back, 0, runs.size);
      r.copy(arguments, 0, back, runs.size, arguments.size);
      r.barrier_to_host();
      return r.status();
    });
    EXPECT_TRUE(ran.ok()) << ran.error().message;
    Dispatched result;
    result.runs.resize(words);
    std::memcpy(result.runs.data(), back.mapped, VkDeviceSize{words} * 4);
    std::memcpy(&result.command, static_cast<const std::byte*>(back.mapped) + runs.size, sizeof(result.command));
    return result;
  }

  static void expect_each_once(const Dispatched& dispatched, std::uint32_t groups) {
    ASSERT_LT(groups, dispatched.runs.size());
    for (std::uint32_t group = 0; group < groups; ++group) ASSERT_EQ(dispatched.runs[group], 1u) << "group " << group;
  }

  std::optional<Context> context_;
};

TEST_F(DispatchRowsTest, EachGroupRunsOnce) {
  for (const std::uint32_t threads : {1u, 2u, 3u, 64u})
    for (const std::uint32_t groups : {1u, 2u, 63u, 64u, 65u, 1000u, 2048u, 32768u, 32769u, 70001u}) {
      SCOPED_TRACE(testing::Message() << threads << " threads, " << groups << " groups");
      const Dispatched dispatched = dispatch(groups * kGroupSize - 3, threads);
      expect_each_once(dispatched, groups);
      // The added groups are fewer than would fill a run in each row.
      const std::uint32_t all = dispatched.command.x * dispatched.command.y;
      EXPECT_GE(all, groups);
      EXPECT_LT(all, groups + gpu::kGroupsInRun * dispatched.command.y);
      EXPECT_LE(dispatched.command.x, gpu::kGroupsInRow);
    }
}

TEST_F(DispatchRowsTest, NoGroupRunsBeyondALimit) {
  for (const std::uint32_t threads : {1u, 2u, 3u})
    for (const std::uint32_t limit : {64u, 96u, 100u, 127u, 16384u, 32768u, 65536u}) {
      SCOPED_TRACE(testing::Message() << threads << " threads, at most " << limit << " groups");
      const Dispatched dispatched = dispatch(70000 * kGroupSize, threads, 8 * kGroupSize, limit * kGroupSize);
      expect_each_once(dispatched, limit);
      EXPECT_EQ(dispatched.runs[limit], 0u);
      EXPECT_EQ(dispatched.command.x * dispatched.command.y, limit);
    }
}

TEST_F(DispatchRowsTest, WhatTheHostSizesGoesToRowsToo) {
  constexpr std::uint32_t kGroups = 3 * gpu::kGroupsInRow + 5;
  ContextImpl& impl = Internals::of(*context_);
  Arena arena(impl);
  const Buffer runs = arena.create_buffer(VkDeviceSize{kGroups + 1} * 4, MemoryKind::kDevice, "a test").value();
  const Buffer back = arena.create_buffer(runs.size, MemoryKind::kReadback, "a test").value();
  const auto ran = run_commands(impl, [&](Recorder& r) {
    r.fill(runs, 0, runs.size, 0);
    r.barrier();
    const BufferRange counted[] = {runs.range()};
    r.dispatch({"count_workgroups", 1, 0, 0, 1, {}}, counted, {}, {}, kGroups);
    r.barrier();
    r.copy(runs, 0, back, 0, runs.size);
    r.barrier_to_host();
    return r.status();
  });
  ASSERT_TRUE(ran.ok()) << ran.error().message;
  const auto* words = static_cast<const std::uint32_t*>(back.mapped);
  for (std::uint32_t group = 0; group < kGroups; ++group) ASSERT_EQ(words[group], 1u) << "group " << group;
}

// The device proceeds along rows: one of two threads takes one row.
TEST_F(DispatchRowsTest, ThereIsARowForEachThread) {
  EXPECT_EQ(dispatch(1000 * kGroupSize, 1).command.y, 1u);
  EXPECT_EQ(dispatch(1000 * kGroupSize, 2).command.y, 2u);
  EXPECT_EQ(dispatch(1000 * kGroupSize, 7).command.y, 7u);
  // Too few for a run each, twice over.
  EXPECT_EQ(dispatch(63 * kGroupSize, 2).command.y, 1u);
  EXPECT_EQ(dispatch(0, 2).command.x, 0u);
}

TEST_F(DispatchRowsTest, ResultsAreTheSameForAnyNumberOfThreads) {
  Mesh solid = test::make_l_shape(1.0, 0.4, 0.5);
  test::rotate(solid, {0.3, 0.5, 0.8}, 0.7);
  const PreparedMesh mesh = test::prepare(std::move(solid));
  for (const Mode mode : {Mode::kCertified, Mode::kThesis}) {
    ExtractionOptions options;
    options.resolution = 40;
    options.mode = mode;
    Internals::of(*context_).dispatch_threads = 1;
    const Extraction one = test::extract_on_device(*context_, mesh, options).extraction;
    ASSERT_GT(one.spheres.size(), 500u);
    for (const std::uint32_t threads : {2u, 3u, 5u}) {
      Internals::of(*context_).dispatch_threads = threads;
      const Extraction several = test::extract_on_device(*context_, mesh, options).extraction;
      ASSERT_EQ(several.spheres.size(), one.spheres.size()) << threads;
      for (std::size_t i = 0; i < one.spheres.size(); ++i)
        ASSERT_EQ(std::memcmp(&several.spheres[i], &one.spheres[i], sizeof(MedialSphere)), 0) << threads;
      EXPECT_EQ(several.measurements.counters.undecided, one.measurements.counters.undecided) << threads;
    }
  }
}

}  // namespace
}  // namespace medial_vk
