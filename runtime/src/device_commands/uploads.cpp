#include "device_commands/uploads.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "device/context_impl.h"

namespace medial_vk {
namespace {

constexpr VkDeviceSize kBlockBytes = 4ull << 20;  // a transfer of a tenth of a millisecond or more

}  // namespace

Uploads::Uploads(ContextImpl& context)
    : context_(&context),
      arena_(context),
      sent_(context),
      received_(context),
      blocks_{Block(context, Commands::queue_for_transfers(context)),
              Block(context, Commands::queue_for_transfers(context))} {}

Uploads::~Uploads() {
  for (Commands* commands : {&blocks_[0].commands, &blocks_[1].commands, &received_}) commands->drain();
}

Status Uploads::begin(Block& block) {
  if (Status emptied = block.commands.wait(); !emptied.ok()) return emptied;
  if (block.memory.mapped == nullptr) {
    Result<Buffer> made = arena_.create_buffer(kBlockBytes, MemoryKind::kUpload, "staging");
    if (!made.ok()) return made.error();
    block.memory = made.value();
  }
  block.used = 0;
  if (Status begun = block.commands.begin(); !begun.ok()) return begun;
  block.records = true;
  return {};
}

Status Uploads::send(Block& block, const Semaphore* signal) {
  block.records = false;
  block.commands.recorder().barrier();  // for the commands of later submissions to this queue
  return block.commands.submit(nullptr, signal);
}

Status Uploads::add(const Buffer& buffer, std::span<const std::byte> bytes) {
  if (bytes.size() > buffer.size) {
    return Error{ErrorCode::kInternal, "upload of " + std::to_string(bytes.size()) + " bytes into a buffer of " +
                                           std::to_string(buffer.size)};
  }
  if (buffer.mapped != nullptr) {
    if (!bytes.empty()) std::memcpy(buffer.mapped, bytes.data(), bytes.size());
    return {};
  }
  for (std::size_t done = 0; done < bytes.size();) {
    Block& block = blocks_[current_];
    if (!block.records) {
      if (Status begun = begin(block); !begun.ok()) return begun;
    }
    const std::size_t count = std::min<std::size_t>(bytes.size() - done, block.memory.size - block.used);
    std::memcpy(static_cast<std::byte*>(block.memory.mapped) + block.used, bytes.data() + done, count);
    block.commands.recorder().copy(block.memory, block.used, buffer, done, count);
    block.used += count;
    done += count;
    is_sending_ = true;
    if (block.used == block.memory.size) {
      if (Status sent = send(block, nullptr); !sent.ok()) return sent;
      current_ = 1 - current_;
    }
  }
  return {};
}

Status Uploads::flush() {
  if (!is_sending_) return {};
  is_sending_ = false;
  Block& last = blocks_[current_];
  const bool has_own_queue = context_->transfer_queue != VK_NULL_HANDLE;
  if (!has_own_queue) return last.records ? send(last, nullptr) : Status();
  if (!last.records) {  // the previous one was full and is pending: the signal follows it
    if (Status begun = begin(last); !begun.ok()) return begun;
  }
  if (Status done = received_.wait(); !done.ok()) return done;  // the semaphore is signalled again only after its wait
  if (Status ready = sent_.prepare(); !ready.ok()) return ready;
  if (Status sent = send(last, &sent_); !sent.ok()) return sent;
  // A wait for the fence of a copy would make its bytes available, but not visible to kernels on another queue: the
  // semaphore does.
  if (Status begun = received_.begin(); !begun.ok()) return begun;
  return received_.submit(&sent_, nullptr);
}

Status Uploads::finish() {
  if (Status sent = flush(); !sent.ok()) return sent;
  for (Commands* commands : {&blocks_[0].commands, &blocks_[1].commands, &received_})
    if (Status done = commands->wait(); !done.ok()) return done;
  return {};
}

Status upload(ContextImpl& context, const Buffer& buffer, std::span<const std::byte> bytes) {
  Uploads uploads(context);
  if (Status added = uploads.add(buffer, bytes); !added.ok()) return added;
  return uploads.finish();
}

}  // namespace medial_vk
