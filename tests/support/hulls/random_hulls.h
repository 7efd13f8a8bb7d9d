// Random hulls of balls and pairs of them, many of them degenerate.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "cpu_reference/ball_hulls.h"
#include "medial_vk/ball_hull.h"

namespace medial_vk::test {

/// How the balls of a random hull lie.
enum class HullFamily : std::uint8_t {
  kGeneral,
  kEqualRadii,
  kZeroRadii,     // one of them, or all
  kNested,        // one ball holds another
  kEqualBalls,    // two are the same
  kSameCentre,    // of two balls of different radii
  kCollinear,     // the third centre is on the line of the others, as exactly as doubles allow
  kThin,          // nearly so
  kNearlyNested,  // the radii differ by nearly the distance of the centres
  kCount,
};

/// How two random hulls lie.
enum class PairFamily : std::uint8_t {
  kGeneral,  // near each other, many overlap
  kApart,
  kParallel,  // an edge of one is parallel to an edge of the other
  kCrossing,  // an edge of one goes through the axis of the other
  kCoplanar,  // all centres in one plane
  kSharedBall,
  kTheSame,  // both hulls are equal
  kFlat,     // triangles face each other, parallel
  kCount,
};

struct HullPair {
  BallHull first, second;
};

/// Coordinates of centres are in [-1, 1], radii mostly up to 0.5.
BallHull random_hull(std::uint32_t count, HullFamily family, std::mt19937_64& random);
/// Of a random family.
BallHull random_hull(std::uint32_t count, std::mt19937_64& random);
HullPair random_pair(std::uint32_t first_count, std::uint32_t second_count, PairFamily family, std::mt19937_64& random);

/// As the reference takes it.
std::vector<reference::HullBall> reference_hull(const BallHull& hull);

/// A bound of the rounding of distances for numbers of that size: 64 units in the last place of the greatest
/// coordinate, radius or length (docs/theory.md, "Hulls of balls").
double distance_rounding(const BallHull& first, const BallHull& second);

}  // namespace medial_vk::test
