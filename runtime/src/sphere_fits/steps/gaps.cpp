#include "sphere_fits/steps/gaps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <utility>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

constexpr std::size_t kSamples = 20000;

struct BoundarySample {
  Point at, inward;
};

/// Corners, and points inside triangles in proportion to their area: a lattice (R_2 of M. Roberts) that is folded into
/// each triangle.
std::vector<BoundarySample> sample_boundary(const Mesh& mesh) {
  std::vector<double> areas;
  std::vector<Point> inward(mesh.triangles.size()), at_corner(mesh.vertices.size());
  double total = 0;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const Triangle& t = mesh.triangles[k];
    const Point &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const Point across = cross(c - a, b - a);
    const double twice = length(across);
    if (twice > 0) inward[k] = (1 / twice) * across;
    for (const std::uint32_t v : t) at_corner[v] = at_corner[v] + inward[k];
    areas.push_back(0.5 * twice);
    total += areas.back();
  }
  std::vector<BoundarySample> samples;
  // For very fine meshes a part of the corners suffices.
  const std::size_t stride = mesh.vertices.size() / kSamples + 1;
  for (std::size_t v = 0; v < mesh.vertices.size(); v += stride) {
    const double size = length(at_corner[v]);
    samples.push_back({mesh.vertices[v], size > 0 ? (1 / size) * at_corner[v] : Point{}});
  }
  double due = 0, s = 0.5, t = 0.5;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const Triangle& triangle = mesh.triangles[k];
    const Point& a = mesh.vertices[triangle[0]];
    const Point ab = mesh.vertices[triangle[1]] - a, ac = mesh.vertices[triangle[2]] - a;
    due += static_cast<double>(kSamples) * areas[k] / total;
    while (due >= 1) {
      --due;
      s = std::fmod(s + 0.7548776662466927, 1);
      t = std::fmod(t + 0.5698402909980532, 1);
      const bool folded = s + t > 1;
      samples.push_back({a + (folded ? 1 - s : s) * ab + (folded ? 1 - t : t) * ac, inward[k]});
    }
  }
  return samples;
}

}  // namespace

GapFinder::GapFinder(const Solid& solid, const DynamicUnion& balls, bool reach_out)
    : solid_(solid), balls_(balls), reach_out_(reach_out) {
  for (const BoundarySample& sample : sample_boundary(solid.mesh().mesh)) {
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
