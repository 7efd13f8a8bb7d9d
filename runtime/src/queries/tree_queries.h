// Recording of the kernels that answer one query per invocation by walking the tree of a DeviceMesh.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "device_commands/recorder.h"
#include "device_mesh/device_mesh.h"

namespace medial_vk {

/// A sequence of short dispatches for a number of workgroups that only the device knows, between which the device can
/// stop. `prepare` records the computation of the group counts of slice k, for workgroups k * groups to (k + 1) *
/// groups of all, and returns their position among the arguments.
struct Slices {
  std::uint32_t count = 0;
  std::uint32_t groups = 0;
  std::function<VkDeviceSize(Recorder&, std::uint32_t k)> prepare = {};
};

/// Records `dispatch(first_group, offset of its arguments)` for each, with a barrier behind it.
template <class Dispatch>
void record_slices(Recorder& r, const Slices& slices, const Dispatch& dispatch) {
  for (std::uint32_t k = 0; k < slices.count; ++k) {
    const VkDeviceSize offset = slices.prepare(r, k);
    dispatch(k * slices.groups, offset);
    r.barrier();
  }
}

/// The number of queries of a dispatch: a number that the host knows, or a counter on the device.
struct QueryCount {
  std::uint32_t items = 0;
  const Buffer* counters = nullptr;  // if given: counters[counter] * multiplier queries,
  std::uint32_t counter = 0;
  std::uint32_t multiplier = 1;
  const Buffer* arguments = nullptr;  // and their groups of TreeQueries::kWorkgroupSize here
  Slices slices = {};

  static QueryCount of(std::uint32_t items) { return {.items = items}; }
};

class TreeQueries {
 public:
  static constexpr std::uint32_t kWorkgroupSize = 64;

  /// For dispatches of at most `capacity` queries. The mesh must outlive the object. Once the word at `stop` is not 0,
  /// workgroups of empty() and winding() return at their start and leave their results unchanged. (A test of all
  /// triangles takes milliseconds for each query; a dispatch of thousands took ten seconds.) With `counts`, boxes and
  /// triangles that walks test are counted. Errors: kOutOfMemory, kInternal.
  static Result<TreeQueries> create(ContextImpl& context, const DeviceMesh& mesh, std::uint32_t capacity,
                                    std::optional<BufferRange> stop = {}, bool counts = false);

  /// Queries are vec4 in the unit box: xyz, and in w the square of the greatest distance of the search; negative to
  /// skip the query (its results are left unchanged). Each call is followed by a barrier.
  ///
  /// nearest: vec4, the point and its squared distance (3.4e38: none). hits: uint, feature << 24 | leaf position, or
  /// 0xffffffff. Among exact ties the smallest leaf position wins, or, at a small cost, the smallest index.
  enum class Ties : std::uint32_t { kLeafPosition = 0, kIndex = 1 };
  void closest(Recorder& r, const QueryCount& count, BufferRange queries, BufferRange nearest, BufferRange hits,
               Ties ties = Ties::kLeafPosition) const;
  /// empty: uint, 1 if no point of the mesh is closer than the root of w.
  void empty(Recorder& r, const QueryCount& count, BufferRange queries, BufferRange empty) const;
  /// numbers: vec2, the winding number and a bound of its error, at most `tolerance`.
  void winding(Recorder& r, const QueryCount& count, BufferRange queries, BufferRange numbers, float tolerance) const;

  /// The list of queries whose walk was given up, and the kernel that answers those of closest(); other kernels share
  /// both.
  BufferRange unresolved() const { return unresolved_.range(); }
  void resolve_closest(Recorder& r, BufferRange queries, BufferRange nearest, BufferRange hits, Ties ties) const;

  /// The counts are four words, kNodeTests and kTriangleTests of tree_types.h. Each call is followed by a barrier.
  void clear_tests(Recorder& r) const;
  void copy_tests(Recorder& r, const Buffer& to, VkDeviceSize offset) const;

  /// The number of queries since creation that required a test of all triangles. Blocks.
  Result<std::uint32_t> read_unresolved_total();

 private:
  struct Kernel {
    const char* walk;
    const char* resolve;
    std::vector<std::uint32_t> constants;  // specialization constants from 1 on
  };
  TreeQueries(ContextImpl& context, const DeviceMesh& mesh, bool counts)
      : context_(&context), mesh_(&mesh), arena_(context), counts_(counts) {}
  void record(Recorder& r, const Kernel& kernel, const QueryCount& count, std::span<const BufferRange> own,
              BufferRange queries, float tolerance) const;
  void resolve(Recorder& r, ProgramKey key, std::span<const BufferRange> buffers,
               std::span<const std::byte> constants) const;

  ContextImpl* context_;
  const DeviceMesh* mesh_;
  Arena arena_;
  std::uint32_t counts_;  // a specialization constant: 0 or 1
  Buffer unresolved_;     // shaders/shared/tree/tree_query.glsl
  BufferRange stop_;
  Buffer total_;
};

}  // namespace medial_vk
