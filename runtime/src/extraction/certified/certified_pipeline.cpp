#include "extraction/certified/certified_pipeline.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>

#include "device/context_impl.h"

namespace medial_vk {
namespace {

using gpu::uint;

static_assert(gpu::kStatistics + gpu::kStatisticsPerLevel * gpu::kMaxLevels <= gpu::kCounterCount);

constexpr uint kTopCellsAlongSide = 8;
// Contact lists hold clusters at levels where the radius of a cell's ball exceeds the median radius of the clusters by
// this factor.
constexpr double kCellPerCluster = 1.0;

// The number of kept cells that a chunk should have on a CPU. There a dispatch over that many takes about 0.1 s, the
// time of a stop; other devices are a hundred times as fast, and need as much work at a time as memory holds. This is a
// target, not a limit: a top cell that has more takes longer.
constexpr double kCellsAtOnceOfCpu = 40000;

// Number of kept voxels of a solid per square of the resolution (measured: 1 to 3 at the finest level, twice that below
// it). A buffer that overflows costs the whole chunk; one that is fuller than the target for a CPU costs nothing, and
// small chunks cost as many dispatches as large ones.
constexpr double kMostKept = 6, kLikelyKept = 1.5;

// The target for the fill of the fullest buffer: neighbouring chunks hold similar amounts of medial surface, not equal
// ones.
constexpr double kFull = 0.6;

// Bound of the rounding error of a distance in the unit box (shaders/shared/tree/closest_point.glsl).
constexpr float kSlack = 2e-6f;
// Centres of cells are rounded three times: at most 3 * 2^-25 a coordinate.
constexpr double kCentreError = 3e-7;

// Below the finest voxel, the number of cells along a sheet that runs on a face of its voxel, or whose angle is the
// threshold, grows fourfold with every level. Cells smaller than this that can hold no other points are not subdivided.
constexpr double kSettleSize = 1.0 / 4096;

const double kHalfDiagonal = std::sqrt(3.0) / 2.0;

std::uint32_t divide_up(std::uint32_t a, std::uint32_t b) { return (a + b - 1) / b; }

// The number of steps that narrow a line of length `from` below `to`, nine parts per step.
std::uint32_t steps_to_narrow(double from, double to) {
  std::uint32_t steps = 1;
  for (double length = from / 9.0; length > to && steps < 12; length /= 9.0) ++steps;
  return steps;
}

}  // namespace

CertifiedPipeline::CertifiedPipeline(ContextImpl& context, const DeviceMesh& mesh, const ExtractionOptions& options,
                                     const StopWord& stop)
    : context_(&context), mesh_(&mesh), stop_(&stop), options_(options), arena_(context) {
  range_.extra_levels = options.extra_levels;
}

Result<CertifiedPipeline> CertifiedPipeline::create(ContextImpl& context, const DeviceMesh& mesh,
                                                    const ExtractionOptions& options,
                                                    const std::array<std::uint32_t, 3>& grid, const StopWord& stop) {
  CertifiedPipeline p(context, mesh, options, stop);
  // Top cells of 2^k voxels so that 8 to 15 of them lie along the longest side, but at least 4 voxels: their children's
  // lists are of clusters, too, or expanded, before the finest ones test triangles.
  const std::uint32_t coarsest = std::max(1u, options.resolution / kTopCellsAlongSide);
  p.top_shift_ = static_cast<std::uint32_t>(std::max(2, static_cast<int>(std::bit_width(coarsest)) - 1));
  p.coarse_levels_ = p.top_shift_ - 1;
  p.set_grid(grid);
  // The growth test holds if the ends are within h of each other, h < epsilon sin^2(theta) D / (D + epsilon):
  // docs/theory.md, "How far to narrow". Four fifths of that leave room for D >= 4 epsilon and for rounding.
  const double angle = options.radius > 0 ? std::min(options.deep_angle, options.object_angle) : options.object_angle;
  const double sine = std::sin(angle);
  p.narrowing_steps_ = steps_to_narrow(2 * (kHalfDiagonal + options.epsilon), 0.8 * options.epsilon * sine * sine);
  while (p.clustered_levels_ < p.coarse_levels_ &&
         kHalfDiagonal * p.cell_size(p.clustered_levels_) >= kCellPerCluster * mesh.cluster_radius) {
    ++p.clustered_levels_;
  }
  const std::uint64_t left = left_of(options.memory_budget, mesh.bytes() + bytes_on_the_way(context) +
                                                                bytes_of_compiler(context, options.memory_budget));
  if (Status s = p.allocate(left); !s.ok()) return s.error();
  return p;
}

void CertifiedPipeline::set_grid(const std::array<std::uint32_t, 3>& grid) {
  grid_ = grid;
  for (int axis = 0; axis < 3; ++axis) top_grid_[axis] = divide_up(grid[axis], 1u << top_shift_);
}

GridBlock CertifiedPipeline::block_of(std::uint32_t top_cell) const {
  const std::uint32_t x = top_cell % top_grid_[0], rows = top_cell / top_grid_[0];
  return {{x << top_shift_, rows % top_grid_[1] << top_shift_, rows / top_grid_[1] << top_shift_}, top_shift_};
}

double CertifiedPipeline::aim() const {
  return context_->description.type == "cpu" ? std::min(kFull, kCellsAtOnceOfCpu / capacity_.cells) : kFull;
}

std::uint32_t CertifiedPipeline::likely_chunk() const {
  const double area = std::pow(options_.resolution, 2);
  double share = std::min(1.0, capacity_.cells / (kMostKept * area));
  if (context_->description.type == "cpu") share = std::min(share, kCellsAtOnceOfCpu / (kLikelyKept * area));
  return std::max(1u, static_cast<std::uint32_t>(top_cells() * share));
}

// Each cluster takes an iteration, and one more for every eight of its triangles.
std::uint32_t CertifiedPipeline::clusters_per_round() const {
  const uint iterations = 1 + divide_up(mesh_->most_in_cluster, kEightLanes);
  return std::max(32u, gpu::kEntriesPerRound / iterations / 32 * 32);
}

double CertifiedPipeline::cell_size(std::uint32_t level) const {
  return std::ldexp(1.0 / options_.resolution, static_cast<int>(coarse_levels_) - static_cast<int>(level));
}

Status CertifiedPipeline::allocate(std::uint64_t memory_budget) {
  // Bytes per kept cell and per list entry, from the table below. A sixth of the budget is left for the flux samples,
  // for points on their way to the host, and for blocks of memory that are not filled.
  constexpr std::uint64_t kBytesPerCell = 1672, kBytesPerEntry = 14;
  const std::uint64_t limit = context_->limits.maxStorageBufferRange;
  const std::uint64_t voxels = std::uint64_t{grid_[0]} * grid_[1] * grid_[2];
  const std::uint64_t cells = std::min({memory_budget * 45 / 100 / kBytesPerCell, limit / 256, std::uint64_t{1} << 19,
                                        std::max<std::uint64_t>(8 * voxels, 4096)});
  const std::uint64_t entries =
      std::min({memory_budget * 38 / 100 / kBytesPerEntry, limit / 4 - 64, std::uint64_t{1} << 27});
  capacity_.cells = static_cast<uint>(cells);
  capacity_.lines = std::min(2 * capacity_.cells, (1u << gpu::kRankShift) - 1);
  capacity_.list_entries = static_cast<uint>(entries);
  // No block that sort_by_work sorts has groups of two of these.
  constexpr uint kSpheresPerSort = 64 * gpu::kSortedPerLane / (gpu::kFluxSamples / gpu::kFluxGroup);
  capacity_.flux_block = std::clamp(capacity_.cells / 8, 1024u, 16384u) / kSpheresPerSort * kSpheresPerSort;
  const VkDeviceSize c = cells, lines = capacity_.lines, block = capacity_.flux_block;
  const VkDeviceSize words = entries / 32 + c;
  const VkDeviceSize scanned = 8 * c;
  struct Request {
    Buffer* buffer;
    VkDeviceSize bytes;
    const char* purpose;
  };
  Request requests[] = {
      {&counters_, gpu::kCounterCount * 4, "counters"},
      {&cells_[0], c * sizeof(gpu::Cell), "cells"},
      {&cells_[1], c * sizeof(gpu::Cell), "cells"},
      {&cells_[2], c * sizeof(gpu::Cell), "finest voxels"},
      {&lists_[0], entries * 4, "contact lists"},
      {&lists_[1], entries * 4, "contact lists"},
      {&lists_[2], entries * 4, "contact lists of the finest voxels"},
      {&nearest_, 16 * c * 8, "nearest triangles"},
      {&grown_nearest_, 2 * lines * 8, "nearest triangles of grown balls"},
      {&masks_, 8 * words * 4, "masks of listed triangles"},
      {&touch_masks_, 8 * words * 4, "masks of contacts"},
      {&counts_, 8 * c * 16, "contact counts"},
      {&requests_, 8 * c * 4, "cells and lines whose side is decided"},
      {&open_, 8 * c * 4, "cells that an axis may dismiss"},
      {&states_, scanned * 16, "states"},
      {&offsets_, scanned * 16, "offsets"},
      {&block_sums_, (scanned / 1024 + 1) * 16, "block sums"},
      {&aims_, gpu::kAimsPerCell * c * sizeof(gpu::Aim), "aims"},
      {&points_, 16 * c * 16, "line ends"},
      {&work_, gpu::kLinesPerCell * c * 4, "contacts of lines and samples"},
      {&order_, gpu::kLinesPerCell * c * 4, "order of lines and samples"},
      {&lines_, lines * sizeof(gpu::Line), "lines"},
      {&winners_, c * 4, "winners"},
      {&given_up_, c * 4, "voxels given up"},
      {&reasons_, c * 8, "reasons of undecided voxels"},
      {&undecided_, c * sizeof(gpu::UndecidedCell), "undecided voxels"},
      {&voxel_points_, c * sizeof(gpu::FoundPoint), "points of voxels"},
      {&result_, c * sizeof(gpu::FoundPoint), "result"},
      {&opposites_, gpu::kFluxSamples * block * 16, "opposite flux samples"},
      {&sample_nearest_, gpu::kFluxSamples * block * 8, "nearest triangles of flux samples"},
      {&flux_tallies_, block * 16, "sums of flux samples"},
      {&opposite_nearest_, gpu::kFluxSamples * block * 8, "nearest triangles of opposite flux samples"},
  };
  // Small ones fill the rest that large ones leave of a block.
  std::ranges::stable_sort(requests, std::greater(), &Request::bytes);
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
  return arguments_.create(arena_, counters_, *stop_, options_.measurements.kernel_times);
}

gpu::StepConstants CertifiedPipeline::level_constants(std::uint32_t level) const {
  const double voxel = 1.0 / options_.resolution, epsilon = options_.epsilon * voxel;
  const double size = cell_size(level);
  const bool below = level > coarse_levels_;
  // Lists serve every query of a point in the cell: lines reach epsilon beyond its ball, the growth test epsilon
  // beyond them, and at the finest level the flux sphere, of radius one voxel, (1 - sqrt(3)/2) voxels. A child's ball
  // lies in its parent's, so the same margin serves all levels above.
  const double margin = below ? 2 * epsilon : std::max(2 * epsilon, (1 - kHalfDiagonal) * voxel);
  const double deep = std::min(options_.deep_angle, options_.object_angle);
  gpu::StepConstants step{};
  step.cell_size = static_cast<float>(size);
  step.circumradius = static_cast<float>(kHalfDiagonal * size + kCentreError);
  step.list_radius = static_cast<float>(kHalfDiagonal * size + margin + 2 * kCentreError);
  step.voxel_size = static_cast<float>(voxel);
  step.epsilon = static_cast<float>(epsilon);
  step.angle = static_cast<float>(options_.object_angle);
  step.cos_twice_angle = static_cast<float>(std::cos(2 * (options_.object_angle + 2e-6)));
  step.radius = options_.radius > 0 ? static_cast<float>(options_.radius) : 1e30f;
  step.deep_angle = static_cast<float>(deep);
  step.cos_twice_deep_angle = static_cast<float>(std::cos(2 * (deep + 2e-6)));
  step.slack = kSlack;
  step.grid_x = grid_[0];
  step.grid_y = grid_[1];
  step.grid_z = grid_[2];
  step.voxels_per_cell = below ? 1u : 1u << (coarse_levels_ - level);
  step.depth = below ? level - coarse_levels_ : 0u;
  step.level = level;
  step.open_edges = mesh_->open_edge_count;
  const bool settles = below && size < kSettleSize, is_last = level + 1 == recorded_levels();
  step.ends = (is_last ? gpu::kEndsAll : 0u) | (settles ? gpu::kEndsSettled : 0u);
  step.block_xy = range_.block.corner[0] | range_.block.corner[1] << 16;
  step.block_z = range_.block.corner[2] | range_.block.shift << 16;
  step.half_side = static_cast<float>(size / 2 + kCentreError);
  // At the finest level lines use only the contacts that touch: those for points up to 2 epsilon beyond the voxel.
  step.touch_half_side =
      level == coarse_levels_ ? static_cast<float>(size / 2 + 2 * epsilon + 4 * kCentreError) : step.half_side;
  step.cluster_count = mesh_->cluster_count;
  step.lists = level >= clustered_levels_       ? gpu::kListsTriangles
               : level + 1 == clustered_levels_ ? gpu::kListsExpanded
                                                : gpu::kListsClusters;
  step.clusters_per_round = clusters_per_round();
  step.lines_per_cell = gpu::kLinesPerCell;
  return step;
}

void CertifiedPipeline::begin_stage(Recorder& r, const char* stage) const {
  if (!options_.measurements.kernel_times) r.begin_stage(stage);
}

VkDeviceSize CertifiedPipeline::prepare(Recorder& r, gpu::DispatchConstants constants) {
  constants.threads = context_->dispatch_threads;
  // Kernels increment these while others read them.
  if (constants.items_counter == gpu::kRequests || constants.items_counter == gpu::kOpen) arguments_.counters_change();
  return arguments_.offset_of(r, constants);
}

void CertifiedPipeline::run(Recorder& r, const Kernel& kernel, const Extent& extent, const gpu::StepConstants& step) {
  gpu::DispatchConstants d{};
  d.items_counter = extent.counter;
  d.items_multiplier = extent.multiplier;
  d.items_divisor = extent.divisor;
  d.group_size = kernel.workgroup_size;
  d.first_item = extent.first;
  d.item_limit = extent.limit;
  d.list_counter = extent.list_counter;
  d.queries_per_item = extent.queries;
  d.entry_limit = extent.entry_limit;
  // Kernels that read no lists run in a single round.
  d.first_entry = extent.list_counter == gpu::kNoCounter ? 0 : step.first_entry;
  const VkDeviceSize groups = prepare(r, d);
  if (arguments_.plans()) return;
  if (options_.measurements.kernel_times) {
    const std::string variant = kernel.constants.empty() ? "" : "/" + std::to_string(kernel.constants.front());
    const std::string task = step.second_task == 0 ? "" : "/second";
    r.begin_stage(kernel.shader + variant + task + "@" + std::to_string(step.level));
  }
  ProgramKey key;
  key.shader = kernel.shader;
  if (kernel.lanes == Lanes::kEight && context_->has_lockstep_lanes) key.shader += "_lockstep";
  key.storage_buffers = static_cast<uint>(kernel.buffers.size());
  const std::vector<VkBufferView> texels = texels_of(kernel.reads);
  key.texel_buffers = static_cast<uint>(texels.size());
  key.push_constant_bytes = sizeof(step);
  key.workgroup_size = kernel.workgroup_size;
  const bool has_variants = kernel.reads != Reads::kNoMesh && kernel.reads != Reads::kClusters;
  if (has_variants) key.shader += storage_suffix(mesh_->use_texels);
  key.constants = kernel.constants;
  r.dispatch_indirect(key, kernel.buffers, texels, bytes_of(step), arguments_.buffer(), groups);
  r.barrier();
}

std::vector<VkBufferView> CertifiedPipeline::texels_of(Reads reads) const {
  switch (reads) {
    case Reads::kNoMesh:
      return {};
    case Reads::kClusters:
      return {mesh_->cluster_texels};
    case Reads::kTriangles:
      return {mesh_->triangle_texels};
    case Reads::kTree:
      return {mesh_->triangle_texels, mesh_->tree_texels};
    case Reads::kLinks:
      return {mesh_->triangle_texels, mesh_->link_texels, mesh_->corner_texels};
  }
  return {};
}

void CertifiedPipeline::run_rounds(Recorder& r, const Kernel& kernel, const Extent& extent, gpu::StepConstants step,
                                   std::uint32_t entries) {
  Extent round = extent;
  const std::uint64_t served = std::uint64_t{rounds_} * entries;
  round.entry_limit = static_cast<uint>(std::min<std::uint64_t>(served, 0xffffffffu));
  for (std::uint32_t i = 0; i < rounds_; ++i) {
    step.first_entry = i * entries;
    run(r, kernel, round, step);
    round.queries = 0;  // further rounds continue the same queries
  }
}

void CertifiedPipeline::scan(Recorder& r, const gpu::ScanConstants& constants) {
  gpu::DispatchConstants d{};
  d.items_counter = constants.items_counter;
  d.items_multiplier = constants.items_multiplier;
  d.items_divisor = 16;  // elements per lane
  d.group_size = 64;
  d.item_limit = 0xffffffffu;
  d.least_items = gpu::kFewElements + 1;
  d.list_counter = gpu::kNoCounter;
  const VkDeviceSize groups = prepare(r, d);
  if (arguments_.plans()) return;
  if (options_.measurements.kernel_times) r.begin_stage("scan");
  const auto push = bytes_of(constants);
  const BufferRange blocks[] = {states_.range(), block_sums_.range(), counters_.range()};
  r.dispatch_indirect({"scan_blocks", 3, 0, sizeof(constants), 64, {}}, blocks, {}, push, arguments_.buffer(), groups);
  r.barrier();
  const BufferRange sums[] = {block_sums_.range(), counters_.range(), states_.range(), offsets_.range()};
  const BufferRange add[] = {states_.range(), block_sums_.range(), counters_.range(), offsets_.range()};
  r.dispatch({"scan_sums", 4, 0, sizeof(constants), 64, {}}, sums, {}, push, 64);
  r.barrier();
  r.dispatch_indirect({"scan_add", 4, 0, sizeof(constants), 64, {}}, add, {}, push, arguments_.buffer(), groups);
  r.barrier();
}

CertifiedPipeline::Kernel CertifiedPipeline::side_kernel(const char* shader, std::vector<BufferRange> buffers) const {
  buffers.insert(buffers.begin(), {mesh_->storage_of(mesh_->triangles), mesh_->storage_of(mesh_->tree)});
  buffers.push_back(mesh_->open_edges.range());
  const uint far_number = mesh_->side == MeshSide::kOutside ? 1 : 0;
  return {shader, std::move(buffers), Reads::kTree, {mesh_->open_edge_count > 0 ? 1u : 0u, far_number}};
}

void CertifiedPipeline::judge_pairs(Recorder& r, gpu::StepConstants step, const LevelBuffers& level,
                                    std::uint32_t first, std::uint32_t limit) {
  // Other drivers than llvmpipe get one program for all meshes, the one that was tried with NVIDIA's compiler.
  const bool has_untrusted = mesh_->has_untrusted || !context_->is_llvmpipe;
  step.first_item = first;
  run(r,
      {"judge_pairs",
       {mesh_->storage_of(mesh_->triangles), level.cells->range(), level.lists->range(), counters_.range(),
        mesh_->storage_of(mesh_->triangle_links), mesh_->storage_of(mesh_->corner_cones), aims_.range(),
        winners_.range(), reasons_.range(), given_up_.range()},
       Reads::kLinks,
       {has_untrusted ? 1u : 0u},
       kEightLanes,
       Lanes::kEight},
      {gpu::kCells, kEightLanes, 1, first * kEightLanes, limit * kEightLanes}, step);
}

void CertifiedPipeline::find_nearest(Recorder& r, Source source, const Extent& extent, const gpu::StepConstants& step,
                                     const Buffer& cells, const Buffer& lists, const Buffer& points,
                                     const Buffer& nearest) {
  constexpr uint kPointsPerLane[] = {gpu::kSectionsPerLine, 2, gpu::kFluxGroup, gpu::kFluxGroup};
  const uint points_per_lane = kPointsPerLane[static_cast<uint>(source)];
  Extent lanes = extent;
  lanes.queries = points_per_lane;
  gpu::StepConstants s = step;
  s.items_counter = extent.counter;
  s.items_multiplier = extent.multiplier;
  run_rounds(r,
             {"find_nearest",
              {mesh_->storage_of(mesh_->triangles), cells.range(), lists.range(), counters_.range(), points.range(),
               lines_.range(), result_.range(), nearest.range(), requests_.range(), masks_.range(), winners_.range(),
               order_.range()},
              Reads::kTriangles,
              {static_cast<uint>(source), points_per_lane}},
             lanes, s);
}

std::array<std::uint32_t, gpu::kCounterCount> CertifiedPipeline::read_counters() const {
  std::array<std::uint32_t, gpu::kCounterCount> counters;
  std::memcpy(counters.data(), counters_readback_.mapped, sizeof(counters));
  return counters;
}

}  // namespace medial_vk
