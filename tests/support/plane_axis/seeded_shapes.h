// Seeded shapes with integral coordinates, times a scale: for Voronoi diagrams by others that need integers.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "medial_vk/plane_shape.h"

namespace medial_vk::test {

inline constexpr std::uint64_t kSeededFamilies = 7;
const char* seeded_family(std::uint64_t seed);

/// Families in turn by seed: a square with polygons cut out, a comb, a spiral, letters, parts that nearly touch, parts
/// that touch, a star. Coordinates are integers below 2^25.
std::vector<PlaneRing> seeded_rings(std::uint64_t seed);

/// A shape made ready, and the same with coordinates in integers: those of `scaled` are theirs times `scale`, rounded.
struct SeededShape {
  PreparedShape scaled, integral;
  double scale = 1;
};

/// The longest side is a power of ten from 1e-9 to 1e9, by seed. None if segments cross, where no point is integral.
std::optional<SeededShape> seeded_shape(std::uint64_t seed);

}  // namespace medial_vk::test
