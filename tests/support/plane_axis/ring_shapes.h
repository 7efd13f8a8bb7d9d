// Shapes in the plane for tests of the exact axis: generic ones, and those in which many distances are equal.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/plane_shape.h"

namespace medial_vk::test {

/// Kinds in turn by seed: a polygon that crosses itself, a star, overlapping polygons, polygons on a lattice, a square
/// with square holes that touch, a spiral, a comb. Times `scale`, moved by `shift`.
std::vector<PlaneRing> rings_of_seed(std::uint64_t seed, double scale = 1, PlanePoint shift = {0, 0});

/// A square with `count` squares cut out, turned by random angles, that do not meet.
std::vector<PlaneRing> square_with_holes(int count, std::uint64_t seed);

PreparedShape prepared(const std::vector<PlaneRing>& rings, FillRule rule = FillRule::kNonZero);

}  // namespace medial_vk::test
