#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "ball_unions/cells/ball_in_cell.h"
#include "ball_unions/cells/cell_builder.h"
#include "ball_unions/unions/split_balls.h"
#include "ball_unions/unions/unit_balls.h"
#include "base/host_memory.h"
#include "base/parallel.h"
#include "device/context_impl.h"
#include "device_commands/commands.h"
#include "device_commands/uploads.h"
#include "medial_vk/ball_union.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kWorkgroupSize = 64;
constexpr std::uint32_t kBallsPerDispatch = 1u << 15;  // milliseconds on a GPU
/// Iterations of loops in one invocation. lavapipe silently ends all loops after 65,535 iterations, and counts an
/// iteration if any invocation of the subgroup makes it.
constexpr std::uint32_t kIterations = 60'000;
/// Error bound of balls measured by the host, per cube or square of the radius: it must hold for any other order of
/// rounding in double.
constexpr double kHostBound = 0x1p-36;

static_assert(gpu::kBallsPerLeaf == BallTree::kLeaf);

class DeviceMeasuring {
 public:
  DeviceMeasuring(ContextImpl& context, std::span<const Ball> balls, const DeviceBallUnionOptions& options)
      : context_(context),
        balls_(balls),
        options_(options),
        threads_(thread_count(options.threads)),
        tree_(balls, threads_) {}

  Result<DeviceBallUnion> run();

 private:
  Status measure_on_device();
  void record(Recorder& r, const std::array<BufferRange, 4>& buffers) const;
  void accept();
  void redo();

  ContextImpl& context_;
  std::span<const Ball> balls_;
  DeviceBallUnionOptions options_;
  unsigned threads_;
  BallTree tree_;
  std::vector<gpu::MeasuredBall> found_;  // by position in the tree's order; negative bounds: not found
  DeviceBallUnion result_;
};

Result<DeviceBallUnion> DeviceMeasuring::run() {
  found_.assign(balls_.size(), {0, 0, -1, -1});
  for (auto* values : {&result_.volumes, &result_.areas, &result_.volume_bounds, &result_.area_bounds}) {
    values->resize(balls_.size());
  }
  if (const Status measured = measure_on_device(); !measured.ok()) return measured.error();
  accept();
  redo();
  result_.volume = careful_sum(result_.volumes);
  result_.area = careful_sum(result_.areas);
  result_.volume_bound = careful_sum(result_.volume_bounds);
  result_.area_bound = careful_sum(result_.area_bounds);
  return std::move(result_);
}

Status DeviceMeasuring::measure_on_device() {
  if (balls_.empty()) return {};
  const SplitBalls split = split_balls(balls_, tree_.order());
  if (!split.exact) return {};  // numbers outside the range of float: the host measures all balls
  Arena arena(context_);
  Uploads uploads(context_);
  const std::vector<gpu::BallNode> split_tree = split_nodes(tree_, threads_);
  Result<Buffer> balls = create_filled(arena, uploads, std::span(split.balls), "balls");
  if (!balls.ok()) return balls.error();
  Result<Buffer> names = create_filled(arena, uploads, tree_.order(), "numbers of balls");
  if (!names.ok()) return names.error();
  Result<Buffer> nodes = create_filled(arena, uploads, std::span(split_tree), "the tree over the balls");
  if (!nodes.ok()) return nodes.error();
  const VkDeviceSize bytes = found_.size() * sizeof(gpu::MeasuredBall);
  Result<Buffer> results = arena.create_buffer(bytes, MemoryKind::kDevice, "measures of balls");
  if (!results.ok()) return results.error();
  Result<Buffer> readback = arena.create_buffer(bytes, MemoryKind::kReadback, "measures of balls");
  if (!readback.ok()) return readback.error();
  if (Status there = uploads.finish(); !there.ok()) return there;
  const std::array<BufferRange, 4> buffers = {balls.value().range(), names.value().range(), nodes.value().range(),
                                              results.value().range()};
  const auto measured = run_commands(context_, [&](Recorder& r) {
    record(r, buffers);
    r.copy(results.value(), 0, readback.value(), 0, bytes);
    r.barrier_to_host();
    return r.status();
  });
  if (!measured.ok()) return measured.error();
  std::memcpy(found_.data(), readback.value().mapped, bytes);
  return {};
}

void DeviceMeasuring::record(Recorder& r, const std::array<BufferRange, 4>& buffers) const {
  const ProgramKey key{"measure_balls", 4, 0, sizeof(gpu::BallConstants), kWorkgroupSize, {}};
  const auto count = static_cast<std::uint32_t>(balls_.size());
  gpu::BallConstants constants{};
  constants.ball_count = count;
  constants.first_leaf = tree_.node_count() / 2;
  const bool together = context_.description.type == "cpu";
  constants.iterations = together ? kIterations / std::max(context_.subgroup.subgroupSize, 1u) : kIterations;
  for (std::uint32_t first = 0; first < count; first = constants.end_ball) {
    constants.first_ball = first;
    constants.end_ball = first + std::min(kBallsPerDispatch, count - first);
    r.dispatch(key, buffers, {}, bytes_of(constants), constants.end_ball - first);
  }
  r.barrier();
}

/// Accepts the results of the device that are within the tolerance.
void DeviceMeasuring::accept() {
  for (std::size_t n = 0; n < found_.size(); ++n) {
    const std::uint32_t i = tree_.order()[n];
    const double radius = balls_[i].radius, square = radius * radius, cube = square * radius;
    const gpu::MeasuredBall& found = found_[n];
    if (radius == 0) continue;
    const bool good = found.volume_bound >= 0 && found.volume_bound <= options_.tolerance && found.area_bound >= 0 &&
                      found.area_bound <= 10 * options_.tolerance;  // false for NaN
    if (!good) {
      result_.redone.push_back(i);
      continue;
    }
    result_.volumes[i] = cube * double{found.volume};
    result_.areas[i] = square * double{found.area};
    result_.volume_bounds[i] = cube * double{found.volume_bound};
    result_.area_bounds[i] = square * double{found.area_bound};
  }
}

/// Measures the others, in the tree's order, each by itself, so that no result depends on which balls these are.
void DeviceMeasuring::redo() {
  constexpr std::size_t kBlock = 512;
  const std::span<const std::uint32_t> names = result_.redone;
  parallel_blocks(names.size(), kBlock, threads_, [&](std::size_t begin, std::size_t end) {
    CellBuilder builder(balls_, tree_);
    for (; begin < end; ++begin) {
      const std::uint32_t i = names[begin];
      const double radius = balls_[i].radius;
      builder.forget();
      const BallInCell part = measure_ball_in_cell(builder.build(i), radius);
      result_.volumes[i] = part.volume;
      result_.areas[i] = part.area;
      result_.volume_bounds[i] = kHostBound * radius * radius * radius;
      result_.area_bounds[i] = kHostBound * radius * radius;
    }
  });
  std::sort(result_.redone.begin(), result_.redone.end());
}

void scale_back(DeviceBallUnion& result, double scale) {
  const double unit = 1 / scale;
  const double square = unit * unit, cube = square * unit;
  for (auto* volumes : {&result.volumes, &result.volume_bounds}) {
    for (double& volume : *volumes) volume *= cube;
  }
  for (auto* areas : {&result.areas, &result.area_bounds}) {
    for (double& area : *areas) area *= square;
  }
  result.volume *= cube;
  result.volume_bound *= cube;
  result.area *= square;
  result.area_bound *= square;
}

}  // namespace

Result<DeviceBallUnion> measure_ball_union(std::span<const Ball> balls, const DeviceBallUnionOptions& options,
                                           Context& context) {
  if (const Status status = check_balls(balls); !status.ok()) return status.error();
  if (!(options.tolerance > 0)) return Error{ErrorCode::kUsage, "`tolerance` must be positive"};
  return catch_out_of_memory("measuring a union of balls", [&]() -> Result<DeviceBallUnion> {
    const double scale = scale_of(balls);
    const std::vector<Ball> unit_balls = scaled_balls(balls, scale);
    Result<DeviceBallUnion> result = DeviceMeasuring(Internals::of(context), unit_balls, options).run();
    if (result.ok()) scale_back(result.value(), scale);
    return result;
  });
}

}  // namespace medial_vk
