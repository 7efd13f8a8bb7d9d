// Steps of single balls of a union towards the goal of its contract.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "medial_vk/dynamic_union.h"
#include "mesh/solid.h"

namespace medial_vk {

class BallSteps {
 public:
  virtual ~BallSteps() = default;
  /// Moves the ball at `place` about as far as `step`, if that gains anything, and says how much (mesh units cubed); 0:
  /// it is where it was. `step` becomes the length to try next. Errors: those of DynamicUnion::move().
  Result<double> take(DynamicUnion& balls, std::uint32_t place, double& step);
  /// To be called for each ball that was added.
  virtual void came(const DynamicUnion& balls, std::uint32_t place) = 0;
  /// Share of the solid's volume that is to become small.
  virtual double error(const DynamicUnion& balls) const = 0;

 private:
  /// The ball that should be there instead; nothing where no direction is better.
  virtual std::optional<Ball> propose(const DynamicUnion& balls, std::uint32_t place, double step) = 0;
  /// What that gains; 0: it does not, and nothing has changed.
  virtual Result<double> try_move(DynamicUnion& balls, std::uint32_t place, const Ball& to) = 0;
};

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
