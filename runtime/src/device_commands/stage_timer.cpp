// The recorder's clock: one timestamp where each stage begins and one where the last ends.
#include <algorithm>

#include "device/context_impl.h"
#include "device_commands/recorder.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kQueriesPerPool = 64;

}  // namespace

void Recorder::write_timestamp() {
  const VolkDeviceTable& vk = context_->vk;
  const auto query = static_cast<std::uint32_t>(timestamp_count_ % kQueriesPerPool);
  if (query == 0) {
    VkQueryPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = kQueriesPerPool;
    VkQueryPool pool = VK_NULL_HANDLE;
    timestamps_.reserve(timestamps_.size() + 1);  // so that no pool is lost
    const VkResult result = vk.vkCreateQueryPool(context_->device, &info, context_->allocation_callbacks, &pool);
    if (result != VK_SUCCESS) return fail(vulkan_error("vkCreateQueryPool", result));
    timestamps_.push_back(pool);
    vk.vkCmdResetQueryPool(commands_, pool, 0, kQueriesPerPool);
  }
  // The bottom of the pipe: after all commands before have finished.
  vk.vkCmdWriteTimestamp(commands_, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, timestamps_.back(), query);
  ++timestamp_count_;
}

void Recorder::begin_stage(const std::string& stage) {
  if (!measures_ || context_->timestamp_valid_bits == 0 || !status_.ok() || rehearses()) return;
  write_timestamp();
  if (status_.ok()) stages_.emplace_back(stage);
}

void Recorder::end_stages() {
  // As many timestamps as stages: the last one is still open.
  if (stages_.empty() || timestamp_count_ != stages_.size() || !status_.ok()) return;
  write_timestamp();
}

Result<std::vector<StageTime>> Recorder::stage_times() const {
  std::vector<StageTime> times;
  if (timestamp_count_ < 2) return times;
  std::vector<std::uint64_t> ticks(timestamps_.size() * kQueriesPerPool);
  for (std::size_t i = 0; i < timestamps_.size(); ++i) {
    const std::size_t first = i * kQueriesPerPool;
    const auto count = static_cast<std::uint32_t>(std::min<std::size_t>(timestamp_count_ - first, kQueriesPerPool));
    const VkResult result =
        context_->vk.vkGetQueryPoolResults(context_->device, timestamps_[i], 0, count, count * sizeof(std::uint64_t),
                                           ticks.data() + first, sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT);
    if (result != VK_SUCCESS) return vulkan_error("vkGetQueryPoolResults", result);
  }

  const std::uint64_t mask = context_->timestamp_valid_bits >= 64
                                 ? ~std::uint64_t{0}
                                 : (std::uint64_t{1} << context_->timestamp_valid_bits) - 1;
  const double seconds_per_tick = static_cast<double>(context_->limits.timestampPeriod) * 1e-9;
  for (std::size_t i = 0; i + 1 < timestamp_count_; ++i) {
    auto time = std::find_if(times.begin(), times.end(), [&](const StageTime& t) { return t.stage == stages_[i]; });
    if (time == times.end()) time = times.insert(times.end(), StageTime{stages_[i], 0.0});
    // Modulo the valid bits, so that one wrap of the counter in between is harmless.
    time->seconds += static_cast<double>((ticks[i + 1] - ticks[i]) & mask) * seconds_per_tick;
  }
  return times;
}

}  // namespace medial_vk
