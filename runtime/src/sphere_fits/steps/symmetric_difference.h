// The contribution of a ball to the volume between a solid and a union of balls.
#pragma once

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
  double change(const Ball& ball, std::span<const Ball> others);

 private:
  using Stretch = SolidLines::Stretch;
  /// The disc in which a plane of lines meets a ball.
  struct Disc {
    double across, along;  // its centre
    double squared;        // of its radius; not positive: empty
  };
  static Disc slice(const Ball& ball, std::size_t axis, std::size_t across, double off);
  double change_along(const Ball& ball, std::span<const Ball> others, std::size_t axis);
  static std::ptrdiff_t first_line(const SolidLines::Bundle& bundle, std::size_t k, double from);
  void find_left(const Disc& ball, double x);
  void take_away(const Stretch& taken);

  SolidLines lines_;
  std::vector<Disc> in_row_;          // of the other balls
  std::vector<Stretch> left_, next_;  // of a line: the stretches that only the ball holds
};

}  // namespace medial_vk
