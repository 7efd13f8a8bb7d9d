// Lists of indices by another index.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace medial_vk {

class IndexLists {
 public:
  IndexLists() = default;
  /// One entry for each pair (of, index), in the order of the pairs.
  template <class Pairs>
  IndexLists(std::size_t count, const Pairs& pairs) : starts_(count + 1), indices_(pairs.size()) {
    for (const auto& pair : pairs) ++starts_[pair.first + 1];
    for (std::size_t i = 0; i < count; ++i) starts_[i + 1] += starts_[i];
    std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
    for (const auto& pair : pairs) indices_[next[pair.first]++] = pair.second;
  }
  std::span<const std::uint32_t> operator[](std::size_t i) const {
    return {indices_.data() + starts_[i], starts_[i + 1] - starts_[i]};
  }

 private:
  std::vector<std::size_t> starts_;
  std::vector<std::uint32_t> indices_;
};

}  // namespace medial_vk
