// Queries that stay on the device, to measure the time of the kernels alone.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "medial_vk/mesh_view.h"
#include "queries/packet_queries.h"

namespace medial_vk::bench {

class DeviceRun {
 public:
  /// Errors: those of DeviceMesh::create() and PacketQueries::create().
  static Result<std::unique_ptr<DeviceRun>> create(ContextImpl& context, const MeshView& mesh,
                                                   std::span<const Point> spheres, std::uint32_t group_size,
                                                   std::span<const Point> scattered);
  /// Each returns the device's seconds, by timestamps.
  double spheres_by_packets();
  double scattered_by_packets();  // sorted before
  double scattered_one_by_one();  // in the order given
  double sorted_one_by_one();

 private:
  struct Queries {
    Buffer positions, slots;
    std::uint32_t groups = 0;
    std::uint32_t group_size = 0;
  };
  explicit DeviceRun(ContextImpl& context) : context_(&context), arena_(context) {}
  Result<Queries> upload_groups(std::span<const Point> points, std::uint32_t group_size,
                                std::span<const std::uint32_t> slots);
  double packets(const Queries& queries);
  double one_by_one(const Queries& queries);

  ContextImpl* context_;
  Arena arena_;
  std::unique_ptr<DeviceMesh> mesh_;
  std::unique_ptr<PacketQueries> packets_;
  std::unique_ptr<TreeQueries> single_;
  Queries spheres_, scattered_, sorted_;
  Buffer nearest_, hits_;
};

}  // namespace medial_vk::bench
