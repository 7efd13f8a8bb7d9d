#include "site_voronoi/line_clearance.h"

#include <algorithm>
#include <array>

namespace medial_vk {
namespace {

constexpr unsigned kMostLevels = 9;    // of halves
constexpr double kCloseEnough = 0.99;  // of the least distance that was found
constexpr double kNarrow = 1e-3;       // of the clearance at the ends: given up

struct Part {
  ClearPlace from, to;
  unsigned level = 0;
};

}  // namespace

/// The distance changes by no more than the way: on a line of length l between places with clearances a and b it is at
/// least max(a - t, b - (l - t)) at t, and (a + b - l) / 2 everywhere.
double clearance_of_line(const SiteForest& forest, double rounding, const ClearPlace& from, const ClearPlace& to) {
  double least_found = std::min(from.clearance, to.clearance), proved = least_found;
  const double given_up = kNarrow * least_found;
  std::array<Part, kMostLevels + 2> pending;
  std::size_t count = 0;
  pending[count++] = {from, to, 0};
  while (count > 0) {
    const Part part = pending[--count];
    const double way = length(part.to.at - part.from.at) + rounding;
    const double bound = 0.5 * (part.from.clearance + part.to.clearance - way);
    if (bound >= kCloseEnough * least_found || part.level == kMostLevels) {
      if (!(bound > 0)) return 0;
      proved = std::min(proved, bound);
      continue;
    }
    ClearPlace middle = {part.from.at + 0.5 * (part.to.at - part.from.at), 0};
    middle.clearance = forest.distance(middle.at) - rounding;
    least_found = std::min(least_found, middle.clearance);
    if (!(least_found > given_up)) return 0;
    pending[count++] = {middle, part.to, part.level + 1};
    pending[count++] = {part.from, middle, part.level + 1};
  }
  return proved;
}

}  // namespace medial_vk
