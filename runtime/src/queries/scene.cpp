// Scene: batches of queries are uploaded, answered by the kernels of tree_queries.h and flux_sampler.h, and returned in
// the units of the mesh.
#include "medial_vk/scene.h"

#include <algorithm>

#include "base/spiral.h"
#include "queries/flux_sampler.h"
#include "queries/scene_impl.h"

namespace medial_vk {
namespace {

// One invocation adds up the samples of a sphere: lavapipe ends its loops silently after 65,535 iterations.
constexpr std::uint32_t kMostFluxSamples = 60'000;

}  // namespace

Result<Scene> Scene::create(Context& context, const IndexedMesh& mesh) {
  return catch_out_of_memory("making a scene", [&]() -> Result<Scene> {
    Result<DeviceMesh> device = DeviceMesh::create(Internals::of(context), mesh, false);
    if (!device.ok()) return device.error();
    if (Status there = device.value().finish_uploads(); !there.ok()) return there.error();
    return Scene(std::make_unique<Impl>(Internals::of(context), std::move(device).value()));
  });
}

Status Scene::Impl::make_queries() {
  if (Status ready = usable(); !ready.ok()) return ready;
  if (queries == nullptr) {
    Result<TreeQueries> made = TreeQueries::create(*context, mesh, kBatch);
    if (!made.ok()) return made.error();
    queries = std::make_unique<TreeQueries>(std::move(made).value());
  }
  if (packets == nullptr) {
    Result<PacketQueries> made = PacketQueries::create(*context, mesh, kBatch, PacketShape::best_for(*context));
    if (!made.ok()) return made.error();
    packets = std::make_unique<PacketQueries>(std::move(made).value());
  }
  return {};
}

Status Scene::update(const IndexedMesh& moved) {
  return catch_out_of_memory("updating a scene", [&]() -> Status {
    if (moved.bvh().order() == impl_->mesh.order) impl_->packets.reset();  // they belong to the previous positions
    return impl_->mesh.update(moved);
  });
}

Scene::Scene(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

Status Scene::Impl::answer(const QuerySet& request) {
  if (batches == nullptr) batches = std::make_unique<QueryBatches>(*context, kBatch, shares_memory);
  return batches->run(request);
}

Result<std::vector<std::uint8_t>> Scene::Impl::empty_balls(std::span<const Ball> balls) {
  if (Status ready = make_queries(); !ready.ok()) return ready.error();
  std::vector<std::uint8_t> out(balls.size());
  QuerySet set;
  set.count = balls.size();
  set.batch = kBatch;
  set.item_bytes = {4, 0};
  set.write = [&](std::size_t first, std::span<Texel> texels) -> Status {
    for (std::size_t i = 0; i < texels.size(); ++i) {
      const Ball& ball = balls[first + i];
      const double r = std::clamp(ball.radius / mesh.longest, 0.0, kFarthest);
      Status status = write_query(first + i, ball.centre, static_cast<float>(r * r), texels[i]);
      if (!status.ok()) return status;
    }
    return {};
  };
  set.record = [&](Recorder& r, std::uint32_t count, const Buffer& at, std::span<const Buffer, 2> items) {
    queries->empty(r, QueryCount::of(count), at.range(), items[0].range());
  };
  set.read = [&](std::size_t first, std::size_t count, std::span<const std::byte* const, 2> items) -> Status {
    const auto* empty = reinterpret_cast<const std::uint32_t*>(items[0]);
    for (std::size_t i = 0; i < count; ++i) out[first + i] = static_cast<std::uint8_t>(empty[i]);
    return {};
  };
  if (Status status = answer(set); !status.ok()) return status.error();
  return out;
}

Result<std::vector<double>> Scene::Impl::winding_numbers(std::span<const Point> points, double tolerance) {
  if (Status ready = make_queries(); !ready.ok()) return ready.error();
  if (!(tolerance > 0)) return Error{ErrorCode::kUsage, "`tolerance` must be positive"};
  // The device sums the angles of triangles; the outside is the solid that holds all points far away.
  const double far_number = mesh.side == MeshSide::kOutside ? 1 : 0;
  std::vector<double> out(points.size());
  QuerySet set;
  set.count = points.size();
  set.batch = kBatch;
  set.item_bytes = {8, 0};
  set.write = [&](std::size_t first, std::span<Texel> texels) -> Status {
    for (std::size_t i = 0; i < texels.size(); ++i) {
      Status status = write_query(first + i, points[first + i], kAnyDistance, texels[i]);
      if (!status.ok()) return status;
    }
    return {};
  };
  set.record = [&](Recorder& r, std::uint32_t count, const Buffer& at, std::span<const Buffer, 2> items) {
    queries->winding(r, QueryCount::of(count), at.range(), items[0].range(), static_cast<float>(tolerance));
  };
  set.read = [&](std::size_t first, std::size_t count, std::span<const std::byte* const, 2> items) -> Status {
    const auto* numbers = reinterpret_cast<const std::array<float, 2>*>(items[0]);
    for (std::size_t i = 0; i < count; ++i) out[first + i] = far_number + double{numbers[i][0]};
    return {};
  };
  if (Status status = answer(set); !status.ok()) return status.error();
  return out;
}

namespace {

std::vector<Texel> directions_of(std::span<const Point> points) {
  std::vector<Texel> texels;
  for (const Point& p : points)
    texels.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]), 0});
  return texels;
}

}  // namespace

Result<std::vector<FluxSample>> Scene::Impl::fluxes(std::span<const Ball> spheres, std::uint32_t samples) {
  if (Status ready = make_queries(); !ready.ok()) return ready.error();
  if (samples == 0 || samples > kMostFluxSamples) {
    return Error{ErrorCode::kUsage, "`samples` must be 1 to " + std::to_string(kMostFluxSamples)};
  }
  if (spheres.empty()) return std::vector<FluxSample>();
  const std::vector<Point> spiral = spiral_points(samples);
  const std::vector<Texel> directions = directions_of(spiral);
  QuerySet set;
  set.count = spheres.size();
  set.batch = std::max<std::size_t>(1, kBatch / samples);
  set.item_bytes = {16, 0};
  const std::size_t at_once = std::min(set.batch, set.count);
  const auto capacity = static_cast<std::uint32_t>(at_once * samples);
  Result<FluxSampler> sampler = FluxSampler::create(*context, *packets, capacity);
  if (!sampler.ok()) return sampler.error();
  Arena arena(*context);
  Uploads uploads(*context);
  Result<Buffer> around = create_filled(arena, uploads, std::span(directions), "directions of samples");
  if (!around.ok()) return around.error();
  const std::vector<std::uint32_t> table = make_slots(packets->shape(), spiral);
  Result<Buffer> slots = create_filled(arena, uploads, std::span(table), "slots of samples");
  if (!slots.ok()) return slots.error();
  if (Status there = uploads.finish(); !there.ok()) return there.error();
  std::vector<FluxSample> out(spheres.size());
  set.write = [&](std::size_t first, std::span<Texel> texels) -> Status {
    for (std::size_t i = 0; i < texels.size(); ++i) {
      const Ball& sphere = spheres[first + i];
      const auto radius = static_cast<float>(sphere.radius / mesh.longest);
      Status status = write_query(first + i, sphere.centre, radius, texels[i]);
      if (!status.ok()) return status;
    }
    return {};
  };
  set.record = [&](Recorder& r, std::uint32_t count, const Buffer& at, std::span<const Buffer, 2> items) {
    SphereCount of_batch;
    of_batch.spheres = count;
    sampler.value().record(r, of_batch, samples, at.range(), around.value().range(), slots.value().range(),
                           items[0].range());
  };
  set.read = [&](std::size_t first, std::size_t count, std::span<const std::byte* const, 2> items) -> Status {
    const auto* fluxes = reinterpret_cast<const Texel*>(items[0]);
    for (std::size_t i = 0; i < count; ++i)
      out[first + i] = {double{fluxes[i][0]}, mesh.longest * double{fluxes[i][1]},
                        static_cast<std::uint32_t>(fluxes[i][2])};
    return {};
  };
  if (Status status = answer(set); !status.ok()) return status.error();
  return out;
}

Result<std::vector<std::uint8_t>> Scene::empty_balls(std::span<const Ball> balls) {
  return catch_out_of_memory(kAnswering, [&] { return impl_->empty_balls(balls); });
}

Result<std::vector<double>> Scene::winding_numbers(std::span<const Point> points, double tolerance) {
  return catch_out_of_memory(kAnswering, [&] { return impl_->winding_numbers(points, tolerance); });
}

Result<std::vector<FluxSample>> Scene::fluxes(std::span<const Ball> spheres, std::uint32_t samples) {
  return catch_out_of_memory(kAnswering, [&] { return impl_->fluxes(spheres, samples); });
}

}  // namespace medial_vk
