// The components of vertices that edges connect, where few vertices of a mesh have such edges.
#pragma once

#include <cstdint>
#include <unordered_map>

namespace medial_vk {

/// Union-find by path halving.
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
