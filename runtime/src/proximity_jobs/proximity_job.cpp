#include <volk.h>

#include "medial_vk/proximity_job.h"

#include <cstddef>
#include <utility>
#include <vector>

#include "base/host_memory.h"
#include "device_commands/commands.h"
#include "proximity_jobs/device_bodies_impl.h"
#include "proximity_jobs/packed_poses.h"

namespace medial_vk {
namespace {

static_assert(sizeof(RecordedPose) == sizeof(gpu::ProximityPose));
static_assert(offsetof(RecordedPose, row_z) == offsetof(gpu::ProximityPose, row_z));
static_assert(offsetof(RecordedPose, a) == offsetof(gpu::ProximityPose, a));
static_assert(offsetof(RecordedPose, reserved) == offsetof(gpu::ProximityPose, inside_error));
static_assert(sizeof(RecordedBounds) == sizeof(gpu::ProximityBounds));
static_assert(offsetof(RecordedBounds, cover_pair) == offsetof(gpu::ProximityBounds, cover_a));
static_assert(offsetof(RecordedBounds, inside_pair) == offsetof(gpu::ProximityBounds, inside_a));

}  // namespace

struct ProximityJob::Impl {
  /// The resources of a recorded sequence, in use until it has finished.
  struct Frame {
    Buffer staged;                       // poses from the host
    std::uint32_t count = 0;             // of them, for the next sequence
    std::unique_ptr<Recorder> recorder;  // keeps its descriptor set: the buffers are always the same
  };

  Impl(DeviceBodiesImpl& of, const ProximityJobOptions& o) : bodies(of), options(o), arena(of.context) {}

  DeviceBodiesImpl& bodies;
  ProximityJobOptions options;
  Arena arena;
  Buffer poses, answers;
  std::vector<Frame> frames;
  std::size_t next = 0;  // the frame that is recorded next

  AnswersOfKernel kind() const { return {.are_verdicts = options.answers == ProximityAnswers::kCollisions}; }
  Status make_buffers();
  Status append(Recorder& r, const Frame& frame, std::uint32_t count) const;
};

Status ProximityJob::Impl::make_buffers() {
  const auto make = [&](VkDeviceSize bytes, MemoryKind memory, Buffer& buffer) -> Status {
    Result<Buffer> made = arena.create_buffer(options.poses * bytes, memory, "poses of a job");
    if (!made.ok()) return made.error();
    buffer = made.value();
    return {};
  };
  constexpr VkDeviceSize kPose = sizeof(gpu::ProximityPose);
  arena.expect(options.poses * (kPose + kind().bytes()));
  if (Status status = make(kPose, MemoryKind::kDevice, poses); !status.ok()) return status;
  if (Status status = make(kind().bytes(), MemoryKind::kDevice, answers); !status.ok()) return status;
  frames.resize(options.frames);
  for (Frame& frame : frames) {
    if (Status status = make(kPose, MemoryKind::kUpload, frame.staged); !status.ok()) return status;
  }
  return {};
}

Status ProximityJob::Impl::append(Recorder& r, const Frame& frame, std::uint32_t count) const {
  r.barrier_to_others();
  if (frame.count > 0) {
    r.copy(frame.staged, 0, poses, 0, VkDeviceSize{frame.count} * sizeof(gpu::ProximityPose));
    r.barrier();
  }
  bodies.record(r, poses, answers, count, kind());
  r.barrier_to_others();
  return r.status();
}

Result<ProximityJob> ProximityJob::create(DeviceBodies& bodies, const ProximityJobOptions& options) {
  if (options.poses == 0 || options.frames == 0)
    return Error{ErrorCode::kUsage, "a recorded job requires `poses` and `frames` of at least 1"};
  return catch_out_of_memory("preparing a job", [&]() -> Result<ProximityJob> {
    auto impl = std::make_unique<Impl>(Internals::of(bodies), options);
    if (Status status = impl->make_buffers(); !status.ok()) return status.error();
    const auto rehearse = [&](Recorder& r) { return impl->append(r, impl->frames.front(), options.poses); };
    if (Status status = make_programs(impl->bodies.context, rehearse); !status.ok()) return status.error();
    return ProximityJob(std::move(impl));
  });
}

ProximityJob::ProximityJob(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ProximityJob::ProximityJob(ProximityJob&&) noexcept = default;
ProximityJob& ProximityJob::operator=(ProximityJob&&) noexcept = default;
ProximityJob::~ProximityJob() = default;

Status ProximityJob::set_poses(std::span<const PosedPair> pairs, const BatchOptions& options) {
  if (pairs.size() > impl_->options.poses) return Error{ErrorCode::kUsage, "there are more `pairs` than `poses`"};
  return catch_out_of_memory("setting poses", [&]() -> Status {
    if (Status status = impl_->bodies.check(pairs); !status.ok()) return status;
    Impl::Frame& frame = impl_->frames[impl_->next];
    const std::span packed(static_cast<gpu::ProximityPose*>(frame.staged.mapped), pairs.size());
    pack_poses(impl_->bodies.bodies, pairs, packed, options.threads);
    frame.count = static_cast<std::uint32_t>(pairs.size());
    return {};
  });
}

Status ProximityJob::record(VkCommandBuffer commands, std::uint32_t count) {
  Impl& job = *impl_;
  if (count > job.options.poses) return Error{ErrorCode::kUsage, "`count` is greater than `poses`"};
  Impl::Frame& frame = job.frames[job.next];
  return catch_out_of_memory("recording a job", [&]() -> Status {
    if (frame.recorder == nullptr) {
      frame.recorder = std::make_unique<Recorder>(job.bodies.context, commands);
      frame.recorder->measure_nothing();
      frame.recorder->keep_sets();
    } else {
      frame.recorder->restart(commands);
    }
    if (Status status = job.append(*frame.recorder, frame, count); !status.ok()) return status;
    frame.count = 0;
    job.next = (job.next + 1) % job.frames.size();
    return {};
  });
}

ProximityBuffers ProximityJob::buffers() const { return {impl_->poses.handle, impl_->answers.handle}; }

}  // namespace medial_vk
