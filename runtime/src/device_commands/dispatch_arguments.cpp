#include "device_commands/dispatch_arguments.h"

#include <algorithm>
#include <cstring>
#include <span>

namespace medial_vk {
namespace {

// Rows are reused from the first on; barriers separate a batch from earlier users of its rows.
constexpr std::uint32_t kRows = 4096;
// vkCmdUpdateBuffer takes 65,536 bytes.
constexpr std::size_t kMostInBatch = 1024;
static_assert(kMostInBatch * sizeof(gpu::DispatchConstants) <= 65536 && kMostInBatch <= kRows);

constexpr std::uint32_t kWorkgroupSize = 64;

// Equality except for the position of the group counts. Queries are counted when they are prepared, so requests with
// queries are never shared.
bool is_same(gpu::DispatchConstants a, const gpu::DispatchConstants& b) {
  a.argument = b.argument;
  return a.queries_per_item == 0 && std::memcmp(&a, &b, sizeof(a)) == 0;
}

// Its position, or the one for its insertion.
std::size_t row_of(const gpu::DispatchConstants& wanted, const std::vector<gpu::DispatchConstants>& rows) {
  const auto known = std::ranges::find_if(rows, [&](const auto& row) { return is_same(row, wanted); });
  return static_cast<std::size_t>(known - rows.begin());
}

}  // namespace

Status DispatchArguments::create(Arena& arena, const Buffer& counters, const StopWord& stop, bool is_stage) {
  counters_ = counters;
  stop_ = &stop;
  is_stage_ = is_stage;
  Result<Buffer> table =
      arena.create_buffer(kRows * sizeof(gpu::DispatchConstants), MemoryKind::kDevice, "sizes of dispatches");
  if (!table.ok()) return table.error();
  table_ = table.value();
  Result<Buffer> arguments =
      arena.create_buffer(kRows * sizeof(VkDispatchIndirectCommand), MemoryKind::kDevice, "dispatch arguments");
  if (!arguments.ok()) return arguments.error();
  arguments_ = arguments.value();
  return {};
}

void DispatchArguments::begin_plan() {
  batches_.clear();
  calls_.clear();
  plans_ = is_stale_ = true;
}

void DispatchArguments::begin() {
  plans_ = false;
  next_batch_ = next_call_ = 0;
  next_row_ = 0;
}

void DispatchArguments::start(Recorder& recorder, std::uint32_t start) {
  if (!plans_) return record_batch(recorder);
  batches_.push_back({start, {}});
  is_stale_ = false;
}

VkDeviceSize DispatchArguments::offset_of(Recorder& recorder, const gpu::DispatchConstants& wanted) {
  if (plans_) {
    note(wanted);
    return 0;
  }
  const Call& call = calls_[next_call_++];
  if (call.batch == next_batch_) record_batch(recorder);
  return VkDeviceSize{batches_[call.batch].rows[call.row].argument} * sizeof(VkDispatchIndirectCommand);
}

void DispatchArguments::note(const gpu::DispatchConstants& wanted) {
  if (is_stale_) batches_.emplace_back();
  is_stale_ = false;
  std::size_t row = row_of(wanted, batches_.back().rows);
  if (row == kMostInBatch) {
    batches_.emplace_back();
    row = 0;
  }
  std::vector<gpu::DispatchConstants>& rows = batches_.back().rows;
  if (row == rows.size()) rows.push_back(wanted);
  calls_.push_back({batches_.size() - 1, row});
}

void DispatchArguments::record_batch(Recorder& recorder) {
  if (is_stage_) recorder.begin_stage("prepare_dispatch");
  Batch& batch = batches_[next_batch_++];
  const auto count = static_cast<std::uint32_t>(batch.rows.size());
  if (next_row_ + count > kRows) next_row_ = 0;
  const gpu::PrepareConstants constants{next_row_, count, batch.start};
  for (gpu::DispatchConstants& row : batch.rows) row.argument = next_row_++;
  const VkDeviceSize row_bytes = sizeof(gpu::DispatchConstants);
  recorder.update(table_, constants.first * row_bytes, std::as_bytes(std::span(batch.rows)));
  recorder.barrier();
  const BufferRange buffers[] = {counters_.range(), arguments_.range(), stop_->range(), table_.range()};
  recorder.dispatch({"prepare_dispatches", 4, 0, sizeof(constants), kWorkgroupSize, {}}, buffers, {},
                    bytes_of(constants), kWorkgroupSize);
  recorder.barrier();
}

}  // namespace medial_vk
