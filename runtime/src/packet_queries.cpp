#include "packet_queries.h"

#include <array>
#include <bit>

#include "context_impl.h"
#include "tree_types.h"

namespace medial_vk {

PacketShape PacketShape::of(std::uint32_t width, bool through_shared_memory, std::uint32_t points) {
  return {width, (points + width - 1) / width, through_shared_memory};
}

PacketShape PacketShape::best_for(const Context::Impl& context) {
  constexpr VkSubgroupFeatureFlags kNeeded = VK_SUBGROUP_FEATURE_BASIC_BIT | VK_SUBGROUP_FEATURE_BALLOT_BIT |
                                             VK_SUBGROUP_FEATURE_SHUFFLE_BIT;
  const VkPhysicalDeviceSubgroupProperties& subgroup = context.subgroup;
  const bool capable = (subgroup.supportedOperations & kNeeded) == kNeeded &&
                       (subgroup.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0;
  const std::uint32_t width = subgroup.subgroupSize;
  const bool fitting = width >= 4 && width <= 64 && std::has_single_bit(width);
  return capable && fitting ? of(width, false) : of(32, true);
}

Result<PacketQueries> PacketQueries::create(Context::Impl& context, const DeviceMesh& device, const MeshView& mesh,
                                            std::uint32_t capacity, const PacketShape& shape) {
  PacketQueries queries(device, shape);
  Result<PacketTree> tree = PacketTree::create(context, device, mesh, shape.arity());
  if (!tree.ok()) return tree.error();
  Result<TreeQueries> resolver = TreeQueries::create(context, device, capacity);
  if (!resolver.ok()) return resolver.error();
  queries.tree_ = std::make_unique<PacketTree>(std::move(tree).value());
  queries.resolver_ = std::make_unique<TreeQueries>(std::move(resolver).value());
  return queries;
}

void PacketQueries::closest(Recorder& r, const GroupCount& count, BufferRange queries, BufferRange nearest,
                            BufferRange hits, TreeQueries::Ties ties) const {
  const bool counted = count.counters != nullptr;
  const gpu::QueryConstants constants = {count.groups, counted ? count.counter : gpu::kNoCounter, count.group_size,
                                         device_->triangle_count, 0};
  const BufferRange order = device_->triangle_info.range();
  // A kernel that does not count on the device is given some buffer in place of the counters.
  const std::array<BufferRange, 9> buffers = {device_->triangles.range(),
                                              tree_->nodes.range(),
                                              counted ? count.counters->range() : order,
                                              resolver_->unresolved(),
                                              queries,
                                              order,
                                              nearest,
                                              hits,
                                              tree_->frames.range()};
  const std::array<VkBufferView, 3> texels = {device_->triangle_texels, tree_->node_texels, tree_->frame_texels};
  const ProgramKey key{
      shape_.through_shared_memory ? "find_closest_in_packets_shared" : "find_closest_in_packets",
      static_cast<std::uint32_t>(buffers.size()),
      static_cast<std::uint32_t>(texels.size()),
      sizeof(constants),
      shape_.width,
      {tree_->use_texels ? 1u : 0u, static_cast<std::uint32_t>(ties), shape_.per_lane, shape_.arity()}};
  if (counted) {
    r.dispatch_indirect(key, buffers, texels, bytes_of(constants), *count.arguments, count.arguments_offset);
  } else {
    const std::uint64_t teams = std::uint64_t{count.groups} * packets(count.group_size);
    r.dispatch(key, buffers, texels, bytes_of(constants), teams * shape_.width);
  }
  r.barrier();
  resolver_->resolve_closest(r, queries, nearest, hits, ties);
}

}  // namespace medial_vk
