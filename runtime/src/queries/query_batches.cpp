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

QueryBatches::Place::Place(Context::Impl& context)
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

Status QueryBatches::create_buffers(Place& place) const {
  const VkDeviceSize c = capacity_;
  constexpr std::array<std::uint32_t, 2> kItem = QuerySet::kMostItemBytes;
  const auto create = [](Arena& arena, Buffer& buffer, VkDeviceSize bytes, MemoryKind kind) -> Status {
    Result<Buffer> made = arena.create_buffer(bytes, kind, "queries and their answers");
    if (!made.ok()) return made.error();
    buffer = made.value();
    return {};
  };
  constexpr MemoryKind kDevice = MemoryKind::kDevice;
  if (Status s = create(place.on_device, place.asked, c * sizeof(Texel), kDevice); !s.ok()) return s;
  for (std::size_t i = 0; i < kItem.size(); ++i)
    if (Status s = create(place.on_device, place.items[i], c * kItem[i], kDevice); !s.ok()) return s;
  place.is_shared = shares_memory_ && place.asked.mapped && place.items[0].mapped && place.items[1].mapped;
  if (place.is_shared) return {};
  if (Status s = create(place.for_upload, place.upload, c * sizeof(Texel), MemoryKind::kUpload); !s.ok()) return s;
  return create(place.for_download, place.download, c * (kItem[0] + kItem[1]), MemoryKind::kReadback);
}

/// Sets of resources are created at their first use: few queries need only one.
Result<QueryBatches::Place*> QueryBatches::place(std::size_t number) {
  std::unique_ptr<Place>& place = places_[number % at_once()];
  if (place == nullptr) {
    auto made = std::make_unique<Place>(*context_);
    if (Status created = create_buffers(*made); !created.ok()) return created.error();
    place = std::move(made);
  }
  return place.get();
}

/// After an error a semaphore may have been signalled without a wait, and a batch may be pending.
void QueryBatches::start_over() noexcept {
  for (const std::unique_ptr<Place>& place : places_) {
    if (place == nullptr) continue;
    for (Commands* commands : {&place->upload_commands, &place->compute, &place->download_commands}) commands->drain();
  }
  places_ = {};
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
    const Result<Place*> found = place(number);
    if (!found.ok()) return found.error();
    Place& here = *found.value();
    if (Status answered = complete(queries, here); !answered.ok()) return answered;
    here.first = first;
    here.count = std::min(queries.batch, queries.count - first);
    const std::size_t groups = (here.count + queries.group_size - 1) / queries.group_size;
    here.padded = static_cast<std::uint32_t>(groups * queries.group_size);
    if (Status asked = ask(queries, here); !asked.ok()) return asked;
    if (number == 0) continue;
    if (Status down = submit_download(queries, *places_[(number - 1) % at_once()]); !down.ok()) return down;
  }
  for (std::size_t last = number; last < number + at_once(); ++last) {
    const std::unique_ptr<Place>& place = places_[last % at_once()];
    if (place == nullptr) continue;
    if (Status answered = complete(queries, *place); !answered.ok()) return answered;
  }
  return {};
}

Status QueryBatches::write(const QuerySet& queries, const Place& place) const {
  auto* out = static_cast<Texel*>((place.is_shared ? place.asked : place.upload).mapped);
  std::fill(out + place.count, out + place.padded, Texel{0, 0, 0, -1});
  return queries.write(place.first, {out, place.count});
}

Status QueryBatches::ask(const QuerySet& queries, Place& place) const {
  if (Status written = write(queries, place); !written.ok()) return written;
  // A single batch has nothing to overlap with: one submission suffices.
  place.is_apart = !place.is_shared && context_->transfer_queue != VK_NULL_HANDLE && queries.count > queries.batch;
  const auto record_upload = [&place](Recorder& r) {
    r.copy(place.upload, 0, place.asked, 0, place.padded * sizeof(Texel));
    r.barrier();
  };
  if (place.is_apart) {
    for (Semaphore* semaphore : {&place.uploaded, &place.computed})
      if (Status prepared = semaphore->prepare(); !prepared.ok()) return prepared;
    if (Status begun = place.upload_commands.begin(); !begun.ok()) return begun;
    record_upload(place.upload_commands.recorder());
    if (Status submitted = place.upload_commands.submit(nullptr, &place.uploaded); !submitted.ok()) return submitted;
  }
  if (Status begun = place.compute.begin(); !begun.ok()) return begun;
  Recorder& r = place.compute.recorder();
  if (!place.is_apart && !place.is_shared) record_upload(r);
  queries.record(r, place.padded, place.asked, place.items);
  place.state = Place::State::kAsked;
  if (place.is_apart) return place.compute.submit(&place.uploaded, &place.computed);
  if (!place.is_shared) record_download(queries, place, r);
  r.barrier_to_host();
  return place.compute.submit(nullptr, nullptr);
}

void QueryBatches::record_download(const QuerySet& queries, const Place& place, Recorder& r) const {
  const VkDeviceSize count = place.padded;
  r.copy(place.items[0], 0, place.download, 0, count * queries.item_bytes[0]);
  r.copy(place.items[1], 0, place.download, second_items_at(capacity_), count * queries.item_bytes[1]);
}

Status QueryBatches::submit_download(const QuerySet& queries, Place& place) const {
  if (place.state != Place::State::kAsked) return {};
  place.state = Place::State::kDownloading;
  if (!place.is_apart) return {};
  if (Status begun = place.download_commands.begin(); !begun.ok()) return begun;
  record_download(queries, place, place.download_commands.recorder());
  place.download_commands.recorder().barrier_to_host();
  return place.download_commands.submit(&place.computed, nullptr);
}

Status QueryBatches::complete(const QuerySet& queries, Place& place) const {
  if (Status down = submit_download(queries, place); !down.ok()) return down;
  if (place.state == Place::State::kFree) return {};
  for (Commands* commands : {&place.upload_commands, &place.compute, &place.download_commands}) {
    if (Status done = commands->wait(); !done.ok()) return done;
  }
  place.state = Place::State::kFree;
  const auto bytes = [](const Buffer& buffer) { return static_cast<const std::byte*>(buffer.mapped); };
  std::array<const std::byte*, 2> items = {bytes(place.items[0]), bytes(place.items[1])};
  if (!place.is_shared) items = {bytes(place.download), bytes(place.download) + second_items_at(capacity_)};
  return queries.read(place.first, place.count, items);
}

}  // namespace medial_vk
