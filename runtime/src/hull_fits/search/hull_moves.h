// Hulls at random, and random changes of one: what the search tries.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/split_mix.h"
#include "hull_fits/search/free_radii.h"
#include "hull_fits/search/uncovered_seeds.h"
#include "solid/solid.h"

namespace medial_vk {

/// Of all hulls of a search.
struct SoughtHulls {
  std::uint32_t corners = 1;
  bool equal = false;  ///< All radii of one hull.
};

/// Free hulls are long: their corners are medial points of any distance. Several threads may use one object.
class HullMoves {
 public:
  HullMoves(const Solid& solid, const FreeRadii& radii, const UncoveredSeeds& seeds, const SoughtHulls& shape)
      : solid_(solid), radii_(radii), seeds_(seeds), shape_(shape) {}

  /// A hull with a corner where the solid is uncovered. No value: the corners drawn do not see each other.
  std::optional<BallHull> propose(SplitMix& random) const;
  /// A hull near `hull`, by a share `step` of its size. No value: none there that is promising (FreeRadii::fit()).
  std::optional<BallHull> change(const BallHull& hull, double step, SplitMix& random,
                                 const IsPromising& is_promising) const;

 private:
  std::optional<BallHull> fit(const std::array<Point, 3>& centres, const IsPromising& is_promising = {}) const {
    return radii_.fit(centres, shape_.corners, shape_.equal, is_promising);
  }
  Point far_seed(const Ball& from, SplitMix& random) const;
  bool snap(Point& p) const;

  const Solid& solid_;
  const FreeRadii& radii_;
  const UncoveredSeeds& seeds_;
  SoughtHulls shape_;
};

}  // namespace medial_vk
