// The data shared by the files that answer the queries of a Scene.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/host_memory.h"
#include "device/context_impl.h"
#include "device_commands/uploads.h"
#include "device_mesh/device_tree.h"
#include "medial_vk/scene.h"
#include "queries/packet_queries.h"
#include "queries/query_batches.h"
#include "queries/tree_queries.h"

namespace medial_vk {

// Queries of one submission: short enough for any device, long enough to keep it busy.
constexpr std::uint32_t kBatch = 1u << 18;
// Squares of distances beyond this many box sizes overflow in float.
constexpr double kFarthest = 1e15;
constexpr float kAnyDistance = 3.4e38f;
constexpr char kAnswering[] = "answering queries";
constexpr std::uint32_t kNoHit = 0xffffffffu;

inline Status check_point(const Point& unit, std::size_t index) {
  for (const double x : unit) {
    if (std::abs(x) <= kFarthest) continue;  // false for NaN
    return Error{ErrorCode::kUsage, "query " + std::to_string(index) + " is not finite or too far from the mesh"};
  }
  return {};
}

class Scene::Impl {
 public:
  Impl(ContextImpl& context_in, DeviceMesh mesh_in) : context(&context_in), mesh(std::move(mesh_in)) {}

  /// A query for kernels: the position of `point` in the unit box, and w. Error: it is not finite, or too far away.
  Status write_query(std::size_t index, const Point& point, float w, Texel& out) const {
    const Point unit = mesh.to_unit(point);
    if (Status status = check_point(unit, index); !status.ok()) return status;
    out = {static_cast<float>(unit[0]), static_cast<float>(unit[1]), static_cast<float>(unit[2]), w};
    return {};
  }
  /// Creates the objects that answer queries before the first query, and the wide tree again after an update, since it
  /// is derived from the refitted binary tree. Errors: as usable(); kOutOfMemory.
  Status make_queries();
  /// Error: the last update failed.
  Status usable() const {
    if (mesh.intact) return {};
    return Error{ErrorCode::kOutOfMemory, "the scene could not be updated and must be created anew"};
  }
  Status closest_points(std::span<const Point> points, std::span<ClosestPoint> out);
  Status closest_points_of_groups(std::span<const Point> points, std::uint32_t group_size, std::span<ClosestPoint> out);
  /// A batch of closest-point queries: of points[order[i]], or of points[i] without an order.
  struct ClosestQueries {
    std::span<const Point> points;
    std::span<const std::uint32_t> order;
    std::uint32_t group_size = 0;  // of packets, by `slots`; 0: one by one
    std::span<const std::uint32_t> slots;

    std::size_t index(std::size_t i) const { return order.empty() ? i : std::size_t{order[i]}; }
  };
  Status closest(const ClosestQueries& request, std::span<ClosestPoint> out);
  Status read_closest(const ClosestQueries& request, std::size_t first, std::size_t count,
                      std::span<const std::byte* const, 2> items, std::span<ClosestPoint> out) const;
  Result<std::vector<std::uint8_t>> empty_balls(std::span<const Ball> balls);
  Result<std::vector<double>> winding_numbers(std::span<const Point> points, double tolerance);
  Result<std::vector<FluxSample>> fluxes(std::span<const Ball> spheres, std::uint32_t samples);
  Status answer(const QuerySet& request);

  ContextImpl* context;
  /// Host and device have the same memory, at the same speed: nothing is copied. Tests of the copies clear it before
  /// the first query.
  bool shares_memory = context->description.type == "cpu";
  DeviceMesh mesh;
  std::unique_ptr<TreeQueries> queries;
  std::unique_ptr<PacketQueries> packets;
  std::unique_ptr<QueryBatches> batches;  // from the first query on
};

}  // namespace medial_vk
