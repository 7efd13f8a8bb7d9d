// The contribution of a ball to the volume between a solid and a union of balls.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "sphere_fits/steps/solid_lines.h"

namespace medial_vk {

/// vol(U \ solid) + vol(solid \ U), estimated along lines. The sum of contributions while balls are added and moved
/// equals the estimate for the present balls: it does not drift. For one thread.
class SymmetricDifference {
 public:
  /// Of a closed mesh. Throws std::bad_alloc.
  explicit SymmetricDifference(const Solid& solid);

  /// The value without balls: the volume of the solid.
  double of_none() const { return lines_.volume(); }

  /// The change by this ball of the value for `others`: the volume that only this ball holds outside the solid, less
  /// that inside. Mesh units cubed.
  double change(const Ball& ball, std::span<const Ball> others) { return change({ball.centre, 0}, ball, others); }
  /// The change of the value where a ball among `others` becomes another one. Only what lies between the two spheres is
  /// examined, and blocks of lines where one of the others holds all of it are passed over. Mesh units cubed.
  double change(const Ball& from, const Ball& to, std::span<const Ball> others);

 private:
  class Walk;
  /// Memory of a call.
  struct Scratch {
    std::vector<Ball> others;
    std::vector<float> x, y, z, least, greatest;  // of the others, rounded: centres, and squares of radii
    std::vector<float> near, far;                 // from them to a block, squared
    std::vector<std::uint32_t> met;               // numbers of others that meet a block
    std::vector<SolidLines::Stretch> taken;       // of a line, by others
  };

  SolidLines lines_;
  Scratch scratch_;
};

}  // namespace medial_vk
