// The supremum of a function over a region, between a lower and an upper bound: cells with the greatest bounds are
// divided first.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "medial_vk/sphere_measures.h"
#include "sphere_fits/quality/threads.h"

namespace medial_vk {

/// Bounds of a function over a cell.
struct CellBounds {
  /// A value attained somewhere in the region, or minus infinity.
  double value = -std::numeric_limits<double>::infinity();
  /// Upper bound in the cell; minus infinity: the cell is outside the region.
  double bound = -std::numeric_limits<double>::infinity();
};

struct SearchLimits {
  double tolerance = 0;           ///< Greatest difference of the returned bounds ...
  std::size_t cells = 2'000'000;  ///< ... unless so many cells were not enough.
  Threads threads = {};
};

/// `lower` is a value known to be attained. `evaluate(cell, lower)` returns CellBounds; values not above `lower` may be
/// omitted. `split(cell, children)` appends parts that cover the cell, for which its bound holds too. The result does
/// not depend on the number of threads: cells are divided in batches of a fixed size.
template <class Cell, class Evaluate, class Split>
Bounds bound_supremum(std::vector<Cell> cells, double lower, const SearchLimits& limits, Evaluate evaluate,
                      Split split) {
  constexpr std::size_t kBatch = 2048;
  struct Open {
    Cell cell;
    double bound;
    std::uint64_t number;
  };
  const auto is_less = [](const Open& a, const Open& b) {
    return a.bound != b.bound ? a.bound < b.bound : a.number > b.number;
  };
  std::vector<Open> heap;
  std::vector<CellBounds> known;
  double closed = lower, cap = std::numeric_limits<double>::infinity();
  std::uint64_t number = 0;
  while (true) {
    known.resize(cells.size());
    for_all(cells.size(), 16, limits.threads, [&](std::size_t i) { known[i] = evaluate(cells[i], lower); });
    for (const CellBounds& cell : known) lower = std::max(lower, cell.value);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const double bound = std::min(known[i].bound, cap);
      if (bound <= lower + limits.tolerance) {
        closed = std::max(closed, bound);
      } else {
        heap.push_back({std::move(cells[i]), bound, number});
        std::push_heap(heap.begin(), heap.end(), is_less);
      }
      ++number;
    }
    cells.clear();
    if (heap.empty() || heap.front().bound <= lower + limits.tolerance || number > limits.cells) break;
    cap = heap.front().bound;  // No cell's bound is above it, nor those of its parts.
    for (std::size_t n = 0; n < kBatch && !heap.empty() && heap.front().bound > lower + limits.tolerance; ++n) {
      std::pop_heap(heap.begin(), heap.end(), is_less);
      split(heap.back().cell, cells);
      heap.pop_back();
    }
  }
  if (!heap.empty()) closed = std::max(closed, heap.front().bound);
  return {lower, std::max(lower, closed)};
}

}  // namespace medial_vk
