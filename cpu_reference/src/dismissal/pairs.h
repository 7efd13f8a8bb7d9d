// Dismissal by pairs: a box holds no salient medial point if no two of its carriers can hold two feet of one
// (docs/theory.md, Lemmas C to F, M and the theorem on pairs).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "dismissal/carriers.h"
#include "geometry/box.h"

namespace medial_vk::reference {

struct CarrierPair {
  const Carrier* a;
  const Carrier* b;
};

struct PairSearch {
  std::vector<CarrierPair> pairs;  // the pairs that are not excluded, those of the nearest carriers first
  bool complete = true;            // false: the search ended before all pairs were tried
  bool proves_empty() const { return complete && pairs.empty(); }
};

/// Pairs of carriers that may hold two feet, 2 * angle apart, of a medial point of the box: at most `most` of them.
PairSearch salient_pairs(const Tree& tree, const Box& box, std::span<const Carrier> carriers, double angle,
                         std::size_t most);

}  // namespace medial_vk::reference
