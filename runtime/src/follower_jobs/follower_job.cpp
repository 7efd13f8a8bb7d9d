#include <volk.h>

#include "medial_vk/follower_job.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "base/host_memory.h"
#include "device/context_impl.h"
#include "device_commands/commands.h"
#include "device_commands/uploads.h"
#include "follow_types.h"
#include "follower_jobs/rest_balls.h"
#include "follower_jobs/threaded_tree.h"
#include "following/surface/moving_surface.h"
#include "medial_vk/follower.h"
#include "tree_types.h"

namespace medial_vk {
namespace {

static_assert(sizeof(RecordedVertex) == 12);
static_assert(sizeof(RecordedBall) == sizeof(gpu::vec4));
// Kernels read and write these vector by vector (contacts.glsl).
static_assert(sizeof(gpu::FollowedBall) == gpu::kFollowedVectors * sizeof(gpu::vec4));
static_assert(sizeof(gpu::FollowState) == gpu::kStateVectors * sizeof(gpu::vec4));
static_assert(sizeof(gpu::FollowRest) == gpu::kRestVectors * sizeof(gpu::vec4));
static_assert(offsetof(gpu::FollowedBall, triangle_a) == 2 * sizeof(gpu::vec4));
static_assert(offsetof(gpu::FollowedBall, ball) == 3 * sizeof(gpu::vec4));
static_assert(offsetof(gpu::FollowState, carried_a) == 4 * sizeof(gpu::vec4));
static_assert(offsetof(gpu::FollowRest, through) == 6 * sizeof(gpu::vec4));
static_assert(static_cast<std::uint32_t>(FollowState::kMedial) == gpu::kFollowMedial);
static_assert(static_cast<std::uint32_t>(FollowState::kFlat) == gpu::kFollowFlat);
static_assert(static_cast<std::uint32_t>(FollowState::kShrunk) == gpu::kFollowShrunk);
static_assert(static_cast<std::uint32_t>(FollowState::kLost) == gpu::kFollowIsLost);

constexpr std::uint32_t kWorkgroupSize = gpu::kFollowGroup;
constexpr std::uint32_t kResolveGroup = 256;
/// Levels of the tree with no more places are refitted by one workgroup together with all above them.
constexpr std::uint32_t kSmallLevel = 512;
constexpr double kLeastSide = 1e-25, kMostSide = 1e25;
/// One invocation of 256 tests its share of all triangles within lavapipe's iterations (resolve_followed.comp).
constexpr std::size_t kMostTriangles = 8'000'000;

Status check_mesh(const IndexedMesh& rest, const MovingSurface& surface) {
  const auto refuse = [](const char* message) { return Error{ErrorCode::kInvalidMesh, message}; };
  if (!surface.is_closed()) return refuse("balls follow a mesh on the device only if it is closed");
  if (surface.front() < 0) return refuse("the mesh is inside out: its signed volume is negative");
  const double side = rest.longest_side();
  if (side >= kLeastSide && side <= kMostSide) return {};
  return refuse("the longest side of a mesh that balls follow on the device must be from 1e-25 to 1e25");
}

/// The square of the difference of both directions of a ball with this object angle.
float squared_turn_at(double object_angle) {
  if (object_angle > std::numbers::pi / 2) return 5;  // above all
  const double turn = 2 * std::sin(object_angle);
  return static_cast<float>(turn * turn);
}

/// Words before the lists: nothing is refused, the lists are empty, and so are dispatches over them.
constexpr std::array<std::uint32_t, gpu::kFollowLists> kEmptyLists = {0, 0, 0, 0, 0, 1, 1, 0, 1, 1, 0, 1, 1};

/// True if eight neighbouring invocations are a subgroup of their own.
bool can_walk_together(const ContextImpl& context) {
  return context.has_lockstep_lanes && context.subgroup.subgroupSize == 8;
}

}  // namespace

struct FollowerJob::Impl {
  /// Of the dispatches; made once, since their names take memory.
  struct Keys {
    ProgramKey place_triangles, refit_leaves, refit_level, refit_small_levels, follow, prepare_resolve, resolve,
        follow_again, connect, cast_rays, settle, recover;
  };
  /// The resources of a recorded sequence, in use until it has finished.
  struct Frame {
    Buffer staged;                       // vertices from the host
    std::unique_ptr<Recorder> recorder;  // keeps its descriptor sets: the buffers are always the same
  };

  Impl(ContextImpl& of, const FollowerJobOptions& o) : context(of), options(o), arena(of) {}

  ContextImpl& context;
  FollowerJobOptions options;
  Arena arena;
  Buffer vertices, indices, levels, triangles, bounds, nodes, lists, rests, states, found, sides, unresolved, balls,
      ball_states;
  std::uint32_t vertex_count = 0, triangle_count = 0, ball_count = 0, place_count = 0;
  bool walk_together = false;               // eight balls a walk
  bool use_texels = true;                   // triangles and nodes are not too large for views
  std::array<VkBufferView, 6> texels = {};  // of triangles, bounds, nodes, rests, states, found
  std::vector<std::uint32_t> level_sizes;
  Keys keys;
  float scale = 1;
  std::vector<Frame> frames;
  std::size_t next = 0;       // the frame that is recorded next
  bool has_vertices = false;  // its sequence begins with a copy
  bool from_rest = true;      // its sequence follows the rest pose

  /// Error: kOutOfMemory, if `given` of what has this size are more than a buffer takes, or than `most`.
  Status check_size(std::size_t given, const char* what, std::size_t bytes, std::size_t most = SIZE_MAX) const;
  Status check_sizes(const MeshView& mesh, std::size_t all_balls) const;
  Status fill(const IndexedMesh& rest, const ThreadedTree& tree, const std::vector<gpu::FollowRest>& at_rest);
  Status make_buffers();
  Status make_views();
  void make_keys();
  Status append(Recorder& r, const Frame& frame) const;
  void refit(Recorder& r) const;
  void follow(Recorder& r) const;
};

Status FollowerJob::Impl::check_size(std::size_t given, const char* what, std::size_t bytes, std::size_t most) const {
  most = std::min<std::size_t>(most, context.limits.maxStorageBufferRange / bytes);
  if (given <= most) return {};
  return Error{ErrorCode::kOutOfMemory, "balls that follow a mesh on this device: there are " + std::to_string(given) +
                                            " " + what + ", it takes " + std::to_string(most)};
}

Status FollowerJob::Impl::check_sizes(const MeshView& mesh, std::size_t all_balls) const {
  // Workgroups over a list of balls are in one row.
  const std::size_t most_balls = std::size_t{kWorkgroupSize} * context.limits.maxComputeWorkGroupCount[0];
  if (Status status = check_size(mesh.triangles.size(), "triangles", 4 * sizeof(gpu::vec4), kMostTriangles); !status) {
    return status;
  }
  if (Status status = check_size(all_balls, "balls", sizeof(gpu::FollowRest), most_balls); !status) return status;
  return check_size(mesh.vertices.size(), "vertices", sizeof(RecordedVertex));
}

Status FollowerJob::Impl::make_buffers() {
  const auto make = [&](VkDeviceSize bytes, const char* purpose, Buffer& buffer, MemoryKind kind) -> Status {
    Result<Buffer> made = arena.create_buffer(bytes, kind, purpose);
    if (made.ok()) buffer = made.value();
    return made.ok() ? Status() : Status(made.error());
  };
  struct Wanted {
    VkDeviceSize bytes;
    const char* purpose;
    Buffer* buffer;
  };
  const VkDeviceSize of_vertices = VkDeviceSize{vertex_count} * sizeof(RecordedVertex), n = ball_count;
  const VkDeviceSize of_triangles = VkDeviceSize{triangle_count} * sizeof(gpu::vec4);
  const std::array all = {Wanted{of_vertices, "vertices that move", &vertices},
                          Wanted{4 * of_triangles, "triangles that move", &triangles},
                          Wanted{of_triangles, "bounds of triangles that move", &bounds},
                          Wanted{(gpu::kFollowLists + 3 * n) * 4, "lists of balls", &lists},
                          Wanted{n * sizeof(gpu::FollowState), "states of balls", &states},
                          Wanted{n * sizeof(gpu::FollowedBall), "followed balls", &found},
                          Wanted{n * 4, "sides of balls", &sides},
                          Wanted{(gpu::kUnresolvedFirst + n) * 4, "unresolved balls", &unresolved},
                          Wanted{n * sizeof(RecordedBall), "balls", &balls},
                          Wanted{n * 4, "states for the host", &ball_states}};
  for (const auto& [bytes, purpose, buffer] : all) {
    if (Status status = make(bytes, purpose, *buffer, MemoryKind::kDevice); !status) return status;
  }
  frames.resize(options.frames);
  for (Frame& frame : frames) {
    Status status = make(of_vertices, "vertices of a frame", frame.staged, MemoryKind::kUpload);
    if (!status) return status;
  }
  return {};
}

/// Of a buffer that is never read, where kernels read storage.
Status FollowerJob::Impl::make_views() {
  const std::size_t most = std::max(
      {std::size_t{4} * triangle_count, std::size_t{2} * place_count, std::size_t{gpu::kRestVectors} * ball_count});
  use_texels = most <= context.limits.maxTexelBufferElements;
  Buffer unused;
  if (!use_texels) {
    Result<Buffer> made = arena.create_buffer(16, MemoryKind::kDevice, "an unused texel buffer");
    if (!made.ok()) return made.error();
    unused = made.value();
  }
  const std::array buffers = {&triangles, &bounds, &nodes, &rests, &states, &found};
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    const VkFormat format = i < 2 ? VK_FORMAT_R32G32B32A32_SFLOAT : VK_FORMAT_R32G32B32A32_UINT;
    Result<VkBufferView> view = arena.create_texel_view(use_texels ? *buffers[i] : unused, format);
    if (!view.ok()) return view.error();
    texels[i] = view.value();
  }
  return {};
}

void FollowerJob::Impl::make_keys() {
  const auto of_balls = [&](const std::string& shader, std::uint32_t group = kWorkgroupSize) {
    constexpr std::uint32_t kStorage = 11, kTexels = 6;  // as in follow()
    return ProgramKey{shader + storage_suffix(use_texels), kStorage, kTexels, sizeof(gpu::FollowConstants), group, {}};
  };
  const std::string lockstep = walk_together ? "_lockstep" : "";
  constexpr auto kBytes = static_cast<std::uint32_t>(sizeof(gpu::RefitConstants));
  keys.place_triangles = {"place_triangles", 5, 0, kBytes, kWorkgroupSize, {}};
  keys.refit_leaves = {"refit_nodes", 3, 0, kBytes, kWorkgroupSize, {1, 0}};
  keys.refit_level = {"refit_nodes", 3, 0, kBytes, kWorkgroupSize, {0, 0}};
  keys.refit_small_levels = {"refit_nodes", 3, 0, kBytes, kResolveGroup, {0, 1}};
  keys.follow = of_balls("follow_balls" + lockstep);
  keys.prepare_resolve = {"prepare_resolve", 1, 0, 0, 1, {}};
  keys.resolve = of_balls("resolve_followed", kResolveGroup);
  keys.follow_again = of_balls("follow_again" + lockstep);
  keys.connect = of_balls("connect_balls");
  keys.cast_rays = of_balls("cast_rays");
  keys.settle = of_balls("settle_balls");
  keys.recover = of_balls("recover_balls");
}

Status FollowerJob::Impl::fill(const IndexedMesh& rest, const ThreadedTree& tree,
                               const std::vector<gpu::FollowRest>& at_rest) {
  std::vector<std::uint32_t> corners;
  corners.reserve(3 * tree.order.size());
  for (const std::uint32_t triangle : tree.order) {
    for (const std::uint32_t corner : rest.view().triangles[triangle]) corners.push_back(corner);
  }
  vertex_count = static_cast<std::uint32_t>(rest.view().vertices.size());
  triangle_count = static_cast<std::uint32_t>(tree.order.size());
  ball_count = static_cast<std::uint32_t>(at_rest.size());
  place_count = tree.place_count();
  walk_together = can_walk_together(context) && tree.depth <= gpu::kMostFollowDepth;
  for (std::uint32_t level = 0; level < tree.level_count; ++level) level_sizes.push_back(tree.places_of(level));
  if (Status status = make_buffers(); !status) return status;
  Uploads uploads(context);
  const auto upload_all = [&](const auto& values, const char* purpose, Buffer& buffer) -> Status {
    Result<Buffer> made = create_filled(arena, uploads, std::span(values), purpose);
    if (!made.ok()) return made.error();
    buffer = made.value();
    return {};
  };
  if (Status status = upload_all(corners, "indices of vertices", indices); !status) return status;
  if (Status status = upload_all(tree.places, "a tree of triangles that move", nodes); !status) return status;
  if (Status status = upload_all(tree.levels, "levels of a tree", levels); !status) return status;
  if (Status status = upload_all(at_rest, "balls at rest", rests); !status) return status;
  const std::vector<std::uint32_t> none(gpu::kUnresolvedFirst, 0);
  if (Status status = uploads.add(unresolved, std::as_bytes(std::span(none))); !status) return status;
  if (Status status = uploads.finish(); !status) return status;
  if (Status status = make_views(); !status) return status;
  make_keys();
  return {};
}

void FollowerJob::Impl::refit(Recorder& r) const {
  gpu::RefitConstants constants = {triangle_count, 0, 0, scale};
  const std::array of_triangles = {vertices.range(), indices.range(), triangles.range(), lists.range(), bounds.range()};
  r.dispatch(keys.place_triangles, of_triangles, {}, bytes_of(constants), triangle_count);
  r.barrier();
  const std::array of_nodes = {triangles.range(), nodes.range(), levels.range()};
  const auto level_count = static_cast<std::uint32_t>(level_sizes.size());
  while (constants.first_level < level_count) {
    const std::uint32_t level = constants.first_level, places_here = level_sizes[level];
    const bool is_small = level != 0 && places_here <= kSmallLevel;  // and so are those above
    constants.end_level = is_small ? level_count : level + 1;
    const ProgramKey& key = is_small ? keys.refit_small_levels : level == 0 ? keys.refit_leaves : keys.refit_level;
    r.dispatch(key, of_nodes, {}, bytes_of(constants), is_small ? key.workgroup_size : places_here);
    r.barrier();
    constants.first_level = constants.end_level;
  }
}

void FollowerJob::Impl::follow(Recorder& r) const {
  const gpu::FollowConstants constants = {ball_count,
                                          place_count,
                                          triangle_count,
                                          from_rest ? 1u : 0u,
                                          scale,
                                          1 / scale,
                                          static_cast<float>(options.shrunk),
                                          squared_turn_at(options.object_angle)};
  const std::array buffers = {triangles.storage_range(use_texels),
                              nodes.storage_range(use_texels),
                              lists.range(),
                              rests.storage_range(use_texels),
                              states.range(),
                              found.range(),
                              sides.range(),
                              unresolved.range(),
                              balls.range(),
                              ball_states.range(),
                              bounds.storage_range(use_texels)};
  const auto run = [&](const ProgramKey& key) {
    r.dispatch(key, buffers, texels, bytes_of(constants), ball_count);
    r.barrier();
  };
  run(keys.follow);
  const std::array list = {unresolved.range()};
  r.dispatch(keys.prepare_resolve, list, {}, {}, 1);
  r.barrier();
  const auto run_by = [&](const ProgramKey& key, const Buffer& counts, std::uint32_t word) {
    r.dispatch_indirect(key, buffers, texels, bytes_of(constants), counts, VkDeviceSize{word} * 4);
    r.barrier();
  };
  const auto run_list = [&](const ProgramKey& key, std::uint32_t list_index) {
    run_by(key, lists, gpu::kFollowGroups + 3 * (list_index - gpu::kFollowAgain));
  };
  run_by(keys.resolve, unresolved, gpu::kUnresolvedGroups);
  run_list(keys.follow_again, gpu::kFollowAgain);
  run(keys.connect);
  run_list(keys.cast_rays, gpu::kFollowRays);
  run(keys.settle);
  run_list(keys.recover, gpu::kFollowLost);
}

Status FollowerJob::Impl::append(Recorder& r, const Frame& frame) const {
  r.barrier_to_others();
  if (has_vertices) r.copy(frame.staged, 0, vertices, 0, VkDeviceSize{vertex_count} * sizeof(RecordedVertex));
  r.update(lists, 0, std::as_bytes(std::span(kEmptyLists)));
  r.barrier();
  refit(r);
  follow(r);
  r.barrier_to_others();
  return r.status();
}

Result<FollowerJob> FollowerJob::create(Context& context, const IndexedMesh& rest, std::span<const Ball> balls,
                                        const FollowerJobOptions& options) {
  if (options.frames == 0) return Error{ErrorCode::kUsage, "a recorded job requires `frames` of at least 1"};
  return catch_out_of_memory("preparing a job", [&]() -> Result<FollowerJob> {
    auto impl = std::make_unique<Impl>(Internals::of(context), options);
    const MeshView& mesh = rest.view();
    if (Status fits = impl->check_sizes(mesh, balls.size()); !fits) return fits.error();
    Result<MovingSurface> surface = MovingSurface::build(rest);
    if (!surface) return surface.error();
    if (Status status = check_mesh(rest, surface.value()); !status) return status.error();
    // The host's follower tests that all balls are inside.
    FollowerOptions on_host;
    on_host.steps = 0;
    on_host.shrunk = options.shrunk;
    on_host.object_angle = options.object_angle;
    on_host.threads = options.threads;
    if (Result<Follower> tested = Follower::create(rest, balls, on_host); !tested) return tested.error();
    const ThreadedTree tree = make_threaded_tree(mesh, rest.bvh());
    if (Status fits = impl->check_size(tree.place_count(), "places in a tree", 2 * sizeof(gpu::vec4)); !fits) {
      return fits.error();
    }
    impl->scale = static_cast<float>(std::ldexp(1.0, -std::ilogb(rest.longest_side())));
    Result<std::vector<gpu::FollowRest>> at_rest =
        make_rest_balls(surface.value(), balls, positions_in(tree), double{impl->scale}, options.threads);
    if (!at_rest) return at_rest.error();
    if (Status status = impl->fill(rest, tree, at_rest.value()); !status) return status.error();
    const auto rehearse = [&](Recorder& r) { return impl->append(r, impl->frames.front()); };
    if (Status status = make_programs(impl->context, rehearse); !status) return status.error();
    return FollowerJob(std::move(impl));
  });
}

FollowerJob::FollowerJob(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
FollowerJob::FollowerJob(FollowerJob&&) noexcept = default;
FollowerJob& FollowerJob::operator=(FollowerJob&&) noexcept = default;
FollowerJob::~FollowerJob() = default;

Status FollowerJob::set_vertices(std::span<const Point> vertices) {
  const auto refuse = [](const std::string& why) { return Error{ErrorCode::kInvalidMesh, why}; };
  if (vertices.size() != impl_->vertex_count) {
    return refuse("the frame has " + std::to_string(vertices.size()) + " vertices, the mesh has " +
                  std::to_string(impl_->vertex_count));
  }
  const auto is_finite = [](double x) { return std::isfinite(static_cast<float>(x)); };
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (std::ranges::all_of(vertices[i], is_finite)) continue;
    return refuse("vertex " + std::to_string(i) + " has a coordinate that is not finite");
  }
  auto* const staged = static_cast<RecordedVertex*>(impl_->frames[impl_->next].staged.mapped);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) staged[i].position[k] = static_cast<float>(vertices[i][k]);
  }
  impl_->has_vertices = true;
  return {};
}

void FollowerJob::reset() { impl_->from_rest = true; }

Status FollowerJob::record(VkCommandBuffer commands) {
  Impl& job = *impl_;
  Impl::Frame& frame = job.frames[job.next];
  return catch_out_of_memory("recording a job", [&]() -> Status {
    if (frame.recorder == nullptr) {
      frame.recorder = std::make_unique<Recorder>(job.context, commands);
      frame.recorder->measure_nothing();
      frame.recorder->keep_sets();
    } else {
      frame.recorder->restart(commands);
    }
    if (Status status = job.append(*frame.recorder, frame); !status) return status;
    job.has_vertices = false;
    job.from_rest = false;
    job.next = (job.next + 1) % job.frames.size();
    return {};
  });
}

FollowerBuffers FollowerJob::buffers() const {
  return {impl_->vertices.handle, impl_->balls.handle, impl_->ball_states.handle};
}

}  // namespace medial_vk
