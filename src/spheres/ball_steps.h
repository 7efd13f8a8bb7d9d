// Steps of single balls of a union towards the goal of its contract.
#pragma once

#include <cstdint>
#include <memory>

#include "medial_vk/dynamic_union.h"
#include "mesh/solid.h"

namespace medial_vk {

class BallSteps {
 public:
  virtual ~BallSteps() = default;
  /// Moves the ball at `place` about as far as `step`, if that gains anything, and says how much (mesh units cubed); 0:
  /// it is where it was. `step` becomes the length to try next. Errors: those of DynamicUnion::move().
  virtual Result<double> take(DynamicUnion& balls, std::uint32_t place, double& step) = 0;
  /// To be called for each ball that was added.
  virtual void came(const DynamicUnion& balls, std::uint32_t place) = 0;
  /// Share of the solid's volume that is to become small.
  virtual double error(const DynamicUnion& balls) const = 0;
};

/// A ball that is smaller than `step` allows, in radii, is where it should be.
constexpr double kLongestStep = 0.5, kShortestStep = 1e-3;

/// Balls stay inside the solid and touch its boundary; gained is the volume of the union.
std::unique_ptr<BallSteps> sliding_steps(const Solid& solid);

/// Balls may reach out; gained is what the volume between the solid and the union becomes less (docs/theory.md,
/// "Balanced"), by the estimate of SymmetricDifference. Throws std::bad_alloc.
std::unique_ptr<BallSteps> balancing_steps(const Solid& solid);

/// Without a hole in the boundary, growing and sliding within empty balls leads nowhere else; near a hole the winding
/// number decides, and every evaluation has its own rounding.
inline bool stays_inside(const Solid& solid, const Ball& ball) {
  return solid.mesh().report.closed || solid.contains(ball.centre);
}

}  // namespace medial_vk
