// The order in which lines and flux samples are processed (shaders/certified/sort_by_work.comp): all of them occur, and
// neighbours have similar numbers of contacts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <span>
#include <vector>

#include "device/context_impl.h"
#include "device_commands/commands.h"
#include "device_commands/memory.h"
#include "device_commands/uploads.h"
#include "gpu_types.h"
#include "support/device/device.h"
#include "support/extraction.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kBlock = 64 * gpu::kSortedPerLane;
constexpr std::uint32_t kUntouched = 0xffffffffu;

/// The order of the items from `first_item` on; `work` is theirs, and they are the last.
std::vector<std::uint32_t> order_of(const std::vector<std::uint32_t>& work, std::uint32_t first_item) {
  Context context = test::make_context();
  std::vector<std::uint32_t> order;
  {
    Arena arena(Internals::of(context));
    const auto on_device = [&](const std::vector<std::uint32_t>& words) {
      const Buffer buffer = arena.create_buffer(4 * words.size(), MemoryKind::kDevice, "a test").value();
      EXPECT_TRUE(upload(Internals::of(context), buffer, std::as_bytes(std::span(words))).ok());
      return buffer;
    };
    std::vector<std::uint32_t> counters(gpu::kCounterCount);
    counters[gpu::kLines] = static_cast<std::uint32_t>(first_item + work.size());
    const std::size_t blocks = (work.size() + kBlock - 1) / kBlock;
    const Buffer ordered = on_device(std::vector<std::uint32_t>(blocks * kBlock, kUntouched));
    const Buffer back = arena.create_buffer(ordered.size, MemoryKind::kReadback, "a test").value();
    const BufferRange buffers[] = {on_device(counters).range(), on_device(work).range(), ordered.range()};
    gpu::StepConstants step{};
    step.items_counter = gpu::kLines;
    step.items_multiplier = 1;
    step.first_item = first_item;
    const auto ran = run_commands(Internals::of(context), [&](Recorder& r) {
      r.dispatch({"sort_by_work", 3, 0, sizeof(step), 64, {}}, buffers, {}, bytes_of(step), blocks * 64);
      r.barrier();
      r.copy(ordered, 0, back, 0, back.size);
      r.barrier_to_host();
      return r.status();
    });
    EXPECT_TRUE(ran.ok());
    const auto* words = static_cast<const std::uint32_t*>(back.mapped);
    order.assign(words, words + blocks * kBlock);
  }
  EXPECT_EQ(context.validation_messages(), 0u);
  return order;
}

void expect_sorted(const std::vector<std::uint32_t>& work, std::uint32_t first_item = 0) {
  const std::vector<std::uint32_t> order = order_of(work, first_item);
  for (std::size_t first = 0; first < work.size(); first += kBlock) {
    const std::size_t end = std::min(work.size(), first + kBlock);
    std::vector<std::uint32_t> items(order.begin() + first, order.begin() + end), all(end - first);
    std::iota(all.begin(), all.end(), static_cast<std::uint32_t>(first));
    std::vector<std::uint32_t> sorted = items;
    std::sort(sorted.begin(), sorted.end());
    ASSERT_EQ(sorted, all) << "block from " << first;
    for (std::size_t i = 1; i < items.size(); ++i) {
      const double before = work[items[i - 1]], now = work[items[i]];
      // There are eight classes for a power of two, and one for all from 57,344 on: 7/4 of 2^15.
      if (before < 57344) {
        EXPECT_LT(now, before == 0 ? 1 : before * 9 / 8) << "position " << first + i;
      }
    }
  }
  EXPECT_TRUE(std::all_of(order.begin() + work.size(), order.end(), [](std::uint32_t i) { return i == kUntouched; }));
}

// Powers of ten, and some items without work.
std::vector<std::uint32_t> works(std::size_t count, double largest) {
  std::mt19937 random(static_cast<unsigned>(count));
  std::uniform_real_distribution<double> exponent(-0.5, std::log10(largest));
  std::vector<std::uint32_t> result(count);
  for (std::uint32_t& work : result) work = static_cast<std::uint32_t>(std::pow(10.0, exponent(random)));
  return result;
}

TEST(WorkOrder, NeighboursHaveSimilarWork) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  for (const std::size_t count : {1, 7, 64, 1000, 1024, 1025, 5000}) expect_sorted(works(count, 3000));
}

TEST(WorkOrder, HoldsForTheLongestLists) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  expect_sorted(works(3000, 8e6));
}

TEST(WorkOrder, OfABlockIsCountedFromItsFirstItem) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  expect_sorted(works(1500, 300), 4096);
}

TEST(WorkOrder, IsOneOfThemWhereAllWorkIsEqual) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  expect_sorted(std::vector<std::uint32_t>(2500, 17));
  expect_sorted(std::vector<std::uint32_t>(2500, 0));
}

}  // namespace
}  // namespace medial_vk
