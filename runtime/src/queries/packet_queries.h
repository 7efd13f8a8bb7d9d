// Recording of the kernels that answer closest-point queries by packets: groups of points near each other, with one
// walk of the tree for up to some fifty of them.
#pragma once

#include <cstdint>
#include <memory>

#include "queries/packet_tree.h"
#include "queries/tree_queries.h"

namespace medial_vk {

/// The groups of a dispatch: a number that the host knows, or a counter on the device.
struct GroupCount {
  std::uint32_t groups = 0;
  std::uint32_t group_size = 1;      // queries of a group; groups follow each other
  const Buffer* counters = nullptr;  // if given: counters[counter] groups,
  std::uint32_t counter = 0;
  const Buffer* arguments = nullptr;  // and PacketShape::packets(group_size) workgroups for each here
  Slices slices = {};
};

/// The number of invocations that walk together, and of the points that each of them keeps.
struct PacketShape {
  std::uint32_t width = 8;  // 4 to 64, a power of two
  std::uint32_t per_lane = 7;
  bool through_shared_memory = false;  // else the width is that of a subgroup

  std::uint32_t slots() const { return width * per_lane; }
  std::uint32_t packets(std::uint32_t group_size) const { return (group_size + slots() - 1) / slots(); }
  /// Children of a node: each lane tests one.
  std::uint32_t arity() const { return width < 8 ? 4 : 8; }
  /// At least `points` slots on teams of `width`.
  static PacketShape of(std::uint32_t width, bool through_shared_memory, std::uint32_t points = 51);
  /// Subgroups where they can ballot and shuffle and have 4 to 64 lanes, else shared memory.
  static PacketShape best_for(const ContextImpl& context);
};

constexpr std::uint32_t kNoPoint = 0xffffffffu;

/// Indices in a group by slot, per_lane slots for each lane of each packet (kNoPoint: none), so that a lane's points
/// are neighbours: the group is halved along its longest side until the parts fit a lane. The second one is for points
/// in an order that already keeps neighbours together: lanes get consecutive runs of equal length.
std::vector<std::uint32_t> make_slots(const PacketShape& shape, std::span<const Point> group);
std::vector<std::uint32_t> make_slots(const PacketShape& shape, std::uint32_t group_size);

class PacketQueries {
 public:
  /// For dispatches of at most `capacity` queries. `device` must outlive the object, `mesh` is the one given to
  /// DeviceMesh::create(). With `counts`, the tests of walks are counted. Errors: kOutOfMemory, kInternal.
  static Result<PacketQueries> create(ContextImpl& context, const DeviceMesh& device, std::uint32_t capacity,
                                      const PacketShape& shape, bool counts = false);

  /// TreeQueries::closest() for groups: same queries and results. `slots`: of make_slots(). Ends with a barrier.
  void closest(Recorder& r, const GroupCount& count, BufferRange slots, BufferRange queries, BufferRange nearest,
               BufferRange hits, TreeQueries::Ties ties = TreeQueries::Ties::kLeafPosition) const;

  /// As of TreeQueries.
  void clear_tests(Recorder& r) const { resolver_->clear_tests(r); }
  void copy_tests(Recorder& r, const Buffer& to, VkDeviceSize offset) const { resolver_->copy_tests(r, to, offset); }

  const PacketShape& shape() const { return shape_; }
  /// The number of queries since creation that required a test of all triangles. Blocks.
  Result<std::uint32_t> read_unresolved_total() { return resolver_->read_unresolved_total(); }

 private:
  PacketQueries(const DeviceMesh& device, const PacketShape& shape, bool counts)
      : device_(&device), shape_(shape), counts_(counts) {}

  const DeviceMesh* device_;
  PacketShape shape_;
  std::uint32_t counts_;  // a specialization constant: 0 or 1
  std::unique_ptr<PacketTree> tree_;
  std::unique_ptr<TreeQueries> resolver_;  // its list of queries whose walk was given up
};

}  // namespace medial_vk
