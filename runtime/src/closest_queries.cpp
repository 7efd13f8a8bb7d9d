// Closest points: few or scattered ones by a walk for each, many by packets of neighbours.
#include <algorithm>
#include <array>

#include "point_math.h"
#include "point_order.h"
#include "scene_impl.h"

namespace medial_vk {
namespace {

// From so many points on, neighbours along a space-filling curve are near enough for packets, and sorting them pays
// (docs/performance.md).
constexpr std::size_t kLeastSorted = 4096;

}  // namespace

// Buffers for kBatch queries, made at the first call: fresh memory would cost as much as the queries.
Status Scene::Impl::make_room() {
  if (room) return {};
  auto made = std::make_unique<ClosestRoom>(*context);
  struct Request {
    Buffer* buffer;
    VkDeviceSize bytes;
    MemoryKind kind;
    const char* purpose;
  };
  const VkDeviceSize most = kBatch;
  const auto create = [&](std::span<const Request> requests) -> Status {
    for (const Request& request : requests) {
      Result<Buffer> buffer = made->arena.create_buffer(request.bytes, request.kind, request.purpose);
      if (!buffer.ok()) return buffer.error();
      *request.buffer = buffer.value();
    }
    return {};
  };
  const std::array on_device = {Request{&made->asked, most * 16, MemoryKind::kDevice, "query points"},
                                Request{&made->nearest, most * 16, MemoryKind::kDevice, "nearest points"},
                                Request{&made->hits, most * 4, MemoryKind::kDevice, "nearest triangles"}};
  if (Status status = create(on_device); !status.ok()) return status;
  const std::array on_host = {Request{&made->upload, most * 16, MemoryKind::kUpload, "query points"},
                              Request{&made->readback, most * 20, MemoryKind::kReadback, "results"}};
  made->is_shared = shares_memory && made->asked.mapped && made->nearest.mapped && made->hits.mapped;
  if (!made->is_shared) {
    if (Status status = create(on_host); !status.ok()) return status;
  }
  room = std::move(made);
  return {};
}

Status Scene::Impl::write_queries(const ClosestBatch& batch, std::size_t padded) const {
  auto* out = static_cast<Texel*>((room->is_shared ? room->asked : room->upload).mapped);
  const UnitTransform to_unit = mesh.transform();
  for (std::size_t i = 0; i < batch.count; ++i) {
    const std::size_t index = batch.index(i);
    const Point unit = to_unit(batch.points[index]);
    if (Status status = check_point(unit, index); !status.ok()) return status;
    out[i] = {static_cast<float>(unit[0]), static_cast<float>(unit[1]), static_cast<float>(unit[2]), kAnyDistance};
  }
  std::fill(out + batch.count, out + padded, Texel{0, 0, 0, -1});  // passed over
  return {};
}

void Scene::Impl::record_closest(Recorder& r, const ClosestBatch& batch, std::uint32_t groups,
                                 const Buffer& table) const {
  const VkDeviceSize padded = VkDeviceSize{groups} * std::max(1u, batch.group_size);
  if (!room->is_shared) {
    r.copy(room->upload, 0, room->asked, 0, padded * 16);
    r.barrier();
  }
  if (batch.group_size == 0) {
    queries->closest(r, QueryCount::of(groups), room->asked.range(), room->nearest.range(), room->hits.range(),
                     TreeQueries::Ties::kIndex);
  } else {
    packets->closest(r, {.groups = groups, .group_size = batch.group_size}, table.range(), room->asked.range(),
                     room->nearest.range(), room->hits.range(), TreeQueries::Ties::kIndex);
  }
  if (!room->is_shared) {
    r.copy(room->nearest, 0, room->readback, 0, padded * 16);
    r.copy(room->hits, 0, room->readback, padded * 16, padded * 4);
  }
  r.barrier_to_host();
}

Status Scene::Impl::read_closest(const ClosestBatch& batch, std::size_t padded, std::span<ClosestPoint> out) const {
  const auto* nearest = static_cast<const Texel*>((room->is_shared ? room->nearest : room->readback).mapped);
  const auto* hits = room->is_shared ? static_cast<const std::uint32_t*>(room->hits.mapped)
                                     : reinterpret_cast<const std::uint32_t*>(nearest + padded);
  const UnitTransform transform = mesh.transform();
  for (std::size_t i = 0; i < batch.count; ++i) {
    if (hits[i] == kNoHit) return Error{ErrorCode::kInternal, "the device found no nearest triangle"};
    const std::size_t index = batch.index(i);
    ClosestPoint& result = out[index];
    result.point = transform.inverse({nearest[i][0], nearest[i][1], nearest[i][2]});
    result.distance = length(result.point - batch.points[index]);
    result.triangle = mesh.order[hits[i] & 0xffffffu];
    result.feature = static_cast<Feature>(hits[i] >> 24);
  }
  return {};
}

Status Scene::Impl::closest(const ClosestBatch& batch, std::span<ClosestPoint> out) {
  if (Status status = make_room(); !status.ok()) return status;
  const std::uint32_t group_size = std::max(1u, batch.group_size);
  const auto groups = static_cast<std::uint32_t>((batch.count + group_size - 1) / group_size);
  const std::size_t padded = std::size_t{groups} * group_size;
  if (Status status = write_queries(batch, padded); !status.ok()) return status;
  Transfer transfer(*context);
  Buffer table;
  if (batch.group_size != 0) {
    Result<Buffer> filled = transfer.create_filled(batch.slots, "slots of packets");
    if (!filled.ok()) return filled.error();
    table = filled.value();
  }
  auto done = run_commands(*context, [&](Recorder& r) {
    record_closest(r, batch, groups, table);
    return r.status();
  });
  if (!done.ok()) return done.error();
  return read_closest(batch, padded, out);
}

Status Scene::Impl::closest_points(std::span<const Point> points, std::span<ClosestPoint> out) {
  if (Status ready = usable(); !ready.ok()) return ready;
  ClosestBatch batch;
  batch.points = points;
  std::vector<std::uint32_t> order, slots;
  std::size_t most = kBatch;
  if (points.size() >= kLeastSorted) {
    order = order_along_curve(points);
    batch.asked = order;
    batch.group_size = packets->shape().slots();
    slots = make_slots(packets->shape(), batch.group_size);
    batch.slots = slots;
    most = kBatch / batch.group_size * batch.group_size;
  }
  for (; batch.first < points.size(); batch.first += most) {
    batch.count = std::min(most, points.size() - batch.first);
    if (Status status = closest(batch, out); !status.ok()) return status;
  }
  return {};
}

Status Scene::Impl::closest_points_of_groups(std::span<const Point> points, std::uint32_t group_size,
                                             std::span<ClosestPoint> out) {
  if (Status ready = usable(); !ready.ok()) return ready;
  if (points.empty()) return {};
  const std::vector<std::uint32_t> slots = make_slots(packets->shape(), points.first(group_size));
  ClosestBatch batch;
  batch.points = points;
  batch.group_size = group_size;
  batch.slots = slots;
  const std::size_t most = std::size_t{kBatch / group_size} * group_size;
  for (; batch.first < points.size(); batch.first += most) {
    batch.count = std::min(most, points.size() - batch.first);
    if (Status status = closest(batch, out); !status.ok()) return status;
  }
  return {};
}

namespace {

Status check_groups(std::size_t points, std::uint32_t group_size) {
  if (group_size > 0 && group_size <= kBatch && points % group_size == 0) return {};
  return Error{ErrorCode::kUsage, std::to_string(points) + " points are no groups of " + std::to_string(group_size) +
                                      " (1 to " + std::to_string(kBatch) + ")"};
}

Status check_room(std::size_t points, std::size_t room) {
  if (points == room) return {};
  return Error{ErrorCode::kUsage,
               std::to_string(points) + " points have room for " + std::to_string(room) + " results"};
}

}  // namespace

Status Scene::closest_points(std::span<const Point> points, std::span<ClosestPoint> out) {
  if (Status status = check_room(points.size(), out.size()); !status.ok()) return status;
  return catch_out_of_memory(kAnswering, [&] { return impl_->closest_points(points, out); });
}

Status Scene::closest_points_of_groups(std::span<const Point> points, std::uint32_t group_size,
                                       std::span<ClosestPoint> out) {
  if (Status status = check_groups(points.size(), group_size); !status.ok()) return status;
  if (Status status = check_room(points.size(), out.size()); !status.ok()) return status;
  return catch_out_of_memory(kAnswering, [&] { return impl_->closest_points_of_groups(points, group_size, out); });
}

Result<std::vector<ClosestPoint>> Scene::closest_points(std::span<const Point> points) {
  return catch_out_of_memory(kAnswering, [&]() -> Result<std::vector<ClosestPoint>> {
    std::vector<ClosestPoint> out(points.size());
    if (Status status = closest_points(points, out); !status.ok()) return status.error();
    return out;
  });
}

Result<std::vector<ClosestPoint>> Scene::closest_points_of_groups(std::span<const Point> points,
                                                                  std::uint32_t group_size) {
  if (Status status = check_groups(points.size(), group_size); !status.ok()) return status.error();
  return catch_out_of_memory(kAnswering, [&]() -> Result<std::vector<ClosestPoint>> {
    std::vector<ClosestPoint> out(points.size());
    if (Status status = closest_points_of_groups(points, group_size, out); !status.ok()) return status.error();
    return out;
  });
}

}  // namespace medial_vk
