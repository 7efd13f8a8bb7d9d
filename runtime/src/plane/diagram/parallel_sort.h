// Sorting on several threads of the host.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "base/parallel.h"

namespace medial_vk::plane {

/// Sorts by <. The result does not depend on `threads` (0: one per core) if equal values are the same. Throws
/// std::bad_alloc.
template <class T>
void parallel_sort(std::vector<T>& values, unsigned threads) {
  constexpr std::size_t kParts = 16, kFew = 4096;
  if (values.size() <= kFew) {
    std::sort(values.begin(), values.end());
    return;
  }
  const auto border = [&](std::size_t part) {
    return static_cast<std::ptrdiff_t>(values.size() * std::min(part, kParts) / kParts);
  };
  parallel_for(kParts, 1, threads,
               [&](std::size_t part) { std::sort(values.begin() + border(part), values.begin() + border(part + 1)); });
  std::vector<T> merged(values.size());
  for (std::size_t width = 1; width < kParts; width *= 2) {
    parallel_for(kParts / (2 * width), 1, threads, [&](std::size_t i) {
      const std::size_t part = 2 * width * i;
      const auto middle = values.begin() + border(part + width);
      std::merge(values.begin() + border(part), middle, middle, values.begin() + border(part + 2 * width),
                 merged.begin() + border(part));
    });
    values.swap(merged);
  }
}

}  // namespace medial_vk::plane
