// The method best: tight balls for a solid, chosen and moved for the contract.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "sphere_fits/methods/sphere_set.h"

namespace medial_vk {

/// Adds balls inside the solid one after the other. The next ball is the medial ball that adds the most volume,
/// measured exactly; or the ball in the widest gap between union and boundary, which is chosen for every eighth ball,
/// and for any other if it adds at least 0.4 of that volume. Then the ball and its neighbours slide in the direction of
/// the greatest growth of the union, while their contacts move along the boundary (docs/theory.md, "Tight spheres").
/// Neither the choice of a ball nor its motion depends on the requested number, and no step reduces the union, so more
/// balls never leave more volume uncovered. With the contract balanced, balls also grow and move beyond the boundary to
/// minimise SymmetricDifference, which more balls never increase. Errors: those of approximate_by_spheres().
Result<SphereSet> best_spheres(const Solid& solid, const SphereFitOptions& options, const Extractor& extractor,
                               const SphereProgress& progress);

/// The search of best_spheres() for balls inside, to be continued: as neither the choice nor the motion of a ball
/// depends on the requested number, the sets of all numbers up to the present one are known.
class GrowingBalls {
 public:
  virtual ~GrowingBalls() = default;
  /// Adds balls until there are `count`, or no more are found. Errors: those of best_spheres().
  virtual Status grow(std::size_t count, const SphereProgress& progress) = 0;
  /// True if no more balls are found.
  virtual bool ends() const = 0;
  /// SphereSet::volumes; as many as there are balls.
  virtual const std::vector<double>& volumes() const = 0;
  /// The balls when there were `count`, at most the present number, in no particular order.
  virtual std::vector<Ball> at(std::size_t count) const = 0;
};

/// For at most `options.count` balls, with contract inside and without other goals. Keeps references to the solid, the
/// options and the extractor. Errors: kOutOfMemory, kUsage (2^30 balls). Throws std::bad_alloc.
Result<std::unique_ptr<GrowingBalls>> grow_inside(const Solid& solid, const SphereFitOptions& options,
                                                  const Extractor& extractor);

}  // namespace medial_vk
