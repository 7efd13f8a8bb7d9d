#include "sheets/holes.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

namespace medial_vk {

std::uint32_t Boundaries::number_of(std::uint64_t side) {
  const auto [found, is_new] = numbers_.try_emplace(side, static_cast<std::uint32_t>(by_last_.size()));
  if (is_new) by_last_.emplace_back();
  return found->second;
}

Boundaries::Chain Boundaries::reduced(std::span<const std::uint64_t> edges) {
  Chain chain;
  for (const std::uint64_t edge : edges) chain.push_back(number_of(edge));
  std::sort(chain.begin(), chain.end(), std::greater<>());
  Chain sum;
  while (!chain.empty() && !by_last_[chain.front()].empty()) {
    const Chain& other = by_last_[chain.front()];
    sum.clear();
    std::set_symmetric_difference(chain.begin(), chain.end(), other.begin(), other.end(), std::back_inserter(sum),
                                  std::greater<>());
    chain.swap(sum);
  }
  return chain;
}

bool Boundaries::is_boundary(std::span<const std::uint64_t> loop) { return reduced(loop).empty(); }

bool Boundaries::add(std::array<std::uint64_t, 3> sides) {
  Chain chain = reduced(sides);
  if (chain.empty()) return false;
  const std::uint32_t last = chain.front();
  by_last_[last] = std::move(chain);
  return true;
}

}  // namespace medial_vk
