#include <volk.h>

#include "medial_vk/extraction_job.h"

#include <cstddef>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

#include "base/host_memory.h"
#include "device/context_impl.h"
#include "device_commands/commands.h"
#include "device_mesh/device_mesh.h"
#include "extraction/certified/certified_pipeline.h"
#include "extraction/common/check_options.h"
#include "extraction/common/extraction_result.h"

namespace medial_vk {
namespace {

static_assert(sizeof(RecordedSphere) == sizeof(gpu::FoundPoint));
static_assert(offsetof(RecordedSphere, radius) == offsetof(gpu::FoundPoint, centre) + 12);
static_assert(offsetof(RecordedSphere, object_angle) == offsetof(gpu::FoundPoint, spoke_a) + 12);
static_assert(offsetof(RecordedSphere, flux) == offsetof(gpu::FoundPoint, spoke_b) + 12);
static_assert(offsetof(RecordedSphere, voxel) == offsetof(gpu::FoundPoint, voxel_x));

/// RecordedCounts, and the overflow word of the pipeline.
constexpr VkDeviceSize kCountsBytes = sizeof(RecordedCounts) + 8;

/// Bytes in host memory for the copies with which a recorded sequence starts.
class StagedMesh {
 public:
  explicit StagedMesh(ContextImpl& context) : arena_(context) {}

  Status reserve(VkDeviceSize bytes) {
    Result<Buffer> made = arena_.create_buffer(bytes, MemoryKind::kUpload, "positions that have moved");
    if (!made.ok()) return made.error();
    memory_ = made.value();
    return {};
  }
  void clear() {
    copies_.clear();
    used_ = 0;
  }
  bool empty() const { return copies_.empty(); }

  Status add(const Buffer& to, std::span<const std::byte> bytes) {
    if (bytes.size() > memory_.size - used_)
      return Error{ErrorCode::kInternal, "the mesh takes more memory than when its job was made"};
    std::memcpy(static_cast<std::byte*>(memory_.mapped) + used_, bytes.data(), bytes.size());
    copies_.push_back({to, used_, bytes.size()});
    used_ += bytes.size();
    return {};
  }

  void record(Recorder& r) const {
    for (const Copy& copy : copies_) r.copy(memory_, copy.offset, copy.to, 0, copy.bytes);
    r.barrier();
  }

 private:
  struct Copy {
    Buffer to;
    VkDeviceSize offset, bytes;
  };
  Arena arena_;
  Buffer memory_;
  VkDeviceSize used_ = 0;
  std::vector<Copy> copies_;
};

}  // namespace

struct ExtractionJob::Impl {
  /// The resources of a recorded sequence, in use until it has finished.
  struct Frame {
    explicit Frame(ContextImpl& context) : staged(context) {}
    StagedMesh staged;
    Buffer counts;  // for the host
    std::unique_ptr<Recorder> recorder;
  };

  Impl(ContextImpl& c, const ExtractionOptions& p, const JobOptions& o, StopWord s, DeviceMesh m)
      : context(c), options(p), job(o), stop(std::move(s)), mesh(std::move(m)), arena(c) {}

  ContextImpl& context;
  ExtractionOptions options;
  JobOptions job;
  StopWord stop;  // never raised
  DeviceMesh mesh;
  Arena arena;
  std::optional<CertifiedPipeline> pipeline;
  Buffer counts;  // for the device
  std::vector<Frame> frames;
  std::size_t next = 0;  // the frame that is recorded next
  Placement recorded;    // that of the last recorded sequence

  Status prepare();
  Status make_buffers();
  Status append(Recorder& r, const Frame& frame);
};

Status ExtractionJob::Impl::prepare() {
  const std::uint32_t n = options.resolution;
  // Memory for any shape of the box, as the mesh moves.
  Result<CertifiedPipeline> made = CertifiedPipeline::create(context, mesh, options, {n, n, n}, stop);
  if (!made.ok()) return made.error();
  pipeline.emplace(std::move(made).value());
  if (Status status = make_buffers(); !status.ok()) return status;
  return make_programs(context, [this](Recorder& r) { return append(r, frames.front()); });
}

Status ExtractionJob::Impl::make_buffers() {
  Result<Buffer> shared = arena.create_buffer(kCountsBytes, MemoryKind::kDevice, "counts of a job");
  if (!shared.ok()) return shared.error();
  counts = shared.value();
  frames.reserve(job.frames);
  for (std::uint32_t i = 0; i < job.frames; ++i) {
    Frame& frame = frames.emplace_back(context);
    if (Status status = frame.staged.reserve(mesh.update_bytes()); !status.ok()) return status;
    Result<Buffer> own = arena.create_buffer(kCountsBytes, MemoryKind::kReadback, "counts of a job");
    if (!own.ok()) return own.error();
    frame.counts = own.value();
    std::memset(frame.counts.mapped, 0, kCountsBytes);
  }
  return {};
}

Status ExtractionJob::Impl::append(Recorder& r, const Frame& frame) {
  r.barrier_to_others();
  if (!frame.staged.empty()) frame.staged.record(r);
  pipeline->set_grid(make_grid(mesh, options.resolution).size);
  if (Status status = pipeline->record(r, 0, pipeline->top_cells()); !status.ok()) return status;
  const BufferRange buffers[] = {pipeline->counters().range(), counts.range()};
  r.dispatch({"write_counts", 2, 0, 4, 1, {}}, buffers, {}, bytes_of(job.vertices_per_sphere), 1);
  r.barrier();
  r.copy(counts, 0, frame.counts, 0, kCountsBytes);
  r.barrier_to_others();
  r.barrier_to_host();
  return r.status();
}

Result<ExtractionJob> ExtractionJob::create(Context& context, const IndexedMesh& mesh, const ExtractionOptions& options,
                                            const JobOptions& job) {
  if (Status status = check_options(options); !status.ok()) return status.error();
  if (options.mode != Mode::kCertified || job.frames == 0)
    return Error{ErrorCode::kUsage, "a recorded job requires `mode` certified, and `frames` of at least 1"};
  return catch_out_of_memory("preparing a job", [&]() -> Result<ExtractionJob> {
    const ThreadsOfCall threads(Internals::of(context), options.threads);
    Result<StopWord> stop = StopWord::create(Internals::of(context));
    if (!stop.ok()) return stop.error();
    Result<DeviceMesh> device = DeviceMesh::create(Internals::of(context), mesh, true);
    if (!device.ok()) return device.error();
    if (Status status = device.value().finish_uploads(); !status.ok()) return status.error();
    auto impl = std::make_unique<Impl>(Internals::of(context), options, job, std::move(stop).value(),
                                       std::move(device).value());
    if (Status status = impl->prepare(); !status.ok()) return status.error();
    return ExtractionJob(std::move(impl));
  });
}

ExtractionJob::ExtractionJob(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ExtractionJob::ExtractionJob(ExtractionJob&&) noexcept = default;
ExtractionJob& ExtractionJob::operator=(ExtractionJob&&) noexcept = default;
ExtractionJob::~ExtractionJob() = default;

Status ExtractionJob::update(const IndexedMesh& moved) {
  StagedMesh& staged = impl_->frames[impl_->next].staged;
  if (!staged.empty()) return Error{ErrorCode::kUsage, "the mesh was moved already; record() comes first"};
  Status status = catch_out_of_memory("moving a mesh", [&] {
    return impl_->mesh.update(
        moved, [&](const Buffer& to, std::span<const std::byte> bytes) { return staged.add(to, bytes); });
  });
  if (!status.ok()) staged.clear();  // also if memory ran out: the next update starts again
  return status;
}

Status ExtractionJob::record(VkCommandBuffer commands) {
  Impl& job = *impl_;
  Impl::Frame& frame = job.frames[job.next];
  return catch_out_of_memory("recording a job", [&]() -> Status {
    if (!job.mesh.intact)
      return Error{ErrorCode::kInvalidMesh, "the last move left the mesh without extent; move its vertices again"};
    frame.recorder = std::make_unique<Recorder>(job.context, commands);
    frame.recorder->measure_nothing();
    if (Status status = job.append(*frame.recorder, frame); !status.ok()) return status;
    frame.staged.clear();
    job.recorded = {job.mesh.lower, job.mesh.longest};
    job.next = (job.next + 1) % job.frames.size();
    return {};
  });
}

JobBuffers ExtractionJob::buffers() const {
  const Buffer& spheres = impl_->pipeline->result();
  return {spheres.handle, spheres.size, impl_->counts.handle};
}

Placement ExtractionJob::placement() const { return impl_->recorded; }

RecordedCounts ExtractionJob::counts() {
  RecordedCounts counts;
  std::uint32_t overflow = 0;
  auto* memory = static_cast<std::byte*>(impl_->frames[impl_->next].counts.mapped);
  std::memcpy(&counts, memory, sizeof(counts));
  std::memcpy(&overflow, memory + sizeof(counts), sizeof(overflow));
  if (overflow == gpu::kTooFewRounds) impl_->pipeline->add_rounds();
  std::memset(memory + sizeof(counts), 0, sizeof(overflow));  // once for every sequence
  return counts;
}

}  // namespace medial_vk
