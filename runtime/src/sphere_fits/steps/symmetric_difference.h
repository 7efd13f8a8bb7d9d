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
  double change(const Ball& ball, std::span<const Ball> others) { return change({ball.centre, 0}, ball, others); }
  /// The change of the value where a ball among `others` becomes another one: of each line, only what lies between the
  /// ends of their stretches is examined. Mesh units cubed.
  double change(const Ball& from, const Ball& to, std::span<const Ball> others);

 private:
  using Stretch = SolidLines::Stretch;
  /// The disc in which a plane of lines meets a ball.
  struct Disc {
    double across, along;  // its centre
    double squared;        // of its radius
  };
  /// Where the line at `across` meets others of the row.
  struct Line {
    double across;
    std::span<const Stretch> inside;
  };
  class InRow;

  double change_along(const Ball& from, const Ball& to, std::span<const Ball> others, std::size_t axis);
  void slice_others(std::span<const Ball> others, std::size_t axis, double y);
  double left_between(double from, double to, const Line& line, std::size_t& hider);

  SolidLines lines_;
  std::vector<Disc> in_row_;    // of the other balls
  std::vector<Stretch> taken_;  // of a line, by other balls
};

}  // namespace medial_vk
