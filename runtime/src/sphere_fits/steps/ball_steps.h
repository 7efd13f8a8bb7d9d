// Steps of single balls of a union towards the goal of its contract.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "medial_vk/dynamic_union.h"
#include "solid/solid.h"
#include "sphere_fits/steps/near_boundary.h"

namespace medial_vk {

class BallSteps {
 public:
  virtual ~BallSteps() = default;
  /// Shifts the ball in slot `slot` about as far as `step`, if that gains anything, and returns an estimate of the gain
  /// (mesh units cubed); 0: the ball is unchanged. DynamicUnion::settle() ends a sequence of them. `step` becomes the
  /// next length to try. Errors: those of DynamicUnion::exposure_at().
  Result<double> take(DynamicUnion& balls, std::uint32_t slot, double& step);
  /// To be called for each added ball.
  virtual void came(const DynamicUnion& balls, std::uint32_t slot) = 0;
  /// Replaces a ball whether or not that gains anything. Errors: those of DynamicUnion::shift().
  virtual Status replace(DynamicUnion& balls, std::uint32_t slot, const Ball& to) { return balls.shift(slot, to); }
  /// The share of the solid's volume that the steps reduce.
  virtual double error(const DynamicUnion& balls) const = 0;

 private:
  /// The replacement of the ball; no value if no direction is better.
  virtual Result<std::optional<Ball>> propose(DynamicUnion& balls, std::uint32_t slot, double step) = 0;
  /// The gain of this replacement; 0: there is none, and nothing has changed.
  virtual Result<double> try_move(DynamicUnion& balls, std::uint32_t slot, const Ball& to) = 0;
};

/// Balls stay inside the solid and touch its boundary; the gain is that of the volume of the union.
std::unique_ptr<BallSteps> sliding_steps(const Solid& solid);

/// Balls may reach out of the solid; the gain is the decrease of the volume between the solid and the union
/// (docs/theory.md, "Balanced"), by the estimate of SymmetricDifference. With a bound, which must outlive them, steps
/// keep to its radii. Throws std::bad_alloc.
std::unique_ptr<BallSteps> balancing_steps(const Solid& solid, const NearBoundary* bound = nullptr);

/// Without a hole in the boundary, growth and motion within empty balls cannot leave the solid; near a hole the winding
/// number decides, and every evaluation has its own rounding.
inline bool stays_inside(const Solid& solid, const Ball& ball) {
  return solid.mesh().report.closed || solid.contains(ball.centre);
}

}  // namespace medial_vk
