#include "queries/query_batches.h"

#include <algorithm>
#include <functional>
#include <string>
#include <utility>

#include "device/context_impl.h"

namespace medial_vk {
namespace {

/// The items of both kinds, one after the other.
VkDeviceSize second_items_at(std::uint32_t capacity) { return VkDeviceSize{capacity} * QuerySet::kMostItemBytes[0]; }

}  // namespace

QueryBatches::Batch::Batch(ContextImpl& context)
    : on_device(context),
      for_upload(context),
      for_download(context),
      uploaded(context),
      computed(context),
      upload_commands(context, Commands::queue_for_transfers(context)),
      compute(context),
      download_commands(context, Commands::queue_for_transfers(context)) {}

Status QueryBatches::check(const QuerySet& queries) const {
  if (!std::ranges::equal(queries.item_bytes, QuerySet::kMostItemBytes, std::less_equal<>()))
    return Error{ErrorCode::kInternal, "answers of " + std::to_string(queries.item_bytes[0]) + " and " +
                                           std::to_string(queries.item_bytes[1]) + " bytes"};
  if (queries.batch > 0 && queries.batch <= capacity_ && queries.batch % queries.group_size == 0) return {};
  return Error{ErrorCode::kInternal, "batches of " + std::to_string(queries.batch) + " queries, in groups of " +
                                         std::to_string(queries.group_size) + ", where there is room for " +
                                         std::to_string(capacity_)};
}

Status QueryBatches::create_buffers(Batch& batch) const {
  const VkDeviceSize c = capacity_;
  constexpr std::array<std::uint32_t, 2> kItem = QuerySet::kMostItemBytes;
  const auto create = [](Arena& arena, Buffer& buffer, VkDeviceSize bytes, MemoryKind kind) -> Status {
    Result<Buffer> made = arena.create_buffer(bytes, kind, "queries and their answers");
    if (!made.ok()) return made.error();
    buffer = made.value();
    return {};
  };
  constexpr MemoryKind kDevice = MemoryKind::kDevice;
  if (Status s = create(batch.on_device, batch.queries, c * sizeof(Texel), kDevice); !s.ok()) return s;
  for (std::size_t i = 0; i < kItem.size(); ++i)
    if (Status s = create(batch.on_device, batch.items[i], c * kItem[i], kDevice); !s.ok()) return s;
  batch.is_shared = shares_memory_ && batch.queries.mapped && batch.items[0].mapped && batch.items[1].mapped;
  if (batch.is_shared) return {};
  if (Status s = create(batch.for_upload, batch.upload, c * sizeof(Texel), MemoryKind::kUpload); !s.ok()) return s;
  return create(batch.for_download, batch.download, c * (kItem[0] + kItem[1]), MemoryKind::kReadback);
}

/// Sets of resources are created at their first use: few queries need only one.
Result<QueryBatches::Batch*> QueryBatches::batch(std::size_t number) {
  std::unique_ptr<Batch>& batch = batches_[number % at_once()];
  if (batch == nullptr) {
    auto made = std::make_unique<Batch>(*context_);
    if (Status created = create_buffers(*made); !created.ok()) return created.error();
    batch = std::move(made);
  }
  return batch.get();
}

/// After an error a semaphore may have been signalled without a wait, and a batch may be pending.
void QueryBatches::start_over() noexcept {
  for (const std::unique_ptr<Batch>& batch : batches_) {
    if (batch == nullptr) continue;
    for (Commands* commands : {&batch->upload_commands, &batch->compute, &batch->download_commands}) commands->drain();
  }
  batches_ = {};
}

Status QueryBatches::run(const QuerySet& queries) {
  if (Status fits = check(queries); !fits.ok()) return fits;
  try {
    Status status = run_all(queries);
    if (!status.ok()) start_over();
    return status;
  } catch (...) {  // out of host memory
    start_over();
    throw;
  }
}

// A download waits on its queue for the kernels before it. So it is submitted after the next upload, which can run
// meanwhile.
Status QueryBatches::run_all(const QuerySet& queries) {
  std::size_t number = 0;
  for (std::size_t first = 0; first < queries.count; first += queries.batch, ++number) {
    const Result<Batch*> found = batch(number);
    if (!found.ok()) return found.error();
    Batch& here = *found.value();
    if (Status answered = complete(queries, here); !answered.ok()) return answered;
    here.first = first;
    here.count = std::min(queries.batch, queries.count - first);
    const std::size_t groups = (here.count + queries.group_size - 1) / queries.group_size;
    here.padded = static_cast<std::uint32_t>(groups * queries.group_size);
    if (Status submitted = submit(queries, here); !submitted.ok()) return submitted;
    if (number == 0) continue;
    if (Status down = submit_download(queries, *batches_[(number - 1) % at_once()]); !down.ok()) return down;
  }
  for (std::size_t last = number; last < number + at_once(); ++last) {
    const std::unique_ptr<Batch>& batch = batches_[last % at_once()];
    if (batch == nullptr) continue;
    if (Status answered = complete(queries, *batch); !answered.ok()) return answered;
  }
  return {};
}

Status QueryBatches::write(const QuerySet& queries, const Batch& batch) const {
  auto* out = static_cast<Texel*>((batch.is_shared ? batch.queries : batch.upload).mapped);
  std::fill(out + batch.count, out + batch.padded, Texel{0, 0, 0, -1});
  return queries.write(batch.first, {out, batch.count});
}

Status QueryBatches::submit(const QuerySet& queries, Batch& batch) const {
  if (Status written = write(queries, batch); !written.ok()) return written;
  // A single batch has nothing to overlap with: one submission suffices.
  batch.is_apart = !batch.is_shared && context_->transfer_queue != VK_NULL_HANDLE && queries.count > queries.batch;
  const auto record_upload = [&batch](Recorder& r) {
    r.copy(batch.upload, 0, batch.queries, 0, batch.padded * sizeof(Texel));
    r.barrier();
  };
  if (batch.is_apart) {
    for (Semaphore* semaphore : {&batch.uploaded, &batch.computed})
      if (Status prepared = semaphore->prepare(); !prepared.ok()) return prepared;
    if (Status begun = batch.upload_commands.begin(); !begun.ok()) return begun;
    record_upload(batch.upload_commands.recorder());
    if (Status submitted = batch.upload_commands.submit(nullptr, &batch.uploaded); !submitted.ok()) return submitted;
  }
  if (Status begun = batch.compute.begin(); !begun.ok()) return begun;
  Recorder& r = batch.compute.recorder();
  if (!batch.is_apart && !batch.is_shared) record_upload(r);
  queries.record(r, batch.padded, batch.queries, batch.items);
  batch.state = Batch::State::kSubmitted;
  if (batch.is_apart) return batch.compute.submit(&batch.uploaded, &batch.computed);
  if (!batch.is_shared) record_download(queries, batch, r);
  r.barrier_to_host();
  return batch.compute.submit(nullptr, nullptr);
}

void QueryBatches::record_download(const QuerySet& queries, const Batch& batch, Recorder& r) const {
  const VkDeviceSize count = batch.padded;
  r.copy(batch.items[0], 0, batch.download, 0, count * queries.item_bytes[0]);
  r.copy(batch.items[1], 0, batch.download, second_items_at(capacity_), count * queries.item_bytes[1]);
}

Status QueryBatches::submit_download(const QuerySet& queries, Batch& batch) const {
  if (batch.state != Batch::State::kSubmitted) return {};
  batch.state = Batch::State::kDownloading;
  if (!batch.is_apart) return {};
  if (Status begun = batch.download_commands.begin(); !begun.ok()) return begun;
  record_download(queries, batch, batch.download_commands.recorder());
  batch.download_commands.recorder().barrier_to_host();
  return batch.download_commands.submit(&batch.computed, nullptr);
}

Status QueryBatches::complete(const QuerySet& queries, Batch& batch) const {
  if (Status down = submit_download(queries, batch); !down.ok()) return down;
  if (batch.state == Batch::State::kFree) return {};
  for (Commands* commands : {&batch.upload_commands, &batch.compute, &batch.download_commands}) {
    if (Status done = commands->wait(); !done.ok()) return done;
  }
  batch.state = Batch::State::kFree;
  const auto bytes = [](const Buffer& buffer) { return static_cast<const std::byte*>(buffer.mapped); };
  std::array<const std::byte*, 2> items = {bytes(batch.items[0]), bytes(batch.items[1])};
  if (!batch.is_shared) items = {bytes(batch.download), bytes(batch.download) + second_items_at(capacity_)};
  return queries.read(batch.first, batch.count, items);
}

}  // namespace medial_vk
