// Batches of poses from the host, and their answers to the host.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "device_commands/commands.h"
#include "device_commands/memory.h"
#include "proximity_jobs/device_bodies_impl.h"

namespace medial_vk {

/// Two batches are in progress at a time, or one where the device is the host's processors. While the device computes
/// one, the host packs the poses of the next and reads the answers of the previous one. Buffers are kept.
class PoseBatches {
 public:
  static constexpr std::uint32_t kMostPoses = 1u << 18;

  /// Of at most `most_poses` each. `shares_memory`: host and device have the same memory, at the same speed, and
  /// nothing is copied where memory can be mapped.
  PoseBatches(DeviceBodiesImpl& bodies, std::uint32_t most_poses, bool shares_memory)
      : bodies_(bodies), most_poses_(most_poses), shares_memory_(shares_memory) {}

  /// Calls read(first, count, answers) for each batch, in order. Blocks until all are answered; after an error nothing
  /// is pending either. Errors: kOutOfMemory, kInternal (device lost).
  using Read = std::function<void(std::size_t first, std::size_t count, const void* answers)>;
  Status run(std::span<const PosedPair> pairs, const AnswersOfKernel& kind, unsigned threads, const Read& read);

 private:
  struct Batch {
    explicit Batch(ContextImpl& context) : arena(context), commands(context) {}
    Arena arena;
    Buffer poses, answers;    // of the device
    Buffer upload, download;  // none where the host uses the others
    Commands commands;
    std::uint32_t capacity = 0;        // poses
    std::size_t first = 0, count = 0;  // of the pending batch; 0: none is
  };
  std::unique_ptr<Batch>& batch(std::size_t number) { return batches_[shares_memory_ ? 0 : number % batches_.size()]; }
  Status make_room(std::unique_ptr<Batch>& batch, std::size_t count) const;
  Status create_buffers(Batch& batch) const;
  Status run_all(std::span<const PosedPair> pairs, const AnswersOfKernel& kind, unsigned threads, const Read& read);
  Status submit(Batch& batch, std::span<const PosedPair> pairs, const AnswersOfKernel& kind, unsigned threads) const;
  static Status complete(Batch& batch, const Read& read);

  DeviceBodiesImpl& bodies_;
  std::uint32_t most_poses_;
  bool shares_memory_;
  std::array<std::unique_ptr<Batch>, 2> batches_;
};

}  // namespace medial_vk
