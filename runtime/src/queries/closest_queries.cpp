// Closest points: few or scattered ones by a walk for each, many by packets of neighbours.
#include <algorithm>

#include "base/point_ops.h"
#include "base/point_order.h"
#include "queries/scene_impl.h"

namespace medial_vk {
namespace {

// From this number of points on, neighbours along a space-filling curve are near enough for packets, and the sort takes
// less time than it saves (docs/performance.md).
constexpr std::size_t kLeastSorted = 4096;

}  // namespace

Status Scene::Impl::read_closest(const ClosestQueries& request, std::size_t first, std::size_t count,
                                 std::span<const std::byte* const, 2> items, std::span<ClosestPoint> out) const {
  const auto* nearest = reinterpret_cast<const Texel*>(items[0]);
  const auto* hits = reinterpret_cast<const std::uint32_t*>(items[1]);
  const UnitTransform transform = mesh.transform();
  for (std::size_t i = 0; i < count; ++i) {
    if (hits[i] == kNoHit) return Error{ErrorCode::kInternal, "the device found no nearest triangle"};
    const std::size_t index = request.index(first + i);
    ClosestPoint& result = out[index];
    result.point = transform.inverse({nearest[i][0], nearest[i][1], nearest[i][2]});
    result.distance = length(result.point - request.points[index]);
    result.triangle = mesh.order[hits[i] & 0xffffffu];
    result.feature = static_cast<Feature>(hits[i] >> 24);
  }
  return {};
}

Status Scene::Impl::closest(const ClosestQueries& request, std::span<ClosestPoint> out) {
  const bool in_packets = request.group_size != 0;
  Arena arena(*context);
  Buffer table;
  if (in_packets) {
    Uploads uploads(*context);
    Result<Buffer> filled = create_filled(arena, uploads, request.slots, "slots of packets");
    if (!filled.ok()) return filled.error();
    if (Status there = uploads.finish(); !there.ok()) return there;
    table = filled.value();
  }
  QuerySet set;
  set.count = request.points.size();
  set.group_size = std::max(1u, request.group_size);
  set.batch = std::size_t{kBatch / set.group_size} * set.group_size;
  set.item_bytes = {16, 4};
  set.write = [&](std::size_t first, std::span<Texel> texels) -> Status {
    for (std::size_t i = 0; i < texels.size(); ++i) {
      const std::size_t index = request.index(first + i);
      Status status = write_query(index, request.points[index], kAnyDistance, texels[i]);
      if (!status.ok()) return status;
    }
    return {};
  };
  set.record = [&](Recorder& r, std::uint32_t count, const Buffer& at, std::span<const Buffer, 2> items) {
    if (in_packets) {
      packets->closest(r, {.groups = count / request.group_size, .group_size = request.group_size}, table.range(),
                       at.range(), items[0].range(), items[1].range(), TreeQueries::Ties::kIndex);
    } else {
      queries->closest(r, QueryCount::of(count), at.range(), items[0].range(), items[1].range(),
                       TreeQueries::Ties::kIndex);
    }
  };
  set.read = [&](std::size_t first, std::size_t count, std::span<const std::byte* const, 2> items) {
    return read_closest(request, first, count, items, out);
  };
  return answer(set);
}

Status Scene::Impl::closest_points(std::span<const Point> points, std::span<ClosestPoint> out) {
  if (Status ready = make_queries(); !ready.ok()) return ready;
  ClosestQueries request;
  request.points = points;
  std::vector<std::uint32_t> order, slots;
  if (points.size() >= kLeastSorted) {
    order = order_along_curve(points);
    request.order = order;
    request.group_size = packets->shape().slots();
    slots = make_slots(packets->shape(), request.group_size);
    request.slots = slots;
  }
  return closest(request, out);
}

Status Scene::Impl::closest_points_of_groups(std::span<const Point> points, std::uint32_t group_size,
                                             std::span<ClosestPoint> out) {
  if (Status ready = make_queries(); !ready.ok()) return ready;
  if (points.empty()) return {};
  const std::vector<std::uint32_t> slots = make_slots(packets->shape(), points.first(group_size));
  ClosestQueries request;
  request.points = points;
  request.group_size = group_size;
  request.slots = slots;
  return closest(request, out);
}

namespace {

Status check_groups(std::size_t points, std::uint32_t group_size) {
  if (group_size > 0 && group_size <= kBatch && points % group_size == 0) return {};
  return Error{ErrorCode::kUsage, "`group_size` must be 1 to " + std::to_string(kBatch) +
                                      " and divide the number of points; it is " + std::to_string(group_size) +
                                      " for " + std::to_string(points) + " points"};
}

Status check_room(std::size_t points, std::size_t room) {
  if (points == room) return {};
  return Error{ErrorCode::kUsage, "`out` must have an element for each of " + std::to_string(points) +
                                      " points; it has " + std::to_string(room)};
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
