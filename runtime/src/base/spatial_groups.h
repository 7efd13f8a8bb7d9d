// Orders things in space so that neighbours lie side by side.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "base/point_ops.h"

namespace medial_vk {

/// Reorders `items` so that each `size` of them in a row, and the rest at the end, lie near each other: halves them
/// along the longest side of the box of their positions, at a multiple of `size`, until one group is left.
/// `position(item)` is a Point.
template <class Item, class Position>
void order_in_groups(std::span<Item> items, std::size_t size, const Position& position) {
  const std::size_t groups = (items.size() + size - 1) / size;
  if (groups < 2) return;
  Point lower = position(items.front()), upper = lower;
  for (const Item& item : items) {
    lower = least(lower, position(item));
    upper = greatest(upper, position(item));
  }
  const Point sides = upper - lower;
  const auto axis = static_cast<std::size_t>(std::ranges::max_element(sides) - sides.begin());
  const std::size_t half = groups / 2 * size;
  std::ranges::nth_element(items, items.begin() + static_cast<std::ptrdiff_t>(half), {},
                           [&](const Item& item) { return position(item)[axis]; });
  order_in_groups(items.first(half), size, position);
  order_in_groups(items.subspan(half), size, position);
}

}  // namespace medial_vk
