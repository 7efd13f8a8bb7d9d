#include "query_batches.h"

#include <algorithm>
#include <utility>

#include "context_impl.h"

namespace medial_vk {
namespace {

/// Items of both kinds, one behind the other.
VkDeviceSize second_items_at(std::uint32_t capacity) { return VkDeviceSize{capacity} * QuerySet::kMostItemBytes[0]; }

}  // namespace

QueryBatches::Place::Place(Context::Impl& context)
    : arena(context),
      went_up(context),
      computed(context),
      up(context, Commands::copying_queue(context)),
      compute(context),
      down(context, Commands::copying_queue(context)) {}

Status QueryBatches::create_buffers(Place& place) const {
  const VkDeviceSize c = capacity_;
  constexpr std::array<std::uint32_t, 2> kItem = QuerySet::kMostItemBytes;
  struct Request {
    Buffer* buffer;
    VkDeviceSize bytes;
    MemoryKind kind;
    const char* purpose;
  };
  const auto create = [&place](std::span<const Request> requests) -> Status {
    for (const Request& request : requests) {
      Result<Buffer> made = place.arena.create_buffer(request.bytes, request.kind, request.purpose);
      if (!made.ok()) return made.error();
      *request.buffer = made.value();
    }
    return {};
  };
  const std::array on_device = {Request{&place.asked, c * sizeof(Texel), MemoryKind::kDevice, "queries"},
                                Request{&place.items[0], c * kItem[0], MemoryKind::kDevice, "answers"},
                                Request{&place.items[1], c * kItem[1], MemoryKind::kDevice, "answers"}};
  if (Status status = create(on_device); !status.ok()) return status;
  place.is_shared = shares_memory_ && place.asked.mapped && place.items[0].mapped && place.items[1].mapped;
  if (place.is_shared) return {};
  const std::array on_host = {Request{&place.upload, c * sizeof(Texel), MemoryKind::kUpload, "queries"},
                              Request{&place.download, c * (kItem[0] + kItem[1]), MemoryKind::kReadback, "answers"}};
  return create(on_host);
}

/// Places are made when they are first needed: few queries need one.
Result<QueryBatches::Place*> QueryBatches::place(std::size_t number) {
  std::unique_ptr<Place>& place = places_[number % places_.size()];
  if (place == nullptr) {
    auto made = std::make_unique<Place>(*context_);
    if (Status created = create_buffers(*made); !created.ok()) return created.error();
    for (Semaphore* semaphore : {&made->went_up, &made->computed}) {
      if (!copies_apart(*made)) break;
      if (Status prepared = semaphore->prepare(); !prepared.ok()) return prepared.error();
    }
    place = std::move(made);
  }
  return place.get();
}

bool QueryBatches::copies_apart(const Place& place) const {
  return !place.is_shared && context_->transfer_queue != VK_NULL_HANDLE;
}

Status QueryBatches::run(const QuerySet& queries) {
  // After an error a semaphore may have been signalled for nobody, and a batch may be under way: everything is made
  // anew, once the device has finished.
  const auto start_over = [this] {
    for (const std::unique_ptr<Place>& place : places_) {
      if (place == nullptr) continue;
      for (Commands* commands : {&place->up, &place->compute, &place->down}) static_cast<void>(commands->wait());
    }
    places_ = {};
  };
  try {
    Status status = run_all(queries);
    if (!status.ok()) start_over();
    return status;
  } catch (...) {  // out of host memory
    start_over();
    throw;
  }
}

// A copy down waits on its queue for the kernels before it. So it is submitted after the next copy up, which can go on
// meanwhile.
Status QueryBatches::run_all(const QuerySet& queries) {
  std::size_t number = 0;
  for (std::size_t first = 0; first < queries.count; first += queries.batch, ++number) {
    const Result<Place*> found = place(number);
    if (!found.ok()) return found.error();
    Place& here = *found.value();
    if (Status answered = answer(queries, here); !answered.ok()) return answered;
    here.first = first;
    here.count = std::min(queries.batch, queries.count - first);
    const std::size_t groups = (here.count + queries.group_size - 1) / queries.group_size;
    here.padded = static_cast<std::uint32_t>(groups * queries.group_size);
    if (Status asked = ask(queries, here); !asked.ok()) return asked;
    if (number == 0) continue;
    if (Status down = bring_down(queries, *places_[(number + 1) % 2]); !down.ok()) return down;
  }
  for (std::size_t last = number; last < number + 2; ++last) {
    const std::unique_ptr<Place>& place = places_[last % 2];
    if (place == nullptr) continue;
    if (Status answered = answer(queries, *place); !answered.ok()) return answered;
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
  const bool apart = copies_apart(place);
  const auto copy_up = [&place](Recorder& r) {
    r.copy(place.upload, 0, place.asked, 0, place.padded * sizeof(Texel));
    r.barrier();
  };
  if (apart) {
    if (Status begun = place.up.begin(); !begun.ok()) return begun;
    copy_up(place.up.recorder());
    if (Status submitted = place.up.submit(nullptr, &place.went_up); !submitted.ok()) return submitted;
  }
  if (Status begun = place.compute.begin(); !begun.ok()) return begun;
  Recorder& r = place.compute.recorder();
  if (!apart && !place.is_shared) copy_up(r);
  queries.record(r, place.padded, place.asked, place.items);
  place.state = Place::State::kAsked;
  if (apart) return place.compute.submit(&place.went_up, &place.computed);
  if (!place.is_shared) copy_down(queries, place, r);
  r.barrier_to_host();
  return place.compute.submit(nullptr, nullptr);
}

void QueryBatches::copy_down(const QuerySet& queries, const Place& place, Recorder& r) const {
  const VkDeviceSize count = place.padded;
  r.copy(place.items[0], 0, place.download, 0, count * queries.item_bytes[0]);
  r.copy(place.items[1], 0, place.download, second_items_at(capacity_), count * queries.item_bytes[1]);
}

Status QueryBatches::bring_down(const QuerySet& queries, Place& place) const {
  if (place.state != Place::State::kAsked) return {};
  place.state = Place::State::kComingDown;
  if (!copies_apart(place)) return {};
  if (Status begun = place.down.begin(); !begun.ok()) return begun;
  copy_down(queries, place, place.down.recorder());
  place.down.recorder().barrier_to_host();
  return place.down.submit(&place.computed, nullptr);
}

Status QueryBatches::answer(const QuerySet& queries, Place& place) const {
  if (Status down = bring_down(queries, place); !down.ok()) return down;
  if (place.state == Place::State::kFree) return {};
  for (Commands* commands : {&place.up, &place.compute, &place.down}) {
    if (Status done = commands->wait(); !done.ok()) return done;
  }
  place.state = Place::State::kFree;
  const auto bytes = [](const Buffer& buffer) { return static_cast<const std::byte*>(buffer.mapped); };
  std::array<const std::byte*, 2> items = {bytes(place.items[0]), bytes(place.items[1])};
  if (!place.is_shared) items = {bytes(place.download), bytes(place.download) + second_items_at(capacity_)};
  return queries.read(place.first, place.count, items);
}

}  // namespace medial_vk
