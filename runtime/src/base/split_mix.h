#pragma once

#include <cstdint>

namespace medial_vk {

/// SplitMix64 (G. Steele, D. Lea, C. Flood, 2014): the same numbers on every machine, unlike the distributions of
/// <random>.
class SplitMix {
 public:
  explicit SplitMix(std::uint64_t seed) : state_(seed) {}
  /// Uniform in [-1, 1).
  double symmetric() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15ull;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1;
  }

 private:
  std::uint64_t state_;
};

}  // namespace medial_vk
