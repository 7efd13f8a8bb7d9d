// Scene: batches of queries go up, through the kernels of tree_queries.h and flux_sampler.h, and come back in the units
// of the mesh.
#include "medial_vk/queries.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "context_impl.h"
#include "device_tree.h"
#include "flux_sampler.h"
#include "point_math.h"
#include "spiral.h"
#include "tree_queries.h"

namespace medial_vk {
namespace {

// Queries of one submission: short enough for any device, long enough to keep it busy.
constexpr std::uint32_t kBatch = 1u << 18;
// Squares of distances beyond this many box sizes overflow in float.
constexpr double kFarthest = 1e15;
constexpr float kAnyDistance = 3.4e38f;
constexpr std::uint32_t kNoHit = 0xffffffffu;

/// The buffers of one call: filled from the host, read back to the host.
class Transfer {
 public:
  explicit Transfer(Context::Impl& context) : context_(context), arena_(context) {}

  Result<Buffer> create(VkDeviceSize bytes, const char* purpose) {
    return arena_.create_buffer(bytes, MemoryKind::kDevice, purpose);
  }
  template <class T>
  Result<Buffer> create_filled(std::span<const T> values, const char* purpose) {
    Result<Buffer> buffer = create(values.size_bytes(), purpose);
    if (!buffer.ok()) return buffer;
    if (Status status = upload(context_, buffer.value(), std::as_bytes(values)); !status.ok()) return status.error();
    return buffer;
  }
  /// Runs `record` and then copies the start of `from` to `to`.
  template <class T, class Record>
  Status run_and_read(const Record& record, const Buffer& from, std::span<T> to) {
    Result<Buffer> readback = arena_.create_buffer(to.size_bytes(), MemoryKind::kReadback, "results");
    if (!readback.ok()) return readback.error();
    auto done = run_commands(context_, [&](Recorder& r) {
      record(r);
      r.copy(from, 0, readback.value(), 0, to.size_bytes());
      r.barrier_to_host();
      return r.status();
    });
    if (!done.ok()) return done.error();
    std::memcpy(to.data(), readback.value().mapped, to.size_bytes());
    return {};
  }

 private:
  Context::Impl& context_;
  Arena arena_;
};

Status check_point(const Point& unit, std::size_t index) {
  for (const double x : unit) {
    if (std::abs(x) <= kFarthest) continue;  // false for NaN
    return Error{ErrorCode::kUsage, "query " + std::to_string(index) + " is not finite or too far from the mesh"};
  }
  return {};
}

}  // namespace

class Scene::Impl {
 public:
  Impl(Context::Impl& context_in, DeviceMesh mesh_in) : context(&context_in), mesh(std::move(mesh_in)) {}

  /// Texels for queries [first, first + count): positions in the unit box, `w` of each from `w_of(index)`.
  template <class PointOf, class WOf>
  Result<std::vector<Texel>> texels(std::size_t first, std::size_t count, PointOf point_of, WOf w_of) const {
    std::vector<Texel> out(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Point unit = mesh.to_unit(point_of(first + i));
      if (Status status = check_point(unit, first + i); !status.ok()) return status.error();
      out[i] = {static_cast<float>(unit[0]), static_cast<float>(unit[1]), static_cast<float>(unit[2]), w_of(first + i)};
    }
    return out;
  }

  Status closest(std::span<const Point> points, std::size_t first, std::span<ClosestPoint> out);
  Status fluxes(std::span<const Ball> spheres, std::size_t first, std::span<const Texel> directions,
                std::span<FluxSample> out);

  Context::Impl* context;
  DeviceMesh mesh;
  std::unique_ptr<TreeQueries> queries;
};

Result<Scene> Scene::create(Context& context, const MeshView& mesh) {
  Result<DeviceMesh> device = DeviceMesh::create(context.impl(), mesh);
  if (!device.ok()) return device.error();
  auto impl = std::make_unique<Impl>(context.impl(), std::move(device).value());
  Result<TreeQueries> queries = TreeQueries::create(context.impl(), impl->mesh, kBatch);
  if (!queries.ok()) return queries.error();
  impl->queries = std::make_unique<TreeQueries>(std::move(queries).value());
  return Scene(std::move(impl));
}

Scene::Scene(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

Status Scene::Impl::closest(std::span<const Point> points, std::size_t first, std::span<ClosestPoint> out) {
  auto texels_of = texels(
      first, out.size(), [&](std::size_t i) { return points[i]; }, [](std::size_t) { return kAnyDistance; });
  if (!texels_of.ok()) return texels_of.error();
  Transfer transfer(*context);
  const VkDeviceSize count = out.size();
  Result<Buffer> asked = transfer.create_filled(std::span<const Texel>(texels_of.value()), "query points");
  if (!asked.ok()) return asked.error();
  // Nearest points and triangles in one buffer, so that one copy brings both.
  Result<Buffer> answers = transfer.create(count * 20, "nearest points");
  if (!answers.ok()) return answers.error();
  Result<Buffer> hits = transfer.create(count * 4, "nearest triangles");
  if (!hits.ok()) return hits.error();
  std::vector<std::byte> bytes(count * 20);
  const auto record = [&](Recorder& r) {
    queries->closest(r, QueryCount::of(static_cast<std::uint32_t>(count)), asked.value().range(),
                     answers.value().range(0, count * 16), hits.value().range(), TreeQueries::Ties::kIndex);
    r.copy(hits.value(), 0, answers.value(), count * 16, count * 4);
    r.barrier();
  };
  Status status = transfer.run_and_read(record, answers.value(), std::span<std::byte>(bytes));
  if (!status.ok()) return status;
  for (std::size_t i = 0; i < count; ++i) {
    Texel nearest;
    std::uint32_t hit = 0;
    std::memcpy(&nearest, &bytes[16 * i], 16);
    std::memcpy(&hit, &bytes[count * 16 + 4 * i], 4);
    if (hit == kNoHit) return Error{ErrorCode::kInternal, "the device found no nearest triangle"};
    out[i].point = mesh.to_input({nearest[0], nearest[1], nearest[2]});
    out[i].distance = length(out[i].point - points[first + i]);
    out[i].triangle = mesh.order[hit & 0xffffffu];
    out[i].feature = static_cast<Feature>(hit >> 24);
  }
  return {};
}

Result<std::vector<ClosestPoint>> Scene::closest_points(std::span<const Point> points) {
  std::vector<ClosestPoint> out(points.size());
  for (std::size_t first = 0; first < points.size(); first += kBatch) {
    const std::size_t count = std::min<std::size_t>(kBatch, points.size() - first);
    Status status = impl_->closest(points, first, std::span(out).subspan(first, count));
    if (!status.ok()) return status.error();
  }
  return out;
}

Result<std::vector<std::uint8_t>> Scene::empty_balls(std::span<const Ball> balls) {
  std::vector<std::uint8_t> out(balls.size());
  for (std::size_t first = 0; first < balls.size(); first += kBatch) {
    const std::size_t count = std::min<std::size_t>(kBatch, balls.size() - first);
    const auto squared_radius = [&](std::size_t i) {
      const double r = std::clamp(balls[i].radius / impl_->mesh.longest, 0.0, kFarthest);
      return static_cast<float>(r * r);
    };
    auto texels = impl_->texels(
        first, count, [&](std::size_t i) { return balls[i].centre; }, squared_radius);
    if (!texels.ok()) return texels.error();
    Transfer transfer(*impl_->context);
    Result<Buffer> asked = transfer.create_filled(std::span<const Texel>(texels.value()), "query balls");
    if (!asked.ok()) return asked.error();
    Result<Buffer> answers = transfer.create(count * 4, "empty balls");
    if (!answers.ok()) return answers.error();
    std::vector<std::uint32_t> empty(count);
    Status status = transfer.run_and_read(
        [&](Recorder& r) {
          impl_->queries->empty(r, QueryCount::of(static_cast<std::uint32_t>(count)), asked.value().range(),
                                answers.value().range());
        },
        answers.value(), std::span<std::uint32_t>(empty));
    if (!status.ok()) return status.error();
    std::transform(empty.begin(), empty.end(), out.begin() + static_cast<std::ptrdiff_t>(first),
                   [](std::uint32_t e) { return static_cast<std::uint8_t>(e); });
  }
  return out;
}

Result<std::vector<double>> Scene::winding_numbers(std::span<const Point> points, double tolerance) {
  if (!(tolerance > 0)) return Error{ErrorCode::kUsage, "the tolerance of a winding number must be positive"};
  std::vector<double> out(points.size());
  for (std::size_t first = 0; first < points.size(); first += kBatch) {
    const std::size_t count = std::min<std::size_t>(kBatch, points.size() - first);
    auto texels = impl_->texels(
        first, count, [&](std::size_t i) { return points[i]; }, [](std::size_t) { return kAnyDistance; });
    if (!texels.ok()) return texels.error();
    Transfer transfer(*impl_->context);
    Result<Buffer> asked = transfer.create_filled(std::span<const Texel>(texels.value()), "query points");
    if (!asked.ok()) return asked.error();
    Result<Buffer> answers = transfer.create(count * 8, "winding numbers");
    if (!answers.ok()) return answers.error();
    std::vector<std::array<float, 2>> numbers(count);
    Status status = transfer.run_and_read(
        [&](Recorder& r) {
          impl_->queries->winding(r, QueryCount::of(static_cast<std::uint32_t>(count)), asked.value().range(),
                                  answers.value().range(), static_cast<float>(tolerance));
        },
        answers.value(), std::span<std::array<float, 2>>(numbers));
    if (!status.ok()) return status.error();
    for (std::size_t i = 0; i < count; ++i) out[first + i] = double{numbers[i][0]};
  }
  return out;
}

Status Scene::Impl::fluxes(std::span<const Ball> spheres, std::size_t first, std::span<const Texel> directions,
                           std::span<FluxSample> out) {
  auto texels_of = texels(
      first, out.size(), [&](std::size_t i) { return spheres[i].centre; },
      [&](std::size_t i) { return static_cast<float>(spheres[i].radius / mesh.longest); });
  if (!texels_of.ok()) return texels_of.error();
  const auto samples = static_cast<std::uint32_t>(directions.size());
  const auto count = static_cast<std::uint32_t>(out.size());
  Result<FluxSampler> sampler = FluxSampler::create(*context, *queries, count * samples);
  if (!sampler.ok()) return sampler.error();
  Transfer transfer(*context);
  Result<Buffer> asked = transfer.create_filled(std::span<const Texel>(texels_of.value()), "spheres");
  if (!asked.ok()) return asked.error();
  Result<Buffer> around = transfer.create_filled(directions, "directions of samples");
  if (!around.ok()) return around.error();
  Result<Buffer> answers = transfer.create(VkDeviceSize{count} * 16, "fluxes");
  if (!answers.ok()) return answers.error();
  std::vector<Texel> fluxes(count);
  SphereCount spheres_of_batch;
  spheres_of_batch.spheres = count;
  Status status = transfer.run_and_read(
      [&](Recorder& r) {
        sampler.value().record(r, spheres_of_batch, samples, asked.value().range(), around.value().range(),
                               answers.value().range());
      },
      answers.value(), std::span<Texel>(fluxes));
  if (!status.ok()) return status;
  for (std::size_t i = 0; i < count; ++i) {
    out[i] = {double{fluxes[i][0]}, mesh.longest * double{fluxes[i][1]}, static_cast<std::uint32_t>(fluxes[i][2])};
  }
  return {};
}

Result<std::vector<FluxSample>> Scene::fluxes(std::span<const Ball> spheres, std::uint32_t samples) {
  if (samples == 0 || samples > kBatch) {
    return Error{ErrorCode::kUsage, "samples per sphere must be 1 to " + std::to_string(kBatch)};
  }
  std::vector<Texel> directions;
  for (const Point& d : spiral_points(samples)) {
    directions.push_back({static_cast<float>(d[0]), static_cast<float>(d[1]), static_cast<float>(d[2]), 0});
  }
  std::vector<FluxSample> out(spheres.size());
  const std::size_t batch = std::max<std::size_t>(1, kBatch / samples);
  for (std::size_t first = 0; first < spheres.size(); first += batch) {
    const std::size_t count = std::min(batch, spheres.size() - first);
    Status status = impl_->fluxes(spheres, first, directions, std::span(out).subspan(first, count));
    if (!status.ok()) return status.error();
  }
  return out;
}

}  // namespace medial_vk
