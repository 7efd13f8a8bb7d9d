// Scene: batches of queries go up, through the kernels of tree_queries.h and flux_sampler.h, and come back in the units
// of the mesh.
#include "medial_vk/queries.h"

#include <algorithm>

#include "flux_sampler.h"
#include "scene_impl.h"
#include "spiral.h"

namespace medial_vk {
namespace {

// One invocation adds up the samples of a sphere: lavapipe ends its loops silently after 65,535 iterations.
constexpr std::uint32_t kMostFluxSamples = 60'000;

}  // namespace

Result<Scene> Scene::create(Context& context, const MeshView& mesh) {
  return catch_out_of_memory("making a scene", [&]() -> Result<Scene> {
    Result<DeviceMesh> device = DeviceMesh::create(context.impl(), mesh);
    if (!device.ok()) return device.error();
    auto impl = std::make_unique<Impl>(context.impl(), std::move(device).value());
    Result<TreeQueries> queries = TreeQueries::create(context.impl(), impl->mesh, kBatch);
    if (!queries.ok()) return queries.error();
    impl->queries = std::make_unique<TreeQueries>(std::move(queries).value());
    if (Status made = impl->make_packets(mesh); !made.ok()) return made.error();
    return Scene(std::move(impl));
  });
}

Status Scene::Impl::make_packets(const MeshView& view) {
  packets.reset();  // they would answer for the mesh as it was
  Result<PacketQueries> made = PacketQueries::create(*context, mesh, view, kBatch, PacketShape::best_for(*context));
  if (!made.ok()) return made.error();
  packets = std::make_unique<PacketQueries>(std::move(made).value());
  return {};
}

// The wide tree is collapsed from the refitted binary one.
Status Scene::update(const MeshView& mesh) {
  return catch_out_of_memory("updating a scene", [&]() -> Status {
    if (Status status = impl_->mesh.update(*impl_->context, mesh); !status.ok()) return status;
    return impl_->make_packets(mesh);
  });
}

Scene::Scene(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

Result<std::vector<std::uint8_t>> Scene::Impl::empty_balls(std::span<const Ball> balls) const {
  if (Status ready = usable(); !ready.ok()) return ready.error();
  std::vector<std::uint8_t> out(balls.size());
  for (std::size_t first = 0; first < balls.size(); first += kBatch) {
    const std::size_t count = std::min<std::size_t>(kBatch, balls.size() - first);
    const auto squared_radius = [&](std::size_t i) {
      const double r = std::clamp(balls[i].radius / mesh.longest, 0.0, kFarthest);
      return static_cast<float>(r * r);
    };
    auto sent = texels(
        first, count, [&](std::size_t i) { return balls[i].centre; }, squared_radius);
    if (!sent.ok()) return sent.error();
    Transfer transfer(*context);
    Result<Buffer> asked = transfer.create_filled(std::span<const Texel>(sent.value()), "query balls");
    if (!asked.ok()) return asked.error();
    Result<Buffer> answers = transfer.create(count * 4, "empty balls");
    if (!answers.ok()) return answers.error();
    std::vector<std::uint32_t> empty(count);
    Status status = transfer.run_and_read(
        [&](Recorder& r) {
          queries->empty(r, QueryCount::of(static_cast<std::uint32_t>(count)), asked.value().range(),
                         answers.value().range());
        },
        answers.value(), std::span<std::uint32_t>(empty));
    if (!status.ok()) return status.error();
    std::transform(empty.begin(), empty.end(), out.begin() + static_cast<std::ptrdiff_t>(first),
                   [](std::uint32_t e) { return static_cast<std::uint8_t>(e); });
  }
  return out;
}

Result<std::vector<double>> Scene::Impl::winding_numbers(std::span<const Point> points, double tolerance) const {
  if (Status ready = usable(); !ready.ok()) return ready.error();
  if (!(tolerance > 0)) return Error{ErrorCode::kUsage, "the tolerance of a winding number must be positive"};
  std::vector<double> out(points.size());
  for (std::size_t first = 0; first < points.size(); first += kBatch) {
    const std::size_t count = std::min<std::size_t>(kBatch, points.size() - first);
    auto sent = texels(
        first, count, [&](std::size_t i) { return points[i]; }, [](std::size_t) { return kAnyDistance; });
    if (!sent.ok()) return sent.error();
    Transfer transfer(*context);
    Result<Buffer> asked = transfer.create_filled(std::span<const Texel>(sent.value()), "query points");
    if (!asked.ok()) return asked.error();
    Result<Buffer> answers = transfer.create(count * 8, "winding numbers");
    if (!answers.ok()) return answers.error();
    std::vector<std::array<float, 2>> numbers(count);
    Status status = transfer.run_and_read(
        [&](Recorder& r) {
          queries->winding(r, QueryCount::of(static_cast<std::uint32_t>(count)), asked.value().range(),
                           answers.value().range(), static_cast<float>(tolerance));
        },
        answers.value(), std::span<std::array<float, 2>>(numbers));
    if (!status.ok()) return status.error();
    for (std::size_t i = 0; i < count; ++i) out[first + i] = double{numbers[i][0]};
  }
  return out;
}

namespace {

std::vector<Point> points_of(std::span<const Texel> texels) {
  std::vector<Point> points;
  for (const Texel& t : texels) points.push_back({double{t[0]}, double{t[1]}, double{t[2]}});
  return points;
}

}  // namespace

Status Scene::Impl::fluxes(std::span<const Ball> spheres, std::size_t first, std::span<const Texel> directions,
                           std::span<FluxSample> out) {
  auto texels_of = texels(
      first, out.size(), [&](std::size_t i) { return spheres[i].centre; },
      [&](std::size_t i) { return static_cast<float>(spheres[i].radius / mesh.longest); });
  if (!texels_of.ok()) return texels_of.error();
  const auto samples = static_cast<std::uint32_t>(directions.size());
  const auto count = static_cast<std::uint32_t>(out.size());
  Result<FluxSampler> sampler = FluxSampler::create(*context, *packets, count * samples);
  if (!sampler.ok()) return sampler.error();
  Transfer transfer(*context);
  Result<Buffer> asked = transfer.create_filled(std::span<const Texel>(texels_of.value()), "spheres");
  if (!asked.ok()) return asked.error();
  Result<Buffer> around = transfer.create_filled(directions, "directions of samples");
  if (!around.ok()) return around.error();
  const std::vector<std::uint32_t> table = make_slots(packets->shape(), points_of(directions));
  Result<Buffer> slots = transfer.create_filled(std::span<const std::uint32_t>(table), "slots of samples");
  if (!slots.ok()) return slots.error();
  Result<Buffer> answers = transfer.create(VkDeviceSize{count} * 16, "fluxes");
  if (!answers.ok()) return answers.error();
  std::vector<Texel> fluxes(count);
  SphereCount spheres_of_batch;
  spheres_of_batch.spheres = count;
  Status status = transfer.run_and_read(
      [&](Recorder& r) {
        sampler.value().record(r, spheres_of_batch, samples, asked.value().range(), around.value().range(),
                               slots.value().range(), answers.value().range());
      },
      answers.value(), std::span<Texel>(fluxes));
  if (!status.ok()) return status;
  for (std::size_t i = 0; i < count; ++i) {
    out[i] = {double{fluxes[i][0]}, mesh.longest * double{fluxes[i][1]}, static_cast<std::uint32_t>(fluxes[i][2])};
  }
  return {};
}

Result<std::vector<FluxSample>> Scene::Impl::fluxes(std::span<const Ball> spheres, std::uint32_t samples) {
  if (Status ready = usable(); !ready.ok()) return ready.error();
  if (samples == 0 || samples > kMostFluxSamples) {
    return Error{ErrorCode::kUsage, "samples per sphere must be 1 to " + std::to_string(kMostFluxSamples)};
  }
  std::vector<Texel> directions;
  for (const Point& d : spiral_points(samples)) {
    directions.push_back({static_cast<float>(d[0]), static_cast<float>(d[1]), static_cast<float>(d[2]), 0});
  }
  std::vector<FluxSample> out(spheres.size());
  const std::size_t batch = std::max<std::size_t>(1, kBatch / samples);
  for (std::size_t first = 0; first < spheres.size(); first += batch) {
    const std::size_t count = std::min(batch, spheres.size() - first);
    Status status = fluxes(spheres, first, directions, std::span(out).subspan(first, count));
    if (!status.ok()) return status.error();
  }
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
