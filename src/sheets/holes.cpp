#include "sheets/holes.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

namespace medial_vk {

Boundaries::Chain Boundaries::reduced(std::span<const std::uint64_t> edges) const {
  Chain chain(edges.begin(), edges.end());
  std::sort(chain.begin(), chain.end(), std::greater<>());
  Chain sum;
  while (!chain.empty()) {
    const auto other = by_last_.find(chain.front());
    if (other == by_last_.end()) break;
    sum.clear();
    std::set_symmetric_difference(chain.begin(), chain.end(), other->second.begin(), other->second.end(),
                                  std::back_inserter(sum), std::greater<>());
    chain.swap(sum);
  }
  return chain;
}

bool Boundaries::is_boundary(std::span<const std::uint64_t> loop) const { return reduced(loop).empty(); }

bool Boundaries::add(std::array<std::uint64_t, 3> sides) {
  Chain chain = reduced(sides);
  if (chain.empty()) return false;
  const std::uint64_t last = chain.front();
  by_last_.emplace(last, std::move(chain));
  return true;
}

}  // namespace medial_vk
