// Seeded shapes in the plane, for statements about all shapes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/split_mix.h"
#include "medial_vk/plane_shape.h"

namespace medial_vk::test {

/// Uniform in [from, to).
inline double uniform(SplitMix& random, double from, double to) {
  return from + (to - from) * (random.symmetric() + 1) / 2;
}
/// Uniform in 0, ..., count - 1.
inline unsigned choice(SplitMix& random, unsigned count) { return static_cast<unsigned>(uniform(random, 0, count)); }

inline constexpr unsigned kShapeFamilies = 7;
/// "convex", "star", "comb", "holes", "spikes", "specks", "triads".
std::string family_name(unsigned family);

/// A shape of 10 to 100 segments with a size about 1, turned at random. `holes` and `specks` have holes (specks are too
/// small to matter but as points; triads are three of them around a point, two of them close), `spikes` has thin
/// needles that reach inwards.
std::vector<PlaneRing> random_shape(unsigned family, std::uint64_t seed);

}  // namespace medial_vk::test
