#include "following/ball_sides.h"

#include <cmath>
#include <numeric>

#include "medial_vk/ball_union.h"

namespace medial_vk {
namespace {

/// True only if the open balls share a point: six roundings of sums of at most the lengths compared, and a margin.
bool overlap(const Ball& a, const Ball& b) {
  const double reach = a.radius + b.radius;
  if (!(a.radius > 0 && b.radius > 0)) return false;
  const Point between = a.centre - b.centre;
  return length(between) < reach * (1 - 0x1p-40);
}

}  // namespace

Result<BallSides> BallSides::build(std::span<const Ball> rest, unsigned threads) {
  BallSides sides;
  sides.components_.reset(rest.size());
  sides.largest_.resize(rest.size());
  sides.sides_.resize(rest.size());
  Result<BallUnion> ball_union = measure_ball_union(rest, BallUnionOptions{threads, true});
  if (!ball_union) return ball_union.error();
  sides.edges_ = std::move(ball_union.value().complex.edges);
  sides.rest_edges_ = sides.edges_;
  return sides;
}

void BallSides::renew(std::uint32_t ball, std::span<const std::uint32_t> others) {
  std::erase_if(edges_, [&](const auto& edge) { return edge[0] == ball || edge[1] == ball; });
  for (const std::uint32_t other : others) edges_.push_back({ball, other});
}

void BallSides::connect(std::span<const Ball> balls) {
  components_.reset(balls.size());
  for (const auto& [a, b] : edges_) {
    if (overlap(balls[a], balls[b])) components_.join(a, b);
  }
  std::iota(largest_.begin(), largest_.end(), 0u);
  for (std::uint32_t i = 0; i < balls.size(); ++i) {
    std::uint32_t& largest = largest_[components_.of(i)];
    if (balls[i].radius > balls[largest].radius) largest = i;
  }
}

void BallSides::find(const MovingSurface& surface, std::span<const Ball> balls, std::span<std::uint8_t> is_inside) {
  queries_ = 0;
  if (!surface.is_closed()) {
    for (std::size_t i = 0; i < balls.size(); ++i) {
      is_inside[i] = balls[i].radius > 0 && surface.holds(balls[i]) ? 1 : 0;
    }
    queries_ = balls.size();
    return;
  }
  connect(balls);
  for (std::uint32_t i = 0; i < balls.size(); ++i) {
    if (components_.of(i) != i) continue;
    const Ball& largest = balls[largest_[i]];
    sides_[i] = largest.radius > 0 && surface.contains(largest.centre) ? 1 : 0;
    queries_ += largest.radius > 0 ? 1 : 0;
  }
  for (std::uint32_t i = 0; i < balls.size(); ++i) {
    is_inside[i] = balls[i].radius > 0 && sides_[components_.of(i)] != 0 ? 1 : 0;
  }
}

}  // namespace medial_vk
