#include "queries/packet_queries.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include "base/point_ops.h"
#include "device/context_impl.h"
#include "tree_types.h"

namespace medial_vk {
namespace {

/// Distributes `positions` to the lanes of `room` by recursive halving of both.
void fill_lanes(std::span<const Point> group, std::span<std::uint32_t> positions, std::span<std::uint32_t> room,
                std::uint32_t per_lane) {
  if (room.size() <= per_lane) {
    std::copy(positions.begin(), positions.end(), room.begin());
    return;
  }
  const std::size_t low_lanes = room.size() / per_lane / 2, lanes = room.size() / per_lane;
  const std::size_t low = positions.size() * low_lanes / lanes;
  if (!group.empty() && !positions.empty()) {
    Point lower = group[positions[0]], upper = lower;
    for (const std::uint32_t p : positions) {
      lower = least(lower, group[p]);
      upper = greatest(upper, group[p]);
    }
    const Point sides = upper - lower;
    const auto axis = static_cast<std::size_t>(std::max_element(sides.begin(), sides.end()) - sides.begin());
    std::sort(positions.begin(), positions.end(), [&](std::uint32_t a, std::uint32_t b) {
      return group[a][axis] != group[b][axis] ? group[a][axis] < group[b][axis] : a < b;
    });
  }
  fill_lanes(group, positions.first(low), room.first(low_lanes * per_lane), per_lane);
  fill_lanes(group, positions.subspan(low), room.subspan(low_lanes * per_lane), per_lane);
}

std::vector<std::uint32_t> fill_slots(const PacketShape& shape, std::span<const Point> group,
                                      std::uint32_t group_size) {
  std::vector<std::uint32_t> positions(group_size);
  std::iota(positions.begin(), positions.end(), 0u);
  std::vector<std::uint32_t> slots(std::size_t{shape.packets(group_size)} * shape.slots(), kNoPoint);
  fill_lanes(group, positions, slots, shape.per_lane);
  return slots;
}

}  // namespace

std::vector<std::uint32_t> make_slots(const PacketShape& shape, std::span<const Point> group) {
  return fill_slots(shape, group, static_cast<std::uint32_t>(group.size()));
}
std::vector<std::uint32_t> make_slots(const PacketShape& shape, std::uint32_t group_size) {
  return fill_slots(shape, {}, group_size);
}

PacketShape PacketShape::of(std::uint32_t width, bool through_shared_memory, std::uint32_t points) {
  return {width, (points + width - 1) / width, through_shared_memory};
}

PacketShape PacketShape::best_for(const ContextImpl& context) {
  constexpr VkSubgroupFeatureFlags kNeeded =
      VK_SUBGROUP_FEATURE_BASIC_BIT | VK_SUBGROUP_FEATURE_BALLOT_BIT | VK_SUBGROUP_FEATURE_SHUFFLE_BIT;
  const VkPhysicalDeviceSubgroupProperties& subgroup = context.subgroup;
  const bool capable = (subgroup.supportedOperations & kNeeded) == kNeeded &&
                       (subgroup.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0;
  const std::uint32_t width = subgroup.subgroupSize;
  const bool fitting = width >= 4 && width <= 64 && std::has_single_bit(width);
  return capable && fitting ? of(width, false) : of(32, true);
}

Result<PacketQueries> PacketQueries::create(ContextImpl& context, const DeviceMesh& device, std::uint32_t capacity,
                                            const PacketShape& shape, bool counts) {
  PacketQueries queries(device, shape, counts);
  Result<PacketTree> tree = PacketTree::create(context, device, shape.arity());
  if (!tree.ok()) return tree.error();
  Result<TreeQueries> resolver = TreeQueries::create(context, device, capacity, {}, counts);
  if (!resolver.ok()) return resolver.error();
  queries.tree_ = std::make_unique<PacketTree>(std::move(tree).value());
  queries.resolver_ = std::make_unique<TreeQueries>(std::move(resolver).value());
  return queries;
}

void PacketQueries::closest(Recorder& r, const GroupCount& count, BufferRange slots, BufferRange queries,
                            BufferRange nearest, BufferRange hits, TreeQueries::Ties ties) const {
  const bool counted = count.counters != nullptr;
  gpu::QueryConstants constants = {
      count.groups, counted ? count.counter : gpu::kNoCounter, count.group_size, device_->triangle_count, 0, 0};
  const BufferRange order = device_->triangle_info.range();
  // A kernel whose count is known to the host receives an arbitrary buffer in place of the counters.
  const std::array<BufferRange, 11> buffers = {device_->triangles.storage_range(tree_->use_texels),
                                               tree_->nodes.storage_range(tree_->use_texels),
                                               counted ? count.counters->range() : order,
                                               resolver_->unresolved(),
                                               queries,
                                               order,
                                               nearest,
                                               hits,
                                               tree_->frames.storage_range(tree_->use_texels),
                                               slots,
                                               tree_->positions.range()};
  const std::array<VkBufferView, 3> texels = {device_->triangle_texels, tree_->node_texels, tree_->frame_texels};
  const std::string shader =
      shape_.through_shared_memory ? "find_closest_in_packets_shared" : "find_closest_in_packets";
  const ProgramKey key{shader + storage_suffix(tree_->use_texels),
                       static_cast<std::uint32_t>(buffers.size()),
                       static_cast<std::uint32_t>(texels.size()),
                       sizeof(constants),
                       shape_.width,
                       {static_cast<std::uint32_t>(ties), shape_.per_lane, shape_.arity(), counts_}};
  if (counted) {
    record_slices(r, count.slices, [&](std::uint32_t first_group, VkDeviceSize offset) {
      constants.first_group = first_group;
      r.dispatch_indirect(key, buffers, texels, bytes_of(constants), *count.arguments, offset);
    });
  } else {
    const std::uint64_t teams = std::uint64_t{count.groups} * shape_.packets(count.group_size);
    r.dispatch(key, buffers, texels, bytes_of(constants), teams * shape_.width);
    r.barrier();
  }
  resolver_->resolve_closest(r, queries, nearest, hits, ties);
}

}  // namespace medial_vk
