#include "extraction/common/result_download.h"

#include <cstddef>

#include "device/context_impl.h"

namespace medial_vk {
namespace {

template <class T>
std::span<const T> items(const Buffer& buffer, VkDeviceSize offset, std::uint32_t count) {
  return {reinterpret_cast<const T*>(static_cast<const std::byte*>(buffer.mapped) + offset), count};
}

}  // namespace

// Except on a CPU, mapped memory may be slow to read.
ResultDownload::ResultDownload(ContextImpl& context)
    : context_(&context),
      is_shared_(context.description.type == "cpu"),
      has_own_queue_(context.transfer_queue != VK_NULL_HANDLE),
      arena_(context),
      computed_(context),
      copied_(context),
      computed_signal_(context),
      copies_(context, Commands::queue_for_transfers(context)) {}

ResultDownload::~ResultDownload() {
  for (Commands* commands : {&computed_signal_, &copies_}) commands->drain();
}

Status ResultDownload::make_room(VkDeviceSize bytes) {
  if (memory_.size >= bytes) return {};
  arena_ = Arena(*context_);
  memory_ = {};
  Result<Buffer> made = arena_.create_buffer(bytes + bytes / 4, MemoryKind::kReadback, "points");
  if (!made.ok()) return made.error();
  memory_ = made.value();
  return {};
}

/// Makes writes of kernels visible to the other queue.
Status ResultDownload::hand_over() {
  if (Status ready = computed_.prepare(); !ready.ok()) return ready;
  if (Status ready = copied_.prepare(); !ready.ok()) return ready;
  if (Status begun = computed_signal_.begin(); !begun.ok()) return begun;
  return computed_signal_.submit(nullptr, &computed_);
}

Status ResultDownload::start(const Buffer& points, std::uint32_t point_count, const Buffer& undecided,
                             std::uint32_t undecided_count) {
  is_under_way_ = true;
  is_shared_ = is_shared_ && points.mapped != nullptr && undecided.mapped != nullptr;
  if (is_shared_) {
    points_ = items<gpu::FoundPoint>(points, 0, point_count);
    undecided_ = items<gpu::UndecidedCell>(undecided, 0, undecided_count);
    return {};
  }
  const VkDeviceSize undecided_at = point_count * sizeof(gpu::FoundPoint);
  if (Status room = make_room(undecided_at + undecided_count * sizeof(gpu::UndecidedCell)); !room.ok()) return room;
  points_ = items<gpu::FoundPoint>(memory_, 0, point_count);
  undecided_ = items<gpu::UndecidedCell>(memory_, undecided_at, undecided_count);
  if (has_own_queue_) {
    if (Status handed = hand_over(); !handed.ok()) return handed;
  }
  if (Status recorded = record_copies(points, undecided, undecided_at); !recorded.ok()) return recorded;
  is_waited_for_ = !has_own_queue_;
  return copies_.submit(has_own_queue_ ? &computed_ : nullptr, has_own_queue_ ? &copied_ : nullptr);
}

Status ResultDownload::record_copies(const Buffer& points, const Buffer& undecided, VkDeviceSize undecided_at) {
  if (Status begun = copies_.begin(); !begun.ok()) return begun;
  Recorder& r = copies_.recorder();
  r.copy(points, 0, memory_, 0, points_.size_bytes());
  r.copy(undecided, 0, memory_, undecided_at, undecided_.size_bytes());
  r.barrier_to_host();
  r.barrier();  // later submissions to the same queue write new points
  return r.status();
}

const Semaphore* ResultDownload::before_next() {
  if (is_waited_for_) return nullptr;
  is_waited_for_ = true;
  return &copied_;
}

Result<bool> ResultDownload::finish() {
  if (!is_under_way_) return false;
  is_under_way_ = false;
  for (Commands* commands : {&computed_signal_, &copies_})
    if (Status done = commands->wait(); !done.ok()) return done.error();
  return true;
}

}  // namespace medial_vk
