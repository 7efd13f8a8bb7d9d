// Closest points: few or scattered ones by a walk for each, many by packets of neighbours.
#include <algorithm>

#include "point_math.h"
#include "point_order.h"
#include "scene_impl.h"

namespace medial_vk {
namespace {

// From so many points on, neighbours along a space-filling curve are near enough for packets, and sorting them pays
// (docs/performance.md).
constexpr std::size_t kLeastSorted = 4096;

Error no_hit() { return {ErrorCode::kInternal, "the device found no nearest triangle"}; }

}  // namespace

Status Scene::Impl::closest(const ClosestBatch& batch, std::span<ClosestPoint> out) {
  const auto index = [&](std::size_t i) { return batch.asked.empty() ? i : std::size_t{batch.asked[i]}; };
  const std::uint32_t group_size = std::max(1u, batch.group_size);
  const auto groups = static_cast<std::uint32_t>((batch.count + group_size - 1) / group_size);
  const std::size_t room = std::size_t{groups} * group_size;
  std::vector<Texel> asked_texels(room, Texel{0, 0, 0, -1});  // passed over
  for (std::size_t i = 0; i < batch.count; ++i) {
    const Point unit = mesh.to_unit(batch.points[index(batch.first + i)]);
    if (Status status = check_point(unit, index(batch.first + i)); !status.ok()) return status;
    asked_texels[i] = {static_cast<float>(unit[0]), static_cast<float>(unit[1]), static_cast<float>(unit[2]),
                       kAnyDistance};
  }
  Transfer transfer(*context);
  Result<Buffer> asked = transfer.create_filled(std::span<const Texel>(asked_texels), "query points");
  if (!asked.ok()) return asked.error();
  Result<Buffer> table = transfer.create(16, "an unused table of slots");
  if (batch.group_size != 0) table = transfer.create_filled(batch.slots, "slots of packets");
  if (!table.ok()) return table.error();
  // Nearest points and triangles in one buffer, so that one copy brings both.
  Result<Buffer> answers = transfer.create(room * 20, "nearest points");
  if (!answers.ok()) return answers.error();
  Result<Buffer> hits = transfer.create(room * 4, "nearest triangles");
  if (!hits.ok()) return hits.error();
  std::vector<std::byte> bytes(room * 20);
  const auto record = [&](Recorder& r) {
    const BufferRange nearest = answers.value().range(0, room * 16);
    if (batch.group_size == 0) {
      queries->closest(r, QueryCount::of(groups), asked.value().range(), nearest, hits.value().range(),
                       TreeQueries::Ties::kIndex);
    } else {
      packets->closest(r, {.groups = groups, .group_size = group_size}, table.value().range(), asked.value().range(),
                       nearest, hits.value().range(), TreeQueries::Ties::kIndex);
    }
    r.copy(hits.value(), 0, answers.value(), room * 16, room * 4);
    r.barrier();
  };
  Status status = transfer.run_and_read(record, answers.value(), std::span<std::byte>(bytes));
  if (!status.ok()) return status;
  for (std::size_t i = 0; i < batch.count; ++i) {
    Texel nearest;
    std::uint32_t hit = 0;
    std::memcpy(&nearest, &bytes[16 * i], 16);
    std::memcpy(&hit, &bytes[room * 16 + 4 * i], 4);
    if (hit == kNoHit) return no_hit();
    ClosestPoint& result = out[index(batch.first + i)];
    result.point = mesh.to_input({nearest[0], nearest[1], nearest[2]});
    result.distance = length(result.point - batch.points[index(batch.first + i)]);
    result.triangle = mesh.order[hit & 0xffffffu];
    result.feature = static_cast<Feature>(hit >> 24);
  }
  return {};
}

Result<std::vector<ClosestPoint>> Scene::closest_points(std::span<const Point> points) {
  std::vector<ClosestPoint> out(points.size());
  Impl::ClosestBatch batch;
  batch.points = points;
  std::vector<std::uint32_t> order, slots;
  std::size_t most = kBatch;
  if (points.size() >= kLeastSorted) {
    order = order_along_curve(points);
    batch.asked = order;
    batch.group_size = impl_->packets->shape().slots();
    slots = make_slots(impl_->packets->shape(), batch.group_size);
    batch.slots = slots;
    most = kBatch / batch.group_size * batch.group_size;
  }
  for (; batch.first < points.size(); batch.first += most) {
    batch.count = std::min(most, points.size() - batch.first);
    if (Status status = impl_->closest(batch, out); !status.ok()) return status.error();
  }
  return out;
}

Result<std::vector<ClosestPoint>> Scene::closest_points_of_groups(std::span<const Point> points,
                                                                  std::uint32_t group_size) {
  if (group_size == 0 || group_size > kBatch || points.size() % group_size != 0) {
    return Error{ErrorCode::kUsage, std::to_string(points.size()) + " points are no groups of " +
                                        std::to_string(group_size) + " (1 to " + std::to_string(kBatch) + ")"};
  }
  std::vector<ClosestPoint> out(points.size());
  if (points.empty()) return out;
  const std::vector<std::uint32_t> slots = make_slots(impl_->packets->shape(), points.first(group_size));
  Impl::ClosestBatch batch;
  batch.points = points;
  batch.group_size = group_size;
  batch.slots = slots;
  const std::size_t most = std::size_t{kBatch / group_size} * group_size;
  for (; batch.first < points.size(); batch.first += most) {
    batch.count = std::min(most, points.size() - batch.first);
    if (Status status = impl_->closest(batch, out); !status.ok()) return status.error();
  }
  return out;
}

}  // namespace medial_vk
