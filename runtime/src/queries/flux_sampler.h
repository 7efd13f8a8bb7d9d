// Recording of the average outward flux through many spheres (Sections 2.3.1 and 2.3.2).
#pragma once

#include <cstdint>

#include "queries/packet_queries.h"

namespace medial_vk {

/// The spheres of a dispatch: a number that the host knows, or counters[counter] with dispatch arguments for that
/// number of spheres, for `samples` sample points each (groups of TreeQueries::kWorkgroupSize), and
/// PacketShape::packets(samples) groups for each sphere.
struct SphereCount {
  std::uint32_t spheres = 0;
  const Buffer* counters = nullptr;
  std::uint32_t counter = 0;
  const Buffer* arguments = nullptr;
  VkDeviceSize sphere_arguments = 0;
  VkDeviceSize sample_arguments = 0;
  Slices packets = {};
};

/// Buffers for the samples of the spheres of one dispatch.
class FluxSampler {
 public:
  /// `capacity` sample points. The queries must outlive the object. Errors: kOutOfMemory.
  static Result<FluxSampler> create(ContextImpl& context, const PacketQueries& queries, std::uint32_t capacity);

  /// spheres: vec4, centre and radius (negative: skipped). directions: vec4, `samples` unit vectors. slots: of
  /// make_slots() for the directions.
  /// fluxes: vec4, average outward flux, greatest distance of a sample, number of two-sided fans. Ends with a barrier.
  void record(Recorder& r, const SphereCount& count, std::uint32_t samples, BufferRange spheres, BufferRange directions,
              BufferRange slots, BufferRange fluxes) const;

  /// After record(): the sample points of all spheres, `samples` each, and their nearest points with squared distances.
  BufferRange samples() const { return samples_.range(); }
  BufferRange nearest() const { return nearest_.range(); }

  static constexpr VkDeviceSize kBytesPerSample = 4 * 16 + 2 * 4;

 private:
  explicit FluxSampler(ContextImpl& context, const PacketQueries& queries) : queries_(&queries), arena_(context) {}

  const PacketQueries* queries_;
  Arena arena_;
  Buffer samples_, nearest_, hits_, opposites_, opposite_nearest_, opposite_hits_;
};

}  // namespace medial_vk
