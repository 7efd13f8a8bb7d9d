// Disjoint sets that many threads unite at once.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace medial_vk {

/// Lock-free union-find (Anderson and Woll 1991): a root is only ever put below a smaller one, so that in the end the
/// root of a set is its least member, for any schedule of the threads.
class ConcurrentSets {
 public:
  explicit ConcurrentSets(std::size_t size) : parents_(size) {
    for (std::size_t i = 0; i < size; ++i) parents_[i].store(static_cast<std::uint32_t>(i), std::memory_order_relaxed);
  }

  /// The least member once all unions are finished; before that, any member that some thread read as the root.
  std::uint32_t root(std::uint32_t x) {
    for (;;) {
      std::uint32_t parent = parents_[x].load(std::memory_order_relaxed);
      if (parent == x) return x;
      const std::uint32_t above = parents_[parent].load(std::memory_order_relaxed);
      // Path halving; an update by another thread in between does no harm.
      if (above != parent) parents_[x].compare_exchange_weak(parent, above, std::memory_order_relaxed);
      x = above;
    }
  }

  void join(std::uint32_t a, std::uint32_t b) {
    for (;;) {
      a = root(a);
      b = root(b);
      if (a == b) return;
      if (a > b) std::swap(a, b);
      std::uint32_t expected = b;
      if (parents_[b].compare_exchange_strong(expected, a, std::memory_order_relaxed)) return;
    }
  }

 private:
  std::vector<std::atomic<std::uint32_t>> parents_;
};

}  // namespace medial_vk
