// By how much bounds of distances differ from the distance, on average: docs/theory.md, "An estimate".
#pragma once

#include <vector>

#include "proximity/body_tree.h"
#include "solid/solid.h"

namespace medial_vk {

/// For each ball of the sets of a body: the mean difference between the distances of a point from the body and from the
/// set, for points outside whose closest ball of the set it is. Empty: not known.
struct MeanErrors {
  std::vector<float> inside, cover;
};

/// Precondition: both trees hold balls. They are relative to `centre`.
MeanErrors mean_errors(const Solid& solid, const BodyTree& inside, const BodyTree& cover, const Point& centre,
                       unsigned threads, LoopWatch& watch);

}  // namespace medial_vk
