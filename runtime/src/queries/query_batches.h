// Batches of queries from the host, and their answers to the host.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "device/internals.h"
#include "device_commands/commands.h"
#include "device_commands/memory.h"
#include "device_mesh/device_tree.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// A set of queries. A query is a texel; an answer is one item or two, in a buffer each.
struct QuerySet {
  static constexpr std::array<std::uint32_t, 2> kMostItemBytes = {16, 4};

  std::size_t count = 0;
  std::size_t batch = 0;         // queries of a submission: a multiple of group_size, at most the capacity
  std::uint32_t group_size = 1;  // the last batch is padded to a multiple of this, with queries to be skipped
  std::array<std::uint32_t, 2> item_bytes = {0, 0};
  /// Queries [first, first + out.size()). Error: one of them is invalid.
  std::function<Status(std::size_t first, std::span<Texel> out)> write;
  /// Records the kernels for `count` queries, padding included, with a barrier behind the last.
  std::function<void(Recorder& r, std::uint32_t count, const Buffer& queries, std::span<const Buffer, 2> items)> record;
  /// Answers of [first, first + count). Error: one is missing.
  std::function<Status(std::size_t first, std::size_t count, std::span<const std::byte* const, 2> items)> read;
};

/// Two batches are in progress at a time, or one where the device is the host's processors. While the device computes
/// one, the host reads the previous one and writes the next; if there are several and the device has a queue for
/// transfers, downloads and uploads run meanwhile. Buffers are kept (for two batches after the first run with two),
/// some 25 MiB for each batch of 262,144 queries (lavapipe: 16), because new memory would cost as much time as the
/// queries.
class QueryBatches {
 public:
  /// For batches of at most `capacity` queries. `shares_memory`: host and device have the same memory, at the same
  /// speed, and nothing is copied where memory can be mapped.
  QueryBatches(ContextImpl& context, std::uint32_t capacity, bool shares_memory)
      : context_(&context), capacity_(capacity), shares_memory_(shares_memory) {}

  /// Blocks until all are answered; after an error nothing is pending either. Errors: kOutOfMemory, kInternal (device
  /// lost; batches or items that are too large), and those of `write` and `read`.
  Status run(const QuerySet& queries);

 private:
  /// The resources of a batch.
  struct Batch {
    explicit Batch(ContextImpl& context);
    Arena on_device, for_upload, for_download;  // separate, as blocks of an arena grow: none takes more than it needs
    Buffer queries;
    std::array<Buffer, 2> items;
    Buffer upload, download;  // none where the host uses the others
    bool is_shared = false;
    bool is_apart = false;  // of the current run: transfers are on their own queue
    Semaphore uploaded, computed;
    // Run one after the other; without a separate queue the middle one has all commands, and the others are unused.
    Commands upload_commands, compute, download_commands;
    enum class State { kFree, kSubmitted, kDownloading } state = State::kFree;
    std::size_t first = 0, count = 0;
    std::uint32_t padded = 0;
  };
  Status check(const QuerySet& queries) const;
  Result<Batch*> batch(std::size_t number);
  Status create_buffers(Batch& batch) const;
  void start_over() noexcept;
  Status run_all(const QuerySet& queries);
  Status submit(const QuerySet& queries, Batch& batch) const;
  Status write(const QuerySet& queries, const Batch& batch) const;
  void record_download(const QuerySet& queries, const Batch& batch, Recorder& r) const;
  Status submit_download(const QuerySet& queries, Batch& batch) const;
  Status complete(const QuerySet& queries, Batch& batch) const;
  std::size_t at_once() const { return shares_memory_ ? 1 : batches_.size(); }

  ContextImpl* context_;
  std::uint32_t capacity_;
  bool shares_memory_;
  std::array<std::unique_ptr<Batch>, 2> batches_;
};

}  // namespace medial_vk
