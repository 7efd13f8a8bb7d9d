#include "device_commands/stop_word.h"

#include <atomic>
#include <cstring>

#include "device/context_impl.h"

namespace medial_vk {

Result<StopWord> StopWord::create(ContextImpl& context) {
  StopWord stop(context);
  Result<Buffer> buffer = stop.arena_.create_buffer(16, MemoryKind::kUpload, "the word that stops a job");
  if (!buffer.ok()) return buffer.error();
  stop.word_ = buffer.value();
  std::memset(stop.word_.mapped, 0, 16);
  return stop;
}

void StopWord::raise() {
  std::atomic_ref<std::uint32_t>(*static_cast<std::uint32_t*>(word_.mapped)).store(1, std::memory_order_release);
}

Result<const StopWord*> StopWatch::make_word(ContextImpl& context) {
  Result<StopWord> word = StopWord::create(context);
  if (!word.ok()) return word.error();
  word_ = std::move(word).value();
  return &*word_;
}

bool StopWatch::stopped() {
  if (!stopped_ && progress_ && !stop_.stop_requested()) progress_(done_);
  stopped_ = stopped_ || stop_.stop_requested();
  if (stopped_ && word_) word_->raise();
  return stopped_;
}

}  // namespace medial_vk
