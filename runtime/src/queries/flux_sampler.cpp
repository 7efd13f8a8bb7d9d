#include "queries/flux_sampler.h"

#include <array>

#include "device/context_impl.h"
#include "tree_types.h"

namespace medial_vk {
namespace {

using gpu::kNoCounter;

// Along an edge, or from an edge to its end, a nearest point is only as accurate as squares can be distinguished:
// sqrt(2^-22) of its distance. A fan's two directions are compared within twice that; those of different features
// differ by more unless a smooth surface has millions of triangles, and then their flux hardly does.
constexpr float kSameDirection = 1e-3f;

}  // namespace

Result<FluxSampler> FluxSampler::create(ContextImpl& context, const PacketQueries& queries, std::uint32_t capacity) {
  FluxSampler sampler(context, queries);
  struct Request {
    Buffer* buffer;
    VkDeviceSize stride;
    const char* purpose;
  };
  const VkDeviceSize count = capacity;
  sampler.arena_.expect(count * kBytesPerSample);
  for (const Request& request : {Request{&sampler.samples_, 16, "flux samples"},
                                 Request{&sampler.nearest_, 16, "nearest points of flux samples"},
                                 Request{&sampler.hits_, 4, "triangles of flux samples"},
                                 Request{&sampler.opposites_, 16, "opposites of flux samples"},
                                 Request{&sampler.opposite_nearest_, 16, "nearest points of opposites"},
                                 Request{&sampler.opposite_hits_, 4, "triangles of opposites"}}) {
    Result<Buffer> buffer = sampler.arena_.create_buffer(count * request.stride, MemoryKind::kDevice, request.purpose);
    if (!buffer.ok()) return buffer.error();
    *request.buffer = buffer.value();
  }
  return sampler;
}

void FluxSampler::record(Recorder& r, const SphereCount& count, std::uint32_t samples, BufferRange spheres,
                         BufferRange directions, BufferRange slots, BufferRange fluxes) const {
  const bool counted = count.counters != nullptr;
  const gpu::SampleConstants constants = {count.spheres, counted ? count.counter : kNoCounter, samples, kSameDirection};
  // A kernel whose count is known to the host receives an arbitrary buffer in place of the counters.
  const BufferRange counters = counted ? count.counters->range() : samples_.range();
  const auto run = [&](const char* shader, std::span<const BufferRange> buffers, bool per_sample) {
    const ProgramKey key{
        shader, static_cast<std::uint32_t>(buffers.size()), 0, sizeof(constants), TreeQueries::kWorkgroupSize, {}};
    if (counted) {
      r.dispatch_indirect(key, buffers, {}, bytes_of(constants), *count.arguments,
                          per_sample ? count.sample_arguments : count.sphere_arguments);
    } else {
      r.dispatch(key, buffers, {}, bytes_of(constants), std::uint64_t{count.spheres} * (per_sample ? samples : 1));
    }
    r.barrier();
  };
  const GroupCount groups = {count.spheres, samples, count.counters, count.counter, count.arguments, count.packets};

  const std::array<BufferRange, 4> place = {counters, spheres, directions, samples_.range()};
  run("place_sphere_samples", place, true);
  queries_->closest(r, groups, slots, samples_.range(), nearest_.range(), hits_.range());
  const std::array<BufferRange, 6> reflect = {counters,         spheres,       samples_.range(),
                                              nearest_.range(), hits_.range(), opposites_.range()};
  run("reflect_sphere_samples", reflect, true);
  queries_->closest(r, groups, slots, opposites_.range(), opposite_nearest_.range(), opposite_hits_.range());
  const std::array<BufferRange, 7> sum = {
      counters, spheres, samples_.range(), nearest_.range(), opposites_.range(), opposite_nearest_.range(), fluxes};
  run("sum_flux", sum, false);
}

}  // namespace medial_vk
