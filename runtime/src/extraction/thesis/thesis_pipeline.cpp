#include "extraction/thesis/thesis_pipeline.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/spiral.h"
#include "device/context_impl.h"
#include "device_commands/commands.h"
#include "device_commands/uploads.h"
#include "device_mesh/device_tree.h"

namespace medial_vk {
namespace {

using gpu::uint;

static_assert(gpu::kThesisLevels + gpu::kThesisCountsPerLevel * 4 <= gpu::kCounterCount);

constexpr uint kMostArguments = 4096;  // indirect dispatches of one recorded sequence

// Bound of the rounding error of a distance in the unit box (shaders/shared/tree/closest_point.glsl).
constexpr float kSlack = 2e-6f;
// Reduction of the ball around a point through its nearest boundary point, so that rounding does not place that point
// in the ball: several times the usual error (1e-7). A change of B is detected late by about this amount.
constexpr float kBallMargin = 1e-6f;

// Bounds for a top cell: 8^3 finest voxels with all their samples, and the segments of one round.
constexpr std::uint64_t kBytesPerVoxel = 256;
constexpr std::uint64_t kBytesPerRetraction = 2 * sizeof(gpu::Retraction) + 2 * 16 + 8 + 4 + 4 + 2 * 16 + 20;
// Some millions of samples a dispatch, or some hundreds of thousands: below 100 ms on a GPU, or on a CPU.
constexpr std::uint32_t kLargestChunk = 128, kLargestChunkOfCpu = 16;
// Walks of the tree take longest: this number of them takes some ten milliseconds on two cores.
constexpr std::uint32_t kQueriesPerSlice = 1u << 20, kQueriesPerSliceOfCpu = 8192;

std::uint32_t divide_up(std::uint32_t a, std::uint32_t b) { return (a + b - 1) / b; }

}  // namespace

ThesisPipeline::ThesisPipeline(ContextImpl& context, const DeviceMesh& mesh, const ExtractionOptions& options,
                               const StopWord& stop)
    : context_(&context), mesh_(&mesh), stop_(&stop), options_(options), arena_(context) {}

Result<ThesisPipeline> ThesisPipeline::create(ContextImpl& context, const DeviceMesh& mesh,
                                              const ExtractionOptions& options,
                                              const std::array<std::uint32_t, 3>& grid, const StopWord& stop) {
  for (const std::uint32_t samples : options.thesis.samples) {
    if (samples >= 1 && samples <= 4096) continue;
    return Error{ErrorCode::kUsage, "each of `samples` must be 1 to 4096"};
  }
  ThesisPipeline p(context, mesh, options, stop);
  p.grid_ = grid;
  // Four levels as in the source; fewer if a top cell would be more than half of the longest side.
  while (p.levels_ > 1 && (2u << (p.levels_ - 1)) > options.resolution) --p.levels_;
  for (int axis = 0; axis < 3; ++axis) p.top_grid_[axis] = divide_up(grid[axis], 1u << (p.levels_ - 1));
  if (Status status = p.allocate(); !status.ok()) return status.error();
  if (Status status = p.upload_directions(); !status.ok()) return status.error();
  return p;
}

double ThesisPipeline::cell_size(std::uint32_t level) const {
  return std::ldexp(1.0 / options_.resolution, static_cast<int>(levels_ - 1 - level));
}

// long: a table of all buffers, and the limits derived from it.
Status ThesisPipeline::allocate() {
  std::uint64_t cells_per_top = 1;    // at the finest level
  std::uint64_t samples_per_top = 1;  // at any level, and never none
  for (std::uint32_t level = 0; level < levels_; ++level) {
    cells_per_top = std::uint64_t{1} << (3 * level);
    samples_per_top = std::max(samples_per_top, cells_per_top * samples(level));
  }
  const std::uint64_t lines_per_top = cells_per_top * gpu::kRetractionsPerRound;
  const std::uint64_t bytes_per_top = cells_per_top * kBytesPerVoxel + lines_per_top * kBytesPerRetraction +
                                      samples_per_top * (FluxSampler::kBytesPerSample + 8);
  const std::uint64_t limit = context_->limits.maxStorageBufferRange;
  const bool is_cpu = context_->description.type == "cpu";
  queries_per_slice_ = is_cpu ? kQueriesPerSliceOfCpu : kQueriesPerSlice;
  const std::uint64_t largest = is_cpu ? kLargestChunkOfCpu : kLargestChunk;
  // The wide tree of the packets takes about as much as the mesh.
  const std::uint64_t left = left_of(options_.memory_budget, 2 * mesh_->bytes() + bytes_on_the_way(*context_));
  const std::uint64_t fitting =
      std::min({left * 9 / 10 / bytes_per_top, limit / (16 * samples_per_top),
                limit / (sizeof(gpu::Retraction) * lines_per_top), largest, std::uint64_t{top_cells()}});
  if (fitting == 0) {
    return Error{ErrorCode::kOutOfMemory, "mode thesis needs " + std::to_string(bytes_per_top * 10 / 9) +
                                              " bytes of device memory beside the mesh; raise `memory_budget`"};
  }
  chunk_ = static_cast<std::uint32_t>(fitting);
  const VkDeviceSize cells = chunk_ * cells_per_top, lines = chunk_ * lines_per_top;
  const auto capacity = static_cast<std::uint32_t>(chunk_ * samples_per_top);
  struct Request {
    Buffer* buffer;
    VkDeviceSize bytes;
    const char* purpose;
  };
  const Request requests[] = {
      {&counters_, gpu::kCounterCount * 4, "counters"},
      {&arguments_, VkDeviceSize{kMostArguments} * 12, "dispatch arguments"},
      {&cells_, cells * sizeof(gpu::ThesisCell), "cells"},
      {&kept_, cells * sizeof(gpu::ThesisCell), "kept cells"},
      {&nearest_, lines * 16, "nearest points"},
      {&hits_, lines * 4, "nearest triangles"},
      {&queries_at_, lines * 16, "queries"},
      {&sides_at_, lines * 16, "queries of sides"},
      {&numbers_, lines * 8, "winding numbers"},
      {&empty_, lines * 4, "empty balls"},
      {&states_, lines * 16, "states"},
      {&offsets_, lines * 16, "offsets"},
      {&block_sums_, (lines / 1024 + 1) * 16, "block sums"},
      {&spheres_, cells * 16, "spheres"},
      {&fluxes_, cells * 16, "fluxes"},
      {&active_, cells * 4, "active voxels"},
      {&still_active_, cells * 4, "active voxels"},
      {&lines_, lines * sizeof(gpu::Retraction), "segments"},
      {&narrowed_, lines * sizeof(gpu::Retraction), "narrowed segments"},
      {&accepted_, lines * 4, "accepted samples"},
      {&points_, cells * sizeof(gpu::FoundPoint), "points of voxels"},
      {&found_, cells * sizeof(gpu::FoundPoint), "result"},
  };
  VkDeviceSize all = 0;
  for (const Request& request : requests) all += request.bytes;
  arena_.expect(all);
  for (const Request& request : requests) {
    Result<Buffer> buffer = arena_.create_buffer(request.bytes, MemoryKind::kDevice, request.purpose);
    if (!buffer.ok()) return buffer.error();
    *request.buffer = buffer.value();
  }
  Result<Buffer> readback = arena_.create_buffer(gpu::kCounterCount * 4, MemoryKind::kReadback, "counters");
  if (!readback.ok()) return readback.error();
  counters_readback_ = readback.value();

  constexpr bool kCounts = true;
  Result<TreeQueries> queries = TreeQueries::create(
      *context_, *mesh_, std::max(capacity, static_cast<std::uint32_t>(lines)), stop_->range(), kCounts);
  if (!queries.ok()) return queries.error();
  queries_ = std::make_unique<TreeQueries>(std::move(queries).value());
  Result<PacketQueries> packets =
      PacketQueries::create(*context_, *mesh_, capacity, PacketShape::best_for(*context_), kCounts);
  if (!packets.ok()) return packets.error();
  packets_ = std::make_unique<PacketQueries>(std::move(packets).value());
  Result<FluxSampler> flux = FluxSampler::create(*context_, *packets_, capacity);
  if (!flux.ok()) return flux.error();
  flux_ = std::make_unique<FluxSampler>(std::move(flux).value());
  return {};
}

Status ThesisPipeline::upload_directions() {
  const VkDeviceSize alignment = std::max<VkDeviceSize>(16, context_->limits.minStorageBufferOffsetAlignment);
  std::vector<Texel> directions;
  for (std::uint32_t level = 0; level < levels_; ++level) {
    while (directions.size() * sizeof(Texel) % alignment != 0) directions.push_back({});
    directions_at_.push_back(directions.size() * sizeof(Texel));
    const std::vector<Point> points = spiral_points(samples(level));
    const std::vector<std::uint32_t> table = make_slots(packets_->shape(), points);
    const auto table_bytes = std::as_bytes(std::span(table));
    Result<Buffer> slots = arena_.create_buffer(table_bytes.size(), MemoryKind::kDevice, "slots of samples");
    if (!slots.ok()) return slots.error();
    slots_.push_back(slots.value());
    if (Status status = upload(*context_, slots_.back(), table_bytes); !status.ok()) return status;
    for (const Point& d : points) {
      directions.push_back({static_cast<float>(d[0]), static_cast<float>(d[1]), static_cast<float>(d[2]), 0});
    }
  }
  const auto bytes = std::as_bytes(std::span<const Texel>(directions));
  Result<Buffer> buffer = arena_.create_buffer(bytes.size(), MemoryKind::kDevice, "directions of samples");
  if (!buffer.ok()) return buffer.error();
  directions_ = buffer.value();
  return upload(*context_, directions_, bytes);
}

gpu::ThesisConstants ThesisPipeline::level_constants(std::uint32_t level, std::uint32_t first_cell) const {
  gpu::ThesisConstants step{};
  const bool finest = level + 1 == levels_;
  step.cell_size = static_cast<float>(cell_size(level));
  step.voxel_size = static_cast<float>(cell_size(levels_ - 1));
  step.epsilon = static_cast<float>(options_.epsilon * cell_size(levels_ - 1));
  // Slightly above the threshold, so that the angle between the written spokes is not below it.
  step.angle = static_cast<float>(options_.object_angle + 4e-6);
  step.radius = options_.radius > 0 ? static_cast<float>(options_.radius) + kSlack : 1e30f;
  step.least_flux = finest ? static_cast<float>(0.375 * std::sin(options_.object_angle)) : 0.0f;
  step.slack = kSlack;
  step.ball_margin = kBallMargin;
  step.grid_x = grid_[0];
  step.grid_y = grid_[1];
  step.grid_z = grid_[2];
  step.voxels_per_cell = 1u << (levels_ - 1 - level);
  step.top_x = top_grid_[0];
  step.top_y = top_grid_[1];
  step.first_cell = first_cell;
  step.level = level;
  step.finest = finest ? 1 : 0;
  step.closed = mesh_->closed ? 1 : 0;
  step.narrow = options_.thesis.narrow_features ? 1 : 0;
  step.samples = samples(levels_ - 1);
  return step;
}

VkDeviceSize ThesisPipeline::prepare(Recorder& r, Items items, std::uint32_t divisor, std::uint32_t group_size,
                                     std::uint32_t first, std::uint32_t count, std::uint32_t least_items) {
  gpu::DispatchConstants constants{};
  constants.items_counter = items.counter;
  constants.items_multiplier = items.multiplier;
  constants.items_divisor = divisor;
  constants.group_size = group_size;
  constants.least_items = least_items;
  constants.first_item = first;
  constants.item_limit = count;
  constants.list_counter = gpu::kNoCounter;
  constants.threads = context_->dispatch_threads;
  constants.argument = next_argument_++ % kMostArguments;
  const std::array<BufferRange, 3> buffers = {counters_.range(), arguments_.range(), stop_->range()};
  r.dispatch({"prepare_dispatch", 3, 0, sizeof(constants), 1, {}}, buffers, {}, bytes_of(constants), 1);
  r.barrier();
  return VkDeviceSize{constants.argument} * 12;
}

Slices ThesisPipeline::slices(Items items, std::uint64_t most, std::uint32_t per_slice, std::uint32_t group_size) {
  const auto count = static_cast<std::uint32_t>((most + per_slice - 1) / per_slice);
  return {count, per_slice / group_size, [this, items, per_slice, group_size](Recorder& r, std::uint32_t k) {
            return prepare(r, items, 1, group_size, k * per_slice, per_slice);
          }};
}

QueryCount ThesisPipeline::query_count(Items items, std::uint64_t most) {
  return {0,
          &counters_,
          items.counter,
          items.multiplier,
          &arguments_,
          slices(items, most, queries_per_slice_, TreeQueries::kWorkgroupSize)};
}

void ThesisPipeline::run(Recorder& r, const char* shader, Items items, gpu::ThesisConstants step,
                         std::vector<BufferRange> buffers, std::vector<std::uint32_t> constants) {
  const VkDeviceSize groups = prepare(r, items);
  step.items_counter = items.counter;
  step.items_multiplier = items.multiplier;
  buffers.insert(buffers.begin(), counters_.range());
  const ProgramKey key{shader,
                       static_cast<std::uint32_t>(buffers.size()),
                       0,
                       sizeof(step),
                       TreeQueries::kWorkgroupSize,
                       std::move(constants)};
  r.dispatch_indirect(key, buffers, {}, bytes_of(step), arguments_, groups);
  r.barrier();
}

void ThesisPipeline::scan(Recorder& r, Items items, std::uint32_t total) {
  const gpu::ScanConstants constants{items.counter, items.multiplier, total,       gpu::kIgnored,
                                     gpu::kIgnored, 0xffffffffu,      0xffffffffu, 0xffffffffu};
  constexpr std::uint32_t kElementsPerLane = 16;
  const VkDeviceSize groups = prepare(r, items, kElementsPerLane, 64, 0, 0xffffffffu, gpu::kFewElements + 1);
  const auto push = bytes_of(constants);
  const std::array<BufferRange, 3> blocks = {states_.range(), block_sums_.range(), counters_.range()};
  r.dispatch_indirect({"scan_blocks", 3, 0, sizeof(constants), 64, {}}, blocks, {}, push, arguments_, groups);
  r.barrier();
  const std::array<BufferRange, 4> sums = {block_sums_.range(), counters_.range(), states_.range(), offsets_.range()};
  r.dispatch({"scan_sums", 4, 0, sizeof(constants), 64, {}}, sums, {}, push, 64);
  r.barrier();
  const std::array<BufferRange, 4> add = {states_.range(), block_sums_.range(), counters_.range(), offsets_.range()};
  r.dispatch_indirect({"scan_add", 4, 0, sizeof(constants), 64, {}}, add, {}, push, arguments_, groups);
  r.barrier();
}

void ThesisPipeline::copy_counter(Recorder& r, std::uint32_t from, std::uint32_t to) {
  r.copy(counters_, VkDeviceSize{from} * 4, counters_, VkDeviceSize{to} * 4, 4);
  r.barrier();
}

std::array<std::uint32_t, gpu::kCounterCount> ThesisPipeline::read_counters() const {
  std::array<std::uint32_t, gpu::kCounterCount> counters;
  std::memcpy(counters.data(), counters_readback_.mapped, sizeof(counters));
  return counters;
}

Result<std::vector<gpu::FoundPoint>> ThesisPipeline::read_points(std::uint32_t count) {
  std::vector<gpu::FoundPoint> points(count);
  if (count == 0) return points;
  Arena staging(*context_);
  const VkDeviceSize bytes = count * sizeof(gpu::FoundPoint);
  Result<Buffer> buffer = staging.create_buffer(bytes, MemoryKind::kReadback, "result");
  if (!buffer.ok()) return buffer.error();
  auto copied = run_commands(*context_, [&](Recorder& r) {
    r.copy(found_, 0, buffer.value(), 0, bytes);
    r.barrier_to_host();
    return r.status();
  });
  if (!copied.ok()) return copied.error();
  std::memcpy(points.data(), buffer.value().mapped, bytes);
  return points;
}

}  // namespace medial_vk
