#include "medial_vk/device_bodies.h"

#include <algorithm>
#include <utility>

#include "base/format_text.h"
#include "base/host_memory.h"
#include "base/parallel.h"
#include "device_commands/uploads.h"
#include "medial_vk/collisions.h"
#include "proximity_jobs/device_bodies_impl.h"
#include "proximity_jobs/packed_trees.h"
#include "proximity_jobs/pose_batches.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kWorkgroupSize = 64;
/// Steps of a search, of which there are two for a pose. lavapipe silently ends all loops of an invocation after 65,535
/// iterations, and counts an iteration if any of its neighbours makes it: a step is one, and has nine at most, for the
/// balls of a node and the end of their loop. On a GPU a search so long takes a fraction of a second.
constexpr std::uint32_t kStepsOnProcessors = 3'200, kStepsOnGpus = 100'000;

constexpr std::size_t kAnswersAtATime = 4096;  // that one thread takes

static_assert(static_cast<std::uint32_t>(Collision::kFree) == gpu::kProximityFree);
static_assert(static_cast<std::uint32_t>(Collision::kHit) == gpu::kProximityHit);
static_assert(static_cast<std::uint32_t>(Collision::kUndecided) == gpu::kProximityUndecided);

Error other_number() { return {ErrorCode::kUsage, "there is another number of answers than of `pairs`"}; }

/// Calls take(i, what the kernel has written for pair i) for all pairs, from several threads.
template <class Answer, class Take>
Status answer(DeviceBodiesImpl& impl, std::span<const PosedPair> pairs, const AnswersOfKernel& kind, unsigned threads,
              const Take& take) {
  if (Status status = impl.check(pairs); !status.ok()) return status;
  return impl.pose_batches().run(pairs, kind, threads, [&](std::size_t first, std::size_t count, const void* written) {
    const std::span answers(static_cast<const Answer*>(written), count);
    parallel_for(count, kAnswersAtATime, threads, [&](std::size_t i) { take(first + i, answers[i]); });
  });
}

}  // namespace

DeviceBodies::Impl::Impl(ContextImpl& of, std::span<const Body> on_host)
    : context(of), bodies(on_host.begin(), on_host.end()), arena(of) {}
DeviceBodies::Impl::~Impl() = default;

Status DeviceBodies::Impl::upload_balls() {
  const PackedTrees packed(bodies);
  if (packed.nodes.size() >> gpu::kProximityNodeBits != 0)
    return Error{ErrorCode::kUsage, "`bodies` have too many balls for one device"};
  Uploads uploads(context);
  Result<Buffer> of_nodes = create_filled(arena, uploads, std::span(packed.nodes), "balls of bodies");
  if (!of_nodes.ok()) return of_nodes.error();
  Result<Buffer> of_bodies = create_filled(arena, uploads, std::span(packed.bodies), "trees of bodies");
  if (!of_bodies.ok()) return of_bodies.error();
  nodes = of_nodes.value();
  trees = of_bodies.value();
  return uploads.finish();
}

void DeviceBodies::Impl::record(Recorder& r, const Buffer& poses, const Buffer& answers, std::uint32_t count,
                                const AnswersOfKernel& kind) const {
  const ProgramKey key{
      "bound_distances", 4, 0, sizeof(gpu::ProximityConstants), kWorkgroupSize, {kind.are_verdicts ? 1u : 0u}};
  const gpu::ProximityConstants constants = {count, static_cast<std::uint32_t>(bodies.size()),
                                             context.is_llvmpipe ? kStepsOnProcessors : kStepsOnGpus,
                                             kind.leave_rest ? 1u : 0u};
  const BufferRange buffers[] = {nodes.range(), trees.range(), poses.range(), answers.range()};
  r.dispatch(key, buffers, {}, bytes_of(constants), count);
}

Status DeviceBodies::Impl::check(std::span<const PosedPair> pairs) const {
  const auto is_wrong = [&](const PosedPair& pair) { return std::max(pair.a, pair.b) >= bodies.size(); };
  const auto wrong = std::ranges::find_if(pairs, is_wrong);
  if (wrong == pairs.end()) return {};
  return Error{ErrorCode::kUsage, format_text("pair {} of `pairs` is of bodies {} and {}; there are {}",
                                              wrong - pairs.begin(), wrong->a, wrong->b, bodies.size())};
}

PoseBatches& DeviceBodies::Impl::pose_batches() {
  if (batches == nullptr) {
    batches = std::make_unique<PoseBatches>(*this, PoseBatches::kMostPoses, context.description.type == "cpu");
  }
  return *batches;
}

Result<DeviceBodies> DeviceBodies::create(Context& context, std::span<const Body> bodies) {
  if (bodies.empty()) return Error{ErrorCode::kUsage, "there are no `bodies`"};
  return catch_out_of_memory("uploading bodies", [&]() -> Result<DeviceBodies> {
    auto impl = std::make_unique<Impl>(Internals::of(context), bodies);
    if (Status status = impl->upload_balls(); !status.ok()) return status.error();
    return DeviceBodies(std::move(impl));
  });
}

DeviceBodies::DeviceBodies(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
DeviceBodies::DeviceBodies(DeviceBodies&&) noexcept = default;
DeviceBodies& DeviceBodies::operator=(DeviceBodies&&) noexcept = default;
DeviceBodies::~DeviceBodies() = default;

Status DeviceBodies::collide_by_balls(std::span<const PosedPair> pairs, std::span<Collision> verdicts,
                                      const BatchOptions& options) {
  if (verdicts.size() != pairs.size()) return other_number();
  const auto take = [&](std::size_t i, std::uint32_t found) {
    if (found != gpu::kProximityGivenUp) {
      verdicts[i] = static_cast<Collision>(found);
    } else {
      medial_vk::collide_by_balls(impl_->bodies, pairs.subspan(i, 1), verdicts.subspan(i, 1), {1});
    }
  };
  return catch_out_of_memory("testing collisions", [&] {
    return answer<std::uint32_t>(*impl_, pairs, {.are_verdicts = true, .leave_rest = true}, options.threads, take);
  });
}

Status DeviceBodies::distance_bounds(std::span<const PosedPair> pairs, std::span<DistanceBounds> bounds,
                                     const BatchOptions& options) {
  if (bounds.size() != pairs.size()) return other_number();
  const auto take = [&](std::size_t i, const gpu::ProximityBounds& found) {
    const PosedPair& pair = pairs[i];
    if (found.lower >= 0) {
      bounds[i] = {found.lower, found.upper, {found.cover_a, found.cover_b}, {found.inside_a, found.inside_b}};
    } else {
      bounds[i] = medial_vk::distance_bounds(impl_->bodies[pair.a], impl_->bodies[pair.b], pair.pose);
    }
  };
  return catch_out_of_memory("bounding distances", [&] {
    return answer<gpu::ProximityBounds>(*impl_, pairs, {.are_verdicts = false, .leave_rest = true}, options.threads,
                                        take);
  });
}

}  // namespace medial_vk
