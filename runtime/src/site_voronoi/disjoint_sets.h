#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace medial_vk {

/// The sets of an equivalence between numbers. The least member stands for a set.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : above_(count) { std::iota(above_.begin(), above_.end(), 0u); }

  std::uint32_t of(std::uint32_t i) {
    while (above_[i] != i) i = above_[i] = above_[above_[i]];
    return i;
  }
  /// False if both are in one set already.
  bool join(std::uint32_t a, std::uint32_t b) {
    a = of(a);
    b = of(b);
    above_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }

 private:
  std::vector<std::uint32_t> above_;
};

}  // namespace medial_vk
