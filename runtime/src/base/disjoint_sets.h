// Sets that are joined two by two: union-find with halved paths.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <unordered_map>
#include <vector>

namespace medial_vk {

/// The sets of an equivalence between all numbers below a count. The least member stands for a set.
class DisjointSets {
 public:
  DisjointSets() = default;
  explicit DisjointSets(std::size_t count) { reset(count); }

  /// As many sets of one member each. Memory is kept.
  void reset(std::size_t count) {
    above_.resize(count);
    std::iota(above_.begin(), above_.end(), 0u);
  }
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

/// The components of vertices that edges connect, where few vertices of a mesh have such edges.
class ConnectedVertices {
 public:
  /// A representative of the component.
  std::uint32_t root(std::uint32_t v) {
    while (parent(v) != v) v = parent(v) = parent(parent(v));
    return v;
  }
  void connect(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t root_of_b = root(b);
    parent(root(a)) = root_of_b;
  }

 private:
  std::uint32_t& parent(std::uint32_t v) { return parents_.try_emplace(v, v).first->second; }

  std::unordered_map<std::uint32_t, std::uint32_t> parents_;
};

}  // namespace medial_vk
