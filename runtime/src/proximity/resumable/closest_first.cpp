#include "proximity/resumable/closest_first.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace medial_vk {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr auto kIsFarther = [](const auto& s, const auto& t) { return s.separation > t.separation; };

double separation_of(const Ball& a, const Ball& b) { return length(b.centre - a.centre) - (a.radius + b.radius); }

}  // namespace

ClosestFirst::ClosestFirst(PlacedBalls a, PlacedBalls b)
    : a_(std::move(a)), b_(std::move(b)), heap_{{-kInfinity, 0, 0}}, lower_(-kInfinity), closest_(kInfinity) {}

bool ClosestFirst::is_complete() const { return heap_.empty() || heap_.front().separation >= closest_; }

void ClosestFirst::dive() {
  std::uint32_t node_a = 0, node_b = 0;
  while (true) {
    const PlacedNode &a = a_.nodes[node_a], &b = b_.nodes[node_b];
    double least = kInfinity;
    std::uint32_t below_a = 0, below_b = 0;
    for (std::uint32_t j = 0; j < b.count; ++j) {
      for (std::uint32_t k = 0; k < a.count; ++k) {
        const double separation = separation_of(a.balls[k], b.balls[j]);
        if (separation >= least) continue;
        least = separation;
        below_a = a.below[k];
        below_b = b.below[j];
      }
    }
    if (a.is_lowest && b.is_lowest) {
      take(below_a, below_b);
      return;
    }
    if (!a.is_lowest) node_a = below_a;
    if (!b.is_lowest) node_b = below_b;
  }
}

void ClosestFirst::step() {
  std::ranges::pop_heap(heap_, kIsFarther);
  const Task task = heap_.back();
  heap_.pop_back();
  compare(task);
  // All other pairs of balls have been compared, or lie below pairs of nodes that were no closer.
  const double left = heap_.empty() ? kInfinity : heap_.front().separation;
  lower_ = std::max(lower_, std::min(left, closest_));
}

void ClosestFirst::compare(const Task& task) {
  const PlacedNode &a = a_.nodes[task.a], &b = b_.nodes[task.b];
  if (a.is_lowest && b.is_lowest) {
    for (std::uint32_t j = 0; j < b.count; ++j) {
      for (std::uint32_t k = 0; k < a.count; ++k) take(a.below[k], b.below[j]);
    }
    return;
  }
  // A node of the lowest level is not replaced: its ball that is nearest to the other one stands for all.
  std::array<double, BodyNode::kWidth> of_a, of_b;
  of_a.fill(kInfinity);
  of_b.fill(kInfinity);
  for (std::uint32_t j = 0; j < b.count; ++j) {
    for (std::uint32_t k = 0; k < a.count; ++k) {
      const double separation = std::max(task.separation, separation_of(a.balls[k], b.balls[j]));
      of_a[k] = std::min(of_a[k], separation);
      of_b[j] = std::min(of_b[j], separation);
      if (!a.is_lowest && !b.is_lowest) push({separation, a.below[k], b.below[j]});
    }
  }
  for (std::uint32_t j = 0; j < b.count && a.is_lowest; ++j) push({of_b[j], task.a, b.below[j]});
  for (std::uint32_t k = 0; k < a.count && b.is_lowest; ++k) push({of_a[k], a.below[k], task.b});
}

void ClosestFirst::push(const Task& task) {
  if (task.separation >= closest_) return;
  heap_.push_back(task);
  std::ranges::push_heap(heap_, kIsFarther);
}

void ClosestFirst::take(std::uint32_t a, std::uint32_t b) {
  const double separation = separation_of(a_.balls[a], b_.balls[b]);
  if (separation >= closest_) return;
  closest_ = separation;
  balls_ = {a, b};
}

}  // namespace medial_vk
