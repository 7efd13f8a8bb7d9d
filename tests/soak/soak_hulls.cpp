// Distances of hulls of balls against the reference: soak_hulls FIRST COUNT. Pairs of all kinds and families, COUNT of
// each pair of kinds, for the seeds from FIRST on. Prints a table by kinds, and a line for every fault. The exit code
// is 1 if there is a fault.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "cpu_reference/ball_hulls.h"
#include "medial_vk/ball_hull.h"
#include "support/hulls/random_hulls.h"

namespace {

using namespace medial_vk;
using namespace medial_vk::test;

const char* name_of(std::uint32_t count) { return count == 1 ? "ball" : count == 2 ? "cone" : "slab"; }

/// The number of faults.
std::uint64_t compare(std::uint32_t first, std::uint32_t second, std::uint64_t from, std::uint64_t count) {
  std::uint64_t faults = 0, overlaps = 0;
  double greatest_above = 0, greatest_below = 0;
  for (std::uint64_t seed = from; seed < from + count; ++seed) {
    std::mt19937_64 random(seed * 16 + first * 4 + second);
    const auto family = static_cast<PairFamily>(seed % static_cast<std::uint64_t>(PairFamily::kCount));
    const HullPair pair = random_pair(first, second, family, random);
    const double expected = reference::hull_distance(reference_hull(pair.first), reference_hull(pair.second));
    const double found = distance_between(pair.first, pair.second);
    const double rounding = distance_rounding(pair.first, pair.second);
    const double units = 64 * (found - expected) / rounding;
    greatest_above = std::max(greatest_above, units);
    greatest_below = std::max(greatest_below, -units);
    overlaps += expected < 0 ? 1 : 0;
    if (std::fabs(found - expected) <= rounding) continue;
    ++faults;
    fmt::print("fault: {}-{}, seed {}, family {}: {:.17g} instead of {:.17g}\n", name_of(first), name_of(second), seed,
               static_cast<int>(family), found, expected);
  }
  fmt::print("| {}-{} | {} | {} | {:.1f} | {:.1f} |\n", name_of(first), name_of(second), count, overlaps,
             greatest_above, greatest_below);
  return faults;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: soak_hulls FIRST COUNT\n");
    return 2;
  }
  const std::uint64_t from = std::strtoull(argv[1], nullptr, 10), count = std::strtoull(argv[2], nullptr, 10);
  fmt::print("Units: 2^-53 of the greatest length, coordinate or radius of a pair.\n\n");
  fmt::print("| pair | number | overlap | greatest excess, units | greatest lack, units |\n|---|--:|--:|--:|--:|\n");
  std::uint64_t faults = 0;
  for (std::uint32_t first = 1; first <= 3; ++first) {
    for (std::uint32_t second = first; second <= 3; ++second) faults += compare(first, second, from, count);
  }
  fmt::print("{} faults\n", faults);
  return faults == 0 ? 0 : 1;
}
