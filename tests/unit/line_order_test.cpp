// The order in which lines are asked (shaders/sort_lines.comp): all of them, and neighbours with about as many
// contacts.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>
#include <vector>

#include "commands.h"
#include "context_impl.h"
#include "gpu_types.h"
#include "memory.h"
#include "support/device.h"
#include "support/extraction.h"
#include "uploads.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kBlock = 64 * gpu::kSortedPerLane;

class LineOrder : public testing::Test {
 protected:
  void SetUp() override {
    MEDIAL_VK_SKIP_WITHOUT_DEVICE();
    context_.emplace(test::make_context());
    arena_.emplace(context_->impl());
    counters_.resize(gpu::kCounterCount);
  }
  void TearDown() override {
    arena_.reset();
    if (context_) {
      EXPECT_EQ(context_->validation_messages(), 0u);
    }
  }

  // Lists of lengths that differ by powers of ten, some of no or one entry.
  void add_cells(std::uint32_t count) {
    std::uniform_real_distribution<double> exponent(-0.3, 3.0);
    std::uint32_t words = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      gpu::Cell cell{};
      cell.touching = static_cast<std::uint32_t>(std::pow(10.0, exponent(random_)));
      cell.word_begin = words;
      cells_.push_back(cell);
      words += (cell.touching + 31) / 32;
    }
    masks_.resize(std::size_t{8} * words + 1);
  }

  template <class T>
  Buffer on_device(const std::vector<T>& values) {
    const Buffer buffer = arena_->create_buffer(values.size() * sizeof(T), MemoryKind::kDevice, "a test").value();
    EXPECT_TRUE(upload(context_->impl(), buffer, std::as_bytes(std::span(values))).ok());
    return buffer;
  }

  std::vector<std::uint32_t> order_of(std::uint32_t items, std::uint32_t lines_per_cell, std::uint32_t task) {
    points_.resize(std::max<std::size_t>(points_.size(), 1));
    lines_.resize(std::max<std::size_t>(lines_.size(), 1));
    const std::vector<std::uint32_t> untouched(items, 0xffffffffu);
    const Buffer order = on_device(untouched),
                 back = arena_->create_buffer(4 * VkDeviceSize{items}, MemoryKind::kReadback, "a test").value();
    const Buffer buffers[] = {on_device(counters_), on_device(cells_), on_device(points_),
                              on_device(lines_),    on_device(masks_), order};
    std::vector<BufferRange> ranges;
    for (const Buffer& buffer : buffers) ranges.push_back(buffer.range());
    gpu::StepConstants step{};
    step.lines_per_cell = lines_per_cell;
    step.second_task = task;
    const auto ran = run_commands(context_->impl(), [&](Recorder& r) {
      r.dispatch({"sort_lines", 6, 0, sizeof(step), 64, {}}, ranges, {}, bytes_of(step),
                 (items + gpu::kSortedPerLane - 1) / gpu::kSortedPerLane);
      r.barrier();
      r.copy(order, 0, back, 0, back.size);
      r.barrier_to_host();
      return r.status();
    });
    EXPECT_TRUE(ran.ok());
    const auto* words = static_cast<const std::uint32_t*>(back.mapped);
    return {words, words + items};
  }

  // `work`: of every item.
  static void expect_sorted(const std::vector<std::uint32_t>& order, const std::vector<std::uint32_t>& work) {
    ASSERT_EQ(order.size(), work.size());
    for (std::size_t first = 0; first < order.size(); first += kBlock) {
      const std::size_t end = std::min(order.size(), first + kBlock);
      std::vector<std::uint32_t> items(order.begin() + first, order.begin() + end), all(end - first);
      for (std::size_t i = 1; i < items.size(); ++i) {
        const double before = work[items[i - 1]], now = work[items[i]];
        // Eight classes for a power of two: a ninth in front of it at most.
        EXPECT_LE(now, before * 9 / 8) << "place " << first + i;
        if (before == 0) {
          EXPECT_EQ(now, 0) << "place " << first + i;
        }
      }
      std::iota(all.begin(), all.end(), first);
      std::sort(items.begin(), items.end());
      EXPECT_EQ(items, all) << "block from " << first;
    }
  }

  std::uint32_t draw() { return static_cast<std::uint32_t>(random_()); }

  std::optional<Context> context_;
  std::optional<Arena> arena_;
  std::mt19937 random_{5};
  std::vector<std::uint32_t> counters_, masks_;
  std::vector<gpu::Cell> cells_;
  std::vector<gpu::vec4> points_;
  std::vector<gpu::Line> lines_;
};

TEST_F(LineOrder, OfProposedLinesFollowsTheListsOfTheirCells) {
  add_cells(400);
  std::vector<std::uint32_t> work;
  for (const gpu::Cell& cell : cells_) {
    for (std::uint32_t seed = 0; seed < gpu::kLinesPerCell; ++seed) {
      const bool is_line = draw() % 3 != 0;
      points_.push_back({0, 0, 0, is_line ? 1.0f : -1.0f});
      points_.push_back({});
      work.push_back(is_line ? cell.touching : 0);
    }
  }
  counters_[gpu::kCells] = 400;
  expect_sorted(order_of(400 * gpu::kLinesPerCell, gpu::kLinesPerCell, 0), work);
}

TEST_F(LineOrder, OfLinesThatAreNarrowedFollowsTheirMasks) {
  add_cells(400);
  std::vector<std::uint32_t> work;
  for (std::uint32_t i = 0; i < 2100; ++i) {
    const std::uint32_t c = draw() % 400;
    const gpu::Cell& cell = cells_[c];
    gpu::Line line{};
    line.cell = c;
    line.seed = i % gpu::kLinesPerCell;
    lines_.push_back(line);
    work.push_back(0);
    const std::uint32_t words = (cell.touching + 31) / 32;
    for (std::uint32_t w = 0; w < words; ++w) masks_[8 * cell.word_begin + line.seed * words + w] = draw() & draw();
  }
  for (std::uint32_t i = 0; i < lines_.size(); ++i) {
    const gpu::Cell& cell = cells_[lines_[i].cell];
    const std::uint32_t words = (cell.touching + 31) / 32;
    for (std::uint32_t w = 0; w < words; ++w)
      work[i] += std::popcount(masks_[8 * cell.word_begin + lines_[i].seed * words + w]);
  }
  counters_[gpu::kLines] = static_cast<std::uint32_t>(lines_.size());
  expect_sorted(order_of(counters_[gpu::kLines], gpu::kLinesPerCell, 1), work);
}

}  // namespace
}  // namespace medial_vk
