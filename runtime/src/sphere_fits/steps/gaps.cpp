#include "sphere_fits/steps/gaps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <utility>

#include "base/point_ops.h"
#include "sphere_fits/steps/boundary_samples.h"

namespace medial_vk {

GapFinder::GapFinder(const Solid& solid, const DynamicUnion& balls, bool reach_out)
    : solid_(solid), balls_(balls), reach_out_(reach_out) {
  constexpr std::size_t kSamples = 20000;
  for (const BoundarySample& sample : sample_boundary(solid.mesh().mesh, kSamples)) {
    samples_.push_back({sample.at, sample.inward, 0});
  }
}

void GapFinder::forget(std::uint32_t slot) {
  if (slot < known_.size()) known_[slot] = 0;
}

double GapFinder::distance_to(const Point& p, std::uint32_t slot) const {
  if (!balls_.holds(slot)) return std::numeric_limits<double>::infinity();
  const Ball& ball = balls_.ball(slot);
  return length(p - ball.centre) - ball.radius;
}

double GapFinder::refresh(Sample& sample) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t slot = 0; slot < balls_.slots(); ++slot) {
    const double distance = distance_to(sample.at, slot);
    if (distance < least) least = distance, sample.slot = slot;
  }
  return least;
}

/// The ball that was nearest bounds each gap, so only a few gaps must be remeasured: where this bound exceeds the gap
/// at the sample that had the widest one the last time.
GapFinder::Gap GapFinder::widest_on_boundary() {
  const double least = refresh(samples_[widest_]);
  bounds_.clear();
  for (std::uint32_t k = 0; k < samples_.size(); ++k) {
    const double bound = distance_to(samples_[k].at, samples_[k].slot);
    if (bound > least || k == widest_) bounds_.emplace_back(bound, k);
  }
  // Most of the bounds come after the last one that is looked at, so a heap is enough of an order.
  std::ranges::make_heap(bounds_);
  Gap widest;
  for (; !bounds_.empty() && bounds_.front().first > widest.size; bounds_.pop_back()) {
    std::ranges::pop_heap(bounds_);
    const std::uint32_t k = bounds_.back().second;
    Sample& sample = samples_[k];
    const double size = refresh(sample);
    if (!(size > widest.size)) continue;
    const Point towards = balls_.ball(sample.slot).centre - sample.at;
    widest = {sample.at, size, sample.at + (0.5 * size / length(towards)) * towards, sample.inward};
    widest_ = k;
  }
  return widest;
}

void GapFinder::find_deepest(std::span<const std::uint32_t> slots, WorkerPool& pool) {
  known_.resize(balls_.slots(), 0);
  deepest_.resize(balls_.slots());
  pool.run(slots.size(), 1, [&](std::size_t k) { deepest_at(slots[k]); });
}

const GapFinder::Gap& GapFinder::deepest_at(std::uint32_t slot) {
  known_.resize(balls_.slots(), 0);
  deepest_.resize(balls_.slots());
  Gap& deepest = deepest_[slot];
  if (known_[slot]) return deepest;
  deepest = {};
  const Result<std::vector<Point>> vertices = balls_.vertices(slot);
  if (!vertices) throw std::bad_alloc();  // its only error for an occupied slot
  for (const Point& vertex : vertices.value()) {
    if (deepest.size > 0 && solid_.bvh().any_within(vertex, deepest.size)) continue;
    const double depth = solid_.distance(vertex);
    if (!(depth > deepest.size) || (reach_out_ && !solid_.contains(vertex))) continue;
    deepest = {.at = vertex, .size = depth};
  }
  known_[slot] = 1;
  return deepest;
}

GapFinder::Gap GapFinder::deepest_vertex() {
  Gap deepest;
  for (std::uint32_t slot = 0; slot < balls_.slots(); ++slot) {
    if (!balls_.holds(slot)) continue;
    if (const Gap& here = deepest_at(slot); here.size > deepest.size) deepest = here;
  }
  return deepest;
}

std::optional<Point> GapFinder::deepest_vertex(std::uint32_t slot) {
  const Gap& deepest = deepest_at(slot);
  return deepest.size > 0 ? std::optional(deepest.at) : std::nullopt;
}

}  // namespace medial_vk
