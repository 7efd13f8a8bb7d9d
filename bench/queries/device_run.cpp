#include "device_run.h"

#include <algorithm>
#include <vector>

#include "base/point_order.h"
#include "device/context_impl.h"
#include "device_commands/commands.h"
#include "device_commands/uploads.h"
#include "device_mesh/device_tree.h"

namespace medial_vk::bench {

Result<std::unique_ptr<DeviceRun>> DeviceRun::create(ContextImpl& context, const MeshView& mesh,
                                                     std::span<const Point> spheres, std::uint32_t group_size,
                                                     std::span<const Point> scattered) {
  std::unique_ptr<DeviceRun> run(new DeviceRun(context));
  const Result<IndexedMesh> indexed = IndexedMesh::build(mesh);
  if (!indexed.ok()) return indexed.error();
  Result<DeviceMesh> device = DeviceMesh::create(context, indexed.value(), false);
  if (!device.ok()) return device.error();
  if (Status there = device.value().finish_uploads(); !there.ok()) return there.error();
  run->mesh_ = std::make_unique<DeviceMesh>(std::move(device).value());
  const PacketShape shape = PacketShape::best_for(context);
  const auto most = static_cast<std::uint32_t>(std::max(spheres.size(), scattered.size())) + shape.slots();
  Result<PacketQueries> packets = PacketQueries::create(context, *run->mesh_, most, shape);
  if (!packets.ok()) return packets.error();
  run->packets_ = std::make_unique<PacketQueries>(std::move(packets).value());
  Result<TreeQueries> single = TreeQueries::create(context, *run->mesh_, most);
  if (!single.ok()) return single.error();
  run->single_ = std::make_unique<TreeQueries>(std::move(single).value());
  Result<Buffer> nearest = run->arena_.create_buffer(VkDeviceSize{most} * 16, MemoryKind::kDevice, "nearest points");
  if (!nearest.ok()) return nearest.error();
  Result<Buffer> hits = run->arena_.create_buffer(VkDeviceSize{most} * 4, MemoryKind::kDevice, "nearest triangles");
  if (!hits.ok()) return hits.error();
  run->nearest_ = nearest.value();
  run->hits_ = hits.value();

  std::vector<Point> sorted;
  for (const std::uint32_t i : order_along_curve(scattered)) sorted.push_back(scattered[i]);
  const std::vector<std::uint32_t> runs = make_slots(shape, shape.slots());
  Result<Queries> a = run->upload_groups(spheres, group_size, make_slots(shape, spheres.first(group_size)));
  Result<Queries> b = run->upload_groups(scattered, shape.slots(), runs);
  Result<Queries> c = run->upload_groups(sorted, shape.slots(), runs);
  if (!a.ok()) return a.error();
  if (!b.ok()) return b.error();
  if (!c.ok()) return c.error();
  run->spheres_ = a.value();
  run->scattered_ = b.value();
  run->sorted_ = c.value();
  return run;
}

Result<DeviceRun::Queries> DeviceRun::upload_groups(std::span<const Point> points, std::uint32_t group_size,
                                                    std::span<const std::uint32_t> slots) {
  Queries queries;
  queries.group_size = group_size;
  queries.groups = static_cast<std::uint32_t>((points.size() + group_size - 1) / group_size);
  std::vector<Texel> texels(std::size_t{queries.groups} * group_size, Texel{0, 0, 0, -1});
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point p = mesh_->to_unit(points[i]);
    texels[i] = {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]), 3.4e38f};
  }
  Result<Buffer> positions = arena_.create_buffer(texels.size() * 16, MemoryKind::kDevice, "queries");
  if (!positions.ok()) return positions.error();
  Result<Buffer> table = arena_.create_buffer(slots.size_bytes(), MemoryKind::kDevice, "slots");
  if (!table.ok()) return table.error();
  queries.positions = positions.value();
  queries.slots = table.value();
  if (Status s = upload(*context_, queries.positions, std::as_bytes(std::span(texels))); !s.ok()) return s.error();
  if (Status s = upload(*context_, queries.slots, std::as_bytes(slots)); !s.ok()) return s.error();
  return queries;
}

namespace {

double seconds(const Result<std::vector<StageTime>>& times) {
  double sum = 0;
  if (times.ok()) {
    for (const StageTime& stage : times.value()) sum += stage.seconds;
  }
  return sum;
}

}  // namespace

double DeviceRun::packets(const Queries& q) {
  return seconds(run_commands(*context_, [&](Recorder& r) {
    r.begin_stage("packets");
    packets_->closest(r, {.groups = q.groups, .group_size = q.group_size}, q.slots.range(), q.positions.range(),
                      nearest_.range(), hits_.range(), TreeQueries::Ties::kIndex);
    return r.status();
  }));
}

double DeviceRun::one_by_one(const Queries& q) {
  return seconds(run_commands(*context_, [&](Recorder& r) {
    r.begin_stage("one by one");
    single_->closest(r, QueryCount::of(q.groups * q.group_size), q.positions.range(), nearest_.range(), hits_.range(),
                     TreeQueries::Ties::kIndex);
    return r.status();
  }));
}

double DeviceRun::spheres_by_packets() { return packets(spheres_); }
double DeviceRun::scattered_by_packets() { return packets(sorted_); }
double DeviceRun::scattered_one_by_one() { return one_by_one(scattered_); }
double DeviceRun::sorted_one_by_one() { return one_by_one(sorted_); }

}  // namespace medial_vk::bench
