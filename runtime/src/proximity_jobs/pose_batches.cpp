#include "proximity_jobs/pose_batches.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "proximity_jobs/packed_poses.h"

namespace medial_vk {
namespace {

Status create(Arena& arena, Buffer& buffer, VkDeviceSize bytes, MemoryKind kind) {
  Result<Buffer> made = arena.create_buffer(bytes, kind, "poses and their answers");
  if (!made.ok()) return made.error();
  buffer = made.value();
  return {};
}

}  // namespace

Status PoseBatches::create_buffers(Batch& batch) const {
  const VkDeviceSize poses = batch.capacity * sizeof(gpu::ProximityPose),
                     answers = batch.capacity * sizeof(gpu::ProximityBounds);
  batch.arena.expect(poses + answers);
  if (Status s = create(batch.arena, batch.poses, poses, MemoryKind::kDevice); !s.ok()) return s;
  if (Status s = create(batch.arena, batch.answers, answers, MemoryKind::kDevice); !s.ok()) return s;
  if (shares_memory_ && batch.poses.mapped && batch.answers.mapped) return {};
  batch.arena.expect(poses + answers);
  if (Status s = create(batch.arena, batch.upload, poses, MemoryKind::kUpload); !s.ok()) return s;
  return create(batch.arena, batch.download, answers, MemoryKind::kReadback);
}

/// Buffers grow by factors of two, so that a few poses take little memory.
Status PoseBatches::make_room(std::unique_ptr<Batch>& batch, std::size_t count) const {
  if (batch != nullptr && batch->capacity >= count) return {};
  auto made = std::make_unique<Batch>(bodies_.context);
  made->capacity = std::min(most_poses_, static_cast<std::uint32_t>(std::bit_ceil(std::max<std::size_t>(count, 1024))));
  if (Status created = create_buffers(*made); !created.ok()) return created;
  batch = std::move(made);
  return {};
}

Status PoseBatches::run(std::span<const PosedPair> pairs, const AnswersOfKernel& kind, unsigned threads,
                        const Read& read) {
  try {
    Status status = run_all(pairs, kind, threads, read);
    if (!status.ok()) batches_ = {};  // waits for what is pending
    return status;
  } catch (...) {
    batches_ = {};
    throw;
  }
}

Status PoseBatches::run_all(std::span<const PosedPair> pairs, const AnswersOfKernel& kind, unsigned threads,
                            const Read& read) {
  std::size_t number = 0;
  for (std::size_t first = 0; first < pairs.size(); first += most_poses_, ++number) {
    const std::size_t count = std::min<std::size_t>(most_poses_, pairs.size() - first);
    std::unique_ptr<Batch>& here = batch(number);
    if (here != nullptr) {
      if (Status answered = complete(*here, read); !answered.ok()) return answered;
    }
    if (Status made = make_room(here, count); !made.ok()) return made;
    here->first = first;
    if (Status sent = submit(*here, pairs.subspan(first, count), kind, threads); !sent.ok()) return sent;
  }
  for (std::size_t last = number; last < number + batches_.size(); ++last) {
    const std::unique_ptr<Batch>& batch = batches_[last % batches_.size()];
    if (batch == nullptr) continue;
    if (Status answered = complete(*batch, read); !answered.ok()) return answered;
  }
  return {};
}

Status PoseBatches::submit(Batch& batch, std::span<const PosedPair> pairs, const AnswersOfKernel& kind,
                           unsigned threads) const {
  const bool copies = batch.upload.handle != VK_NULL_HANDLE;
  auto* packed = static_cast<gpu::ProximityPose*>((copies ? batch.upload : batch.poses).mapped);
  pack_poses(bodies_.bodies, pairs, {packed, pairs.size()}, threads);
  if (Status begun = batch.commands.begin(); !begun.ok()) return begun;
  Recorder& r = batch.commands.recorder();
  if (copies) {
    r.copy(batch.upload, 0, batch.poses, 0, pairs.size() * sizeof(gpu::ProximityPose));
    r.barrier();
  }
  bodies_.record(r, batch.poses, batch.answers, static_cast<std::uint32_t>(pairs.size()), kind);
  if (copies) {
    r.barrier();
    r.copy(batch.answers, 0, batch.download, 0, pairs.size() * kind.bytes());
  }
  r.barrier_to_host();
  batch.count = pairs.size();
  return batch.commands.submit(nullptr, nullptr);
}

Status PoseBatches::complete(Batch& batch, const Read& read) {
  if (batch.count == 0) return {};
  if (Status done = batch.commands.wait(); !done.ok()) return done;
  const bool copies = batch.download.handle != VK_NULL_HANDLE;
  read(batch.first, batch.count, (copies ? batch.download : batch.answers).mapped);
  batch.count = 0;
  return {};
}

}  // namespace medial_vk
