#include "sphere_fits/methods/prefixes.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "medial_vk/shrinking_union.h"

namespace medial_vk {
namespace {

/// Indices of the balls in the union, by increasing share; of equal ones the later first, so that the order does not
/// depend on the sorting algorithm.
std::vector<std::uint32_t> least_first(const ShrinkingUnion& balls, std::size_t count) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (balls.holds(i)) numbers.push_back(i);
  }
  const std::span<const double> volumes = balls.volumes();
  std::sort(numbers.begin(), numbers.end(), [&](std::uint32_t a, std::uint32_t b) {
    return volumes[a] != volumes[b] ? volumes[a] < volumes[b] : a > b;
  });
  return numbers;
}

}  // namespace

Status order_by_share(std::vector<Ball>& balls, unsigned threads) {
  if (balls.size() < 2) return {};
  Result<ShrinkingUnion> shrinking = ShrinkingUnion::build(balls, {.threads = threads});
  if (!shrinking) return shrinking.error();
  std::vector<std::uint32_t> order;  // the last first
  while (order.size() < balls.size()) {
    const std::vector<std::uint32_t> left = least_first(shrinking.value(), balls.size());
    // One at a time if there are few; of many, one and a half percent at once, so that the time stays near n log n.
    const std::size_t going = std::max<std::size_t>(1, left.size() / 64);
    const std::span<const std::uint32_t> next(left.data(), going);
    order.insert(order.end(), next.begin(), next.end());
    if (Status status = shrinking.value().remove(next); !status) return status;
  }
  std::vector<Ball> ordered;
  ordered.reserve(balls.size());
  for (std::size_t n = order.size(); n-- > 0;) ordered.push_back(balls[order[n]]);
  balls = std::move(ordered);
  return {};
}

Result<std::vector<double>> prefix_volumes(std::span<const Ball> balls, unsigned threads) {
  std::vector<double> volumes(balls.size());
  if (balls.empty()) return volumes;
  Result<ShrinkingUnion> shrinking = ShrinkingUnion::build(balls, {.threads = threads});
  if (!shrinking) return shrinking.error();
  for (std::size_t i = balls.size(); i-- > 0;) {
    volumes[i] = shrinking.value().volume();
    const auto last = static_cast<std::uint32_t>(i);
    if (Status status = shrinking.value().remove({&last, 1}); !status) return status.error();
  }
  return volumes;
}

std::vector<std::size_t> level_counts(std::size_t count) {
  std::vector<std::size_t> counts;
  for (; count > 0; count /= 2) counts.insert(counts.begin(), count);
  return counts;
}

}  // namespace medial_vk
