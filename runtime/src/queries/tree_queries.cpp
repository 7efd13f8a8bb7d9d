#include "queries/tree_queries.h"

#include <array>
#include <cstring>
#include <vector>

#include "device/context_impl.h"
#include "device_commands/commands.h"
#include "tree_types.h"

namespace medial_vk {
namespace {

using gpu::kNoCounter;

constexpr std::uint32_t kResolveGroup = 256;
constexpr VkDeviceSize kTestBytes = 16;
static_assert(gpu::kTriangleTests == gpu::kNodeTests + 2 && gpu::kUnresolvedFirst >= gpu::kTriangleTests + 2);

}  // namespace

Result<TreeQueries> TreeQueries::create(ContextImpl& context, const DeviceMesh& mesh, std::uint32_t capacity,
                                        std::optional<BufferRange> stop, bool counts) {
  TreeQueries queries(context, mesh, counts);
  queries.arena_.expect((VkDeviceSize{gpu::kUnresolvedFirst} + capacity) * 4);
  Result<Buffer> list = queries.arena_.create_buffer((VkDeviceSize{gpu::kUnresolvedFirst} + capacity) * 4,
                                                     MemoryKind::kDevice, "a list of unresolved queries");
  if (!list.ok()) return list.error();
  Result<Buffer> total = queries.arena_.create_buffer(4, MemoryKind::kReadback, "a count of unresolved queries");
  if (!total.ok()) return total.error();
  Buffer never;  // in place of a stop word that is never raised
  if (!stop) {
    Result<Buffer> word = queries.arena_.create_buffer(4, MemoryKind::kDevice, "a word that stays 0");
    if (!word.ok()) return word.error();
    never = word.value();
  }
  queries.stop_ = stop ? *stop : never.range();
  queries.unresolved_ = list.value();
  queries.total_ = total.value();
  auto cleared = run_commands(context, [&](Recorder& r) {
    r.fill(queries.unresolved_, 0, gpu::kUnresolvedFirst * 4, 0);
    if (!stop) r.fill(never, 0, 4, 0);
    return r.status();
  });
  if (!cleared.ok()) return cleared.error();
  return queries;
}

void TreeQueries::record(Recorder& r, const Kernel& kernel, const QueryCount& count, std::span<const BufferRange> own,
                         BufferRange queries, float tolerance) const {
  // A kernel whose count is known to the host receives an arbitrary buffer in place of the counters.
  const BufferRange counters = count.counters != nullptr ? count.counters->range() : mesh_->triangle_info.range();
  std::vector<BufferRange> buffers = {mesh_->storage_of(mesh_->triangles), mesh_->storage_of(mesh_->tree), counters,
                                      unresolved_.range(), queries};
  buffers.insert(buffers.end(), own.begin(), own.end());
  const std::array<VkBufferView, 2> texels = {mesh_->triangle_texels, mesh_->tree_texels};
  gpu::QueryConstants constants = {count.items,      count.counters != nullptr ? count.counter : kNoCounter,
                                   count.multiplier, mesh_->triangle_count,
                                   tolerance,        0};
  const char* suffix = storage_suffix(mesh_->use_texels);
  ProgramKey key{kernel.walk,     static_cast<std::uint32_t>(buffers.size()), 2, sizeof(constants), kWorkgroupSize,
                 kernel.constants};
  key.shader += suffix;
  if (count.arguments != nullptr) {
    record_slices(r, count.slices, [&](std::uint32_t first_group, VkDeviceSize offset) {
      constants.first_group = first_group;
      r.dispatch_indirect(key, buffers, texels, bytes_of(constants), *count.arguments, offset);
    });
    constants.first_group = 0;
  } else {
    r.dispatch(key, buffers, texels, bytes_of(constants), count.items);
    r.barrier();
  }
  key.shader = kernel.resolve;
  key.shader += suffix;
  resolve(r, std::move(key), buffers, bytes_of(constants));
}

void TreeQueries::resolve(Recorder& r, ProgramKey key, std::span<const BufferRange> buffers,
                          std::span<const std::byte> constants) const {
  const std::array<BufferRange, 1> list = {unresolved_.range()};
  r.dispatch({"prepare_resolve", 1, 0, 0, 1, {}}, list, {}, {}, 1);
  r.barrier();
  const std::array<VkBufferView, 2> texels = {mesh_->triangle_texels, mesh_->tree_texels};
  key.workgroup_size = kResolveGroup;
  r.dispatch_indirect(key, buffers, texels, constants, unresolved_, gpu::kUnresolvedGroups * 4);
  r.barrier();
}

void TreeQueries::resolve_closest(Recorder& r, BufferRange queries, BufferRange nearest, BufferRange hits,
                                  Ties ties) const {
  const BufferRange info = mesh_->triangle_info.range();  // also in place of counters, which the kernel does not read
  const std::array<BufferRange, 8> buffers = {mesh_->storage_of(mesh_->triangles),
                                              mesh_->storage_of(mesh_->tree),
                                              info,
                                              unresolved_.range(),
                                              queries,
                                              info,
                                              nearest,
                                              hits};
  const gpu::QueryConstants constants = {0, kNoCounter, 1, mesh_->triangle_count, 0, 0};
  const ProgramKey key{std::string("resolve_closest_points") + storage_suffix(mesh_->use_texels),
                       static_cast<std::uint32_t>(buffers.size()),
                       2,
                       sizeof(constants),
                       kResolveGroup,
                       {static_cast<std::uint32_t>(ties), counts_}};
  resolve(r, key, buffers, bytes_of(constants));
}

void TreeQueries::closest(Recorder& r, const QueryCount& count, BufferRange queries, BufferRange nearest,
                          BufferRange hits, Ties ties) const {
  const std::array<BufferRange, 3> own = {mesh_->triangle_info.range(), nearest, hits};
  record(r, {"find_closest_points", "resolve_closest_points", {static_cast<std::uint32_t>(ties), counts_}}, count, own,
         queries, 0);
}

void TreeQueries::empty(Recorder& r, const QueryCount& count, BufferRange queries, BufferRange empty) const {
  const std::array<BufferRange, 3> own = {mesh_->triangle_info.range(), empty, stop_};
  record(r, {"test_balls", "resolve_balls", {0, counts_}}, count, own, queries, 0);
}

void TreeQueries::winding(Recorder& r, const QueryCount& count, BufferRange queries, BufferRange numbers,
                          float tolerance) const {
  const std::array<BufferRange, 2> own = {numbers, stop_};
  record(r, {"find_winding_numbers", "resolve_winding_numbers", {0, counts_}}, count, own, queries, tolerance);
}

void TreeQueries::clear_tests(Recorder& r) const {
  r.fill(unresolved_, gpu::kNodeTests * 4, kTestBytes, 0);
  r.barrier();
}

void TreeQueries::copy_tests(Recorder& r, const Buffer& to, VkDeviceSize offset) const {
  r.copy(unresolved_, gpu::kNodeTests * 4, to, offset, kTestBytes);
  r.barrier();
}

Result<std::uint32_t> TreeQueries::read_unresolved_total() {
  auto copied = run_commands(*context_, [&](Recorder& r) {
    r.copy(unresolved_, gpu::kUnresolvedTotal * 4, total_, 0, 4);
    r.barrier_to_host();
    return r.status();
  });
  if (!copied.ok()) return copied.error();
  std::uint32_t total = 0;
  std::memcpy(&total, total_.mapped, sizeof(total));
  return total;
}

}  // namespace medial_vk
