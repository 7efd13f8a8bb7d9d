#include "base/point_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kBits = 10;  // of a coordinate

struct Keyed {
  std::uint32_t key;
  std::uint32_t index;
};

/// Bits 0 to 9 of x, with two zeros between neighbours.
std::uint32_t spread(std::uint32_t x) {
  x = (x | x << 16) & 0x030000ffu;
  x = (x | x << 8) & 0x0300f00fu;
  x = (x | x << 4) & 0x030c30c3u;
  return (x | x << 2) & 0x09249249u;
}

/// False for NaN, which then counts as 0.
std::uint32_t cell_of(double share) {
  constexpr double kCells = 1u << kBits;
  return share > 0 ? static_cast<std::uint32_t>(std::min(share * kCells, kCells - 1)) : 0u;
}

std::vector<Keyed> keys_of(std::span<const Point> points) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Point lower = {kInfinity, kInfinity, kInfinity}, upper = -1.0 * lower;
  for (const Point& p : points) {
    lower = least(lower, p);
    upper = greatest(upper, p);
  }
  const Point sides = upper - lower;
  const double inverse = 1 / std::max({sides[0], sides[1], sides[2], 1e-300});
  std::vector<Keyed> keys(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::uint32_t key = 0;
    for (std::size_t k = 0; k < 3; ++k) key |= spread(cell_of((points[i][k] - lower[k]) * inverse)) << k;
    keys[i] = {key, static_cast<std::uint32_t>(i)};
  }
  return keys;
}

}  // namespace

// A radix sort from the lowest digit on keeps equal keys in their order.
std::vector<std::uint32_t> order_along_curve(std::span<const Point> points) {
  std::vector<Keyed> keys = keys_of(points), sorted(points.size());
  for (std::uint32_t shift = 0; shift < 3 * kBits; shift += kBits) {
    std::array<std::uint32_t, (1u << kBits) + 1> starts{};
    const auto digit = [shift](const Keyed& k) { return k.key >> shift & ((1u << kBits) - 1u); };
    for (const Keyed& k : keys) ++starts[digit(k) + 1];
    for (std::size_t d = 1; d < starts.size(); ++d) starts[d] += starts[d - 1];
    for (const Keyed& k : keys) sorted[starts[digit(k)]++] = k;
    keys.swap(sorted);
  }
  std::vector<std::uint32_t> order(points.size());
  std::transform(keys.begin(), keys.end(), order.begin(), [](const Keyed& k) { return k.index; });
  return order;
}

namespace {

void halve(std::span<const Point> points, std::span<std::uint32_t> part) {
  constexpr std::size_t kFew = 8;
  if (part.size() <= kFew) return;
  Point low = points[part[0]], high = low;
  for (const std::uint32_t i : part) {
    low = least(low, points[i]);
    high = greatest(high, points[i]);
  }
  const Point sides = high - low;
  const auto axis = static_cast<std::size_t>(std::max_element(sides.begin(), sides.end()) - sides.begin());
  const std::size_t middle = part.size() / 2;
  std::nth_element(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(middle), part.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     return points[a][axis] != points[b][axis] ? points[a][axis] < points[b][axis] : a < b;
                   });
  halve(points, part.first(middle));
  halve(points, part.subspan(middle));
}

}  // namespace

void order_by_halving(std::span<const Point> points, std::vector<std::uint32_t>& order) {
  order.resize(points.size());
  std::iota(order.begin(), order.end(), 0u);
  halve(points, order);
}

}  // namespace medial_vk
